// Gas, bone, metal, a face off the skin, the edge of the CT.
#include "tests/sim/imaging/ultrasound/ultrasound_scene.h"

namespace seldinger::imaging {
namespace {

void expect_finite(const PolarPicture& picture) {
  for (const float v : picture.envelope) ASSERT_TRUE(std::isfinite(v) && v >= 0.0F);
}

// From 10 mm down a line is dark but for what comes again.
void expect_dark_below(const PolarPicture& picture, const UltrasoundView& view, double depth_mm, double below_db) {
  for (int b = 0; b < view.beams; ++b)
    for (int k = sample_at(view, depth_mm); k < view.samples; ++k)
      ASSERT_LT(decibels(std::max(at(picture, b, k), 1e-10F)), below_db) << "beam " << b << ", sample " << k;
}

TEST(HardCase, GasAtTheSkinIsDarkWithRingsAndNoNan) {
  const Scene s = scene([](const glm::dvec3& p) { return p.y < 60.0 ? TissueClass::gas : TissueClass::liver; });
  for (const UltrasoundView& view : {curved_view(), straight_view()}) {
    const PolarPicture picture = polar_of(s, view);
    expect_finite(picture);
    // Rings at the lens, half each time.
    for (int k = 1; k <= 5; ++k)
      EXPECT_NEAR(decibels(at(picture, 64, sample_at(view, k * kUsLensMm))), kUsLensDb - (k - 1) * kUsLensDbPerLine,
                  1.5);
    expect_dark_below(picture, view, 35.0, -60.0);
  }
}

TEST(HardCase, BoneAtTheSkinIsBrightAndDarkBehind) {
  const Scene s = scene([](const glm::dvec3&) { return TissueClass::bone; });
  const UltrasoundView view = curved_view();
  const PolarPicture picture = polar_of(s, view);
  expect_finite(picture);
  EXPECT_GT(at(picture, 64, 0), 10.0F);
  expect_dark_below(picture, view, 20.0, -60.0);
}

TEST(HardCase, AProbeInAirShowsItsLensAndNothingStale) {
  const UltrasoundView view = curved_view();
  const Scene liver = all_of(TissueClass::liver);
  PolarPicture picture = polar_of(liver, view);  // whatever it held before
  const std::vector<float> far(128, -30.0F);
  ultrasound_polar(liver.tissue(), view, {}, far, picture);
  expect_finite(picture);
  for (int b = 0; b < view.beams; ++b)
    for (int k = 0; k < view.samples; ++k) EXPECT_EQ(at(picture, b, k), at(picture, 0, k));
  for (int k = 1; k <= 5; ++k)
    EXPECT_NEAR(decibels(at(picture, 64, sample_at(view, k * kUsLensMm))), kUsLensDb - (k - 1) * kUsLensDbPerLine,
                1.5);
  expect_dark_below(picture, view, 35.0, -100.0);
}

TEST(HardCase, HalfOfTheFaceTouches) {
  UltrasoundView view = straight_view();
  const Scene liver = all_of(TissueClass::liver);
  std::vector<float> below(128, 0.5F);
  for (std::size_t i = 64; i < 128; ++i) below[i] = -1.01F;
  const PolarPicture whole = polar_of(liver, view), half = polar_of(liver, view, {}, below);
  for (int k = 0; k < view.samples; ++k) {
    EXPECT_EQ(at(half, 63, k), at(whole, 63, k));
    if (k > sample_at(view, 35.0)) {
      EXPECT_LT(at(half, 64, k), 1e-4F);
    }
  }
  std::fill(below.begin() + 64, below.end(), -1.0F);  // −1 mm still touches
  EXPECT_EQ(polar_of(liver, view, {}, below).envelope, whole.envelope);
  // Other numbers of beams ask the element they stand on.
  view.beams = 64;
  std::fill(below.begin() + 64, below.end(), -5.0F);
  const PolarPicture fewer = polar_of(liver, view, {}, below);
  EXPECT_GT(at(fewer, 31, 500), 1e-3F);
  EXPECT_LT(at(fewer, 32, 800), 1e-4F);
}

TEST(HardCase, ABlurredSkinIsCoupledByGel) {
  const Scene s = scene([](const glm::dvec3& p) { return p.y < 2.0 ? TissueClass::air : TissueClass::liver; },
                        {100, 120, 30}, 1.0);
  UltrasoundView view = straight_view();
  view.attenuation_db_cm_mhz = 0.0;
  const PolarPicture picture = polar_of(s, view);
  EXPECT_NEAR(level_db(picture, 0, 128, 200, 800), 0.0, 0.7);
  EXPECT_LT(at(picture, 64, 5), 1e-3F);  // gel is clear
}

// A beam along a slanted face leaves the first voxel of skin through a corner of air: no wall of gas.
TEST(HardCase, ACornerOfAirAtTheSkinIsCoupledToo) {
  const auto with = [](TissueClass corner) {
    return scene(
        [=](const glm::dvec3& p) {
          if (p.y < 0.0) return TissueClass::air;
          return std::abs(p.x) < 3.0 && p.y > 0.5 && p.y < 2.0 ? corner : TissueClass::liver;
        },
        {150, 200, 30}, 0.5);
  };
  UltrasoundView view = straight_view(40.0);
  view.origin_lps_mm.y = 0.3;
  const PolarPicture picture = polar_of(with(TissueClass::air), view);
  EXPECT_NEAR(level_db(picture, 56, 72, 300, 1000), level_db(picture, 20, 36, 300, 1000),
              2.0);  // gel takes nothing
  // Gas in the body is gas, however near.
  const PolarPicture gas = polar_of(with(TissueClass::gas), view);
  EXPECT_LT(level_db(gas, 58, 70, 600, 1000), level_db(gas, 20, 36, 600, 1000) - 40.0);
}

TEST(HardCase, OutsideTheCtIsAir) {
  const Scene s = scene([](const glm::dvec3&) { return TissueClass::liver; }, {20, 40, 20}, 2.0);  // ±20 mm, to 50
  UltrasoundView view = curved_view();
  view.attenuation_db_cm_mhz = 0.0;
  const PolarPicture picture = polar_of(s, view);
  expect_finite(picture);
  EXPECT_NEAR(level_db(picture, 60, 68, sample_at(view, 10.0), sample_at(view, 45.0)), 0.0, 1.0);
  EXPECT_LT(level_db(picture, 60, 68, sample_at(view, 53.0), sample_at(view, 90.0)), -60.0);
  // Wholly outside.
  view.origin_lps_mm = {500.0, 0.0, 0.0};
  const PolarPicture outside = polar_of(s, view);
  expect_finite(outside);
  expect_dark_below(outside, view, 35.0, -60.0);
}

TEST(HardCase, GasInTheDepthComesAgainAtTwiceItsDepth) {
  const Scene s = scene([](const glm::dvec3& p) { return p.y < 30.0 ? TissueClass::fluid : TissueClass::gas; });
  const UltrasoundView view = straight_view(100.0);
  const PolarPicture picture = polar_of(s, view);
  const auto level = [&](double depth_mm) {
    float most = 0.0F;
    for (int k = sample_at(view, depth_mm - 0.5); k < sample_at(view, depth_mm + 0.5); ++k)
      most = std::max(most, at(picture, 64, k));
    return decibels(most);
  };
  const double way_db = line_of(s, view, 64).loss_db[static_cast<std::size_t>(sample_at(view, 29.9))];
  EXPECT_NEAR(level(60.0) - level(30.0), -kUsRepeatDb - way_db, 1.0);
  EXPECT_NEAR(level(90.0) - level(60.0), -kUsRepeatDb - way_db, 1.0);
  EXPECT_LT(level(45.0), -60.0);
}

TEST(HardCase, AVesselFullOfContrastCastsNoShadow) {
  // Its HU of 300 says nothing here: its class does.
  Scene s = scene([](const glm::dvec3& p) {
    return std::hypot(p.x, p.y - 40.0) < 10.0 ? TissueClass::vessel : TissueClass::liver;
  });
  std::fill(s.volume.hu.begin(), s.volume.hu.end(), std::int16_t{300});
  UltrasoundView view = curved_view(100.0);
  const Line through = line_of(s, view, 64), beside = line_of(s, view, 10);
  const auto k = static_cast<std::size_t>(sample_at(view, 80.0));
  EXPECT_LT(through.loss_db[k], beside.loss_db[k]);  // blood takes less than liver
  const PolarPicture picture = polar_of(s, view);
  view.seed = 1;
  EXPECT_LT(level_db(picture, 62, 66, sample_at(view, 34), sample_at(view, 46)),
            level_db(picture, 62, 66, sample_at(view, 15), sample_at(view, 28)) - 25.0);
}

TEST(HardCase, OneVoxelOfCalcificationShadowsItsOwnBeamsOnly) {
  Scene s = all_of(TissueClass::liver);
  // The voxel that holds (1, 31, 0).
  const glm::dvec3 index = glm::dvec3(volume::voxel_from_lps(s.volume) * glm::dvec4(1.0, 31.0, 0.5, 1.0));
  const glm::ivec3 v(glm::floor(index + 0.5));
  s.classes[s.volume.index(v.x, v.y, v.z)] = TissueClass::bone;
  UltrasoundView view = straight_view();
  view.attenuation_db_cm_mhz = 0.0;
  view.origin_lps_mm.z = 0.5;
  int shadowed = 0;
  for (int b = 0; b < view.beams; ++b) shadowed += line_of(s, view, b).loss_db.back() > 6.0F;
  EXPECT_NEAR(shadowed * 0.3, 2.0, 0.35);  // 2 mm
}

// It has liver on both sides alike: no normal can be told, and rounding must not invent one.
TEST(HardCase, ASheetOfOneVoxelFacesTheBeam) {
  const Scene s =
      scene([](const glm::dvec3& p) { return p.y > 20.0 && p.y < 22.0 ? TissueClass::bone : TissueClass::liver; });
  const UltrasoundView view = straight_view();
  const Line line = line_of(s, view, 64);
  ASSERT_EQ(line.echoes.size(), 2U);
  for (const LineEcho& echo : line.echoes) EXPECT_NEAR(echo.depth_mm, 21.0, 2.0);
  const auto mrayl = [](TissueClass tissue) {
    return acoustic_table()[static_cast<std::size_t>(tissue)].impedance_mrayl;
  };
  const double reflection = shaders::us_reflection(mrayl(TissueClass::liver), mrayl(TissueClass::bone));
  EXPECT_NEAR(line.echoes[0].amplitude,
              reflection * shaders::us_interface_law(1.0) *
                  shaders::us_amplitude(kUsInterfaceDb - shaders::us_loss_db_per_mm(0.5, 1.0, 7.6) * 20.0),
              0.3);
}

TEST(HardCase, AnisotropicVoxelsOfASlantedPatient) {
  Scene s;
  const double c = std::cos(0.4), n = std::sin(0.4);
  s.volume = volume::make_volume({300, 300, 24}, {0.7, 0.7, 5.0}, glm::dmat3(c, n, 0, -n, c, 0, 0, 0, 1),
                                 {-60.0, -120.0, -57.5});
  s.classes.assign(s.volume.hu.size(), TissueClass::liver);
  UltrasoundView view = straight_view();
  view.attenuation_db_cm_mhz = 0.0;
  const PolarPicture picture = polar_of(s, view);
  EXPECT_NEAR(level_db(picture, 0, 128, 100, 900), 0.0, 0.5);
  // The same tissue on another grid has the same scatterers.
  EXPECT_EQ(picture.envelope, polar_of(all_of(TissueClass::liver), view).envelope);
}

TEST(HardCase, FiftyMillimetresOfBoneDoNotUnderflow) {
  const Scene s =
      scene([](const glm::dvec3& p) { return p.y > 10.0 && p.y < 60.0 ? TissueClass::bone : TissueClass::liver; });
  const UltrasoundView view = curved_view();
  const Line line = line_of(s, view, 64);
  EXPECT_NEAR(line.loss_db[static_cast<std::size_t>(sample_at(view, 59.0))], 0.2 * 8.0 * 3.57 * 49.0 + 4.8 + 3.6,
              2.0);
  expect_finite(polar_of(s, view));
}

TEST(HardCase, LesionsShowAsTheirTissue) {
  UltrasoundView view = curved_view();
  view.attenuation_db_cm_mhz = 0.0;
  Inserted inserted;
  inserted.lesions.push_back({{0.0, 60.0, 0.0}, 10.0, 0.0});
  const PolarPicture picture = polar_of(all_of(TissueClass::liver), view, inserted);
  EXPECT_LT(level_db(picture, 63, 65, sample_at(view, 54), sample_at(view, 66)), -30.0);
  EXPECT_NEAR(level_db(picture, 10, 30, sample_at(view, 54), sample_at(view, 66)), 0.0, 1.0);
}

TEST(HardCase, FewBeamsAndSamplesAndGreatNumbers) {
  const Scene s = all_of(TissueClass::liver);
  for (const auto& [beams, samples] : std::vector<std::pair<int, int>>{{1, 1}, {2, 2}, {3, 50}, {1024, 256}}) {
    UltrasoundView view = curved_view();
    view.beams = beams, view.samples = samples;
    expect_finite(polar_of(s, view));
  }
  UltrasoundView far = straight_view();  // lattice numbers beyond 2²⁴ and negative ones
  far.origin_lps_mm = {-9e6, 9e6, -9e6};
  expect_finite(polar_of(s, far));
}

TEST(HardCase, LookingFromEverySideIsTheSameLiver) {
  const Scene s = scene([](const glm::dvec3&) { return TissueClass::liver; }, {120, 120, 120}, 2.0);
  for (int i = 0; i < 8; ++i) {
    const double a = i * M_PI / 4.0;
    UltrasoundView view = straight_view();
    view.attenuation_db_cm_mhz = 0.0;
    view.origin_lps_mm = {0.0, 90.0, 0.0};
    view.axial = {std::cos(a), std::sin(a), 0.0};
    view.lateral = {0.6 * -std::sin(a), 0.6 * std::cos(a), 0.8};
    EXPECT_NEAR(level_db(polar_of(s, view), 0, 128, 50, 1000), 0.0, 0.3) << i;
  }
}

TEST(HardCase, GrazingASurfaceIsFinite) {
  for (const double tilt_deg : {80.0, 85.0, 89.0, 90.0}) {
    const double tilt = tilt_deg * M_PI / 180.0;
    const glm::dvec3 normal(std::sin(tilt), std::cos(tilt), 0.0);
    const Scene s = scene(
        [&](const glm::dvec3& p) {
          return glm::dot(p - glm::dvec3(0.3, 20.0, 0.0), normal) < 0.0 ? TissueClass::liver : TissueClass::bone;
        },
        {60, 80, 20}, 1.0);
    for (const UltrasoundView& view : {curved_view(50.0), straight_view()}) {
      const PolarPicture picture = polar_of(s, view);
      expect_finite(picture);
      // Beams wholly on liver's side do not know of it.
      const PolarPicture without = polar_of(all_of(TissueClass::liver), view);
      if (tilt_deg == 90.0 && !fan_of(view).curved) {
        // Where the volume ends, 50 mm deep, speckle fades out within a voxel.
        for (int k = 0; k < sample_at(view, 48.0); ++k)
          EXPECT_NEAR(at(picture, 20, k), at(without, 20, k), 1e-6F) << k;
      }
    }
  }
}

TEST(HardCase, AMetalClipIsBrightAndShadows) {
  Scene s = all_of(TissueClass::liver);
  const glm::dvec3 index = glm::dvec3(volume::voxel_from_lps(s.volume) * glm::dvec4(1.0, 31.0, 0.5, 1.0));
  const glm::ivec3 v(glm::floor(index + 0.5));
  const std::size_t clip = s.volume.index(v.x, v.y, v.z);
  s.classes[clip] = TissueClass::metal;
  s.volume.hu[clip] = 30000;
  UltrasoundView view = straight_view();
  view.attenuation_db_cm_mhz = 0.0;
  view.origin_lps_mm.z = 0.5;
  const PolarPicture picture = polar_of(s, view), without = polar_of(all_of(TissueClass::liver), view);
  expect_finite(picture);
  const int beam = static_cast<int>(1.0 / 0.3 + 63.5);
  float most = 0.0F;
  // Within its voxel: one alone has no wall to lie on.
  for (int k = sample_at(view, 29.9); k < sample_at(view, 32.1); ++k) most = std::max(most, at(picture, beam, k));
  EXPECT_GT(decibels(most), 20.0);
  const auto level = [&](const PolarPicture& p) {
    return level_db(p, beam - 1, beam + 2, sample_at(view, 36.0), sample_at(view, 49.0));
  };
  EXPECT_LT(level(picture), level(without) - 20.0);
}

// A scanner that maps its brightest echo to white dims everything when bone comes in.
TEST(HardCase, BoneInSomeBeamsLeavesTheOthersGreys) {
  const Scene bone =
      scene([](const glm::dvec3& p) { return p.x > 8.0 && p.y > 10.0 ? TissueClass::bone : TissueClass::liver; });
  const UltrasoundView view = straight_view();
  const ScanConverter converter(view, {256, 256});
  std::vector<unsigned char> with, without;
  converter.grey(view, {}, polar_of(bone, view), with);
  converter.grey(view, {}, polar_of(all_of(TissueClass::liver), view), without);
  int compared = 0;
  for (int r = 0; r < 256; ++r)
    for (int c = 0; c < 256; ++c) {
      const double x_mm = (c - 127.5) * converter.pixel_mm();
      if (x_mm > 5.0) continue;
      ++compared;
      ASSERT_EQ(with[static_cast<std::size_t>(r * 256 + c)], without[static_cast<std::size_t>(r * 256 + c)]);
    }
  EXPECT_GT(compared, 10000);
}

// Between a sample that is loud and one that is silent the screen shows half the amplitude, not half the decibels.
TEST(HardCase, LevelsAreInterpolatedBeforeTheirLogarithm) {
  UltrasoundView view = straight_view();
  view.beams = 8;
  PolarPicture polar{view.beams, view.samples, {}};
  for (int b = 0; b < view.beams; ++b)
    polar.envelope.insert(polar.envelope.end(), static_cast<std::size_t>(view.samples), b == 3 ? 1.0F : 0.0F);
  const ScanConverter converter(view, {800, 400});
  std::vector<unsigned char> grey;
  converter.grey(view, {}, polar, grey);
  int halves = 0;
  for (int c = 0; c < 800; ++c) {
    const double z_mm = converter.top_mm() + 200.5 * converter.pixel_mm();
    const BeamAndDepth place = beam_and_depth(view, (c - 399.5) * converter.pixel_mm(), z_mm);
    if (std::abs(place.beam - 3.5) > 0.02) continue;
    ++halves;
    const double share = 4.0 - place.beam;
    EXPECT_NEAR(grey[static_cast<std::size_t>(200 * 800 + c)],
                255.0 * (decibels(share) + display_gain_db(view, {}, z_mm) - kWhiteDb + 60.0) / 60.0, 1.0);
  }
  EXPECT_GE(halves, 1);
}

TEST(HardCase, SlidersFarBeyondTheirRangeEndAtBlackAndWhite) {
  const UltrasoundView view = straight_view();
  const PolarPicture polar = polar_of(all_of(TissueClass::liver), view);
  const ScanConverter converter(view, {100, 100});
  UltrasoundKnobs knobs;
  std::vector<unsigned char> grey;
  knobs.tgc_db.fill(400.0);
  converter.grey(view, knobs, polar, grey);
  EXPECT_EQ(grey[50 * 100 + 50], 255);
  knobs.tgc_db.fill(-400.0);
  converter.grey(view, knobs, polar, grey);
  EXPECT_EQ(*std::max_element(grey.begin(), grey.end()), 0);
}

TEST(HardCase, AnObliqueWallInThickSlicesStaysAWall) {
  // 0.7 × 0.7 × 5 mm voxels, a wall of bone leaning along all three axes.
  Scene s;
  s.volume = volume::make_volume({120, 160, 16}, {0.7, 0.7, 5.0}, glm::dmat3(1.0), {-42.0, -30.0, -37.5});
  s.classes.resize(s.volume.hu.size());
  const glm::dvec3 normal = glm::normalize(glm::dvec3(0.15, 1.0, 0.1));
  for (int k = 0; k < 16; ++k)
    for (int j = 0; j < 160; ++j)
      for (int i = 0; i < 120; ++i) {
        const glm::dvec3 p(s.volume.lps_from_voxel * glm::dvec4(i, j, k, 1.0));
        s.classes[s.volume.index(i, j, k)] =
            glm::dot(p - glm::dvec3(0.0, 25.0, 0.0), normal) < 0.0 ? TissueClass::liver : TissueClass::bone;
      }
  UltrasoundView view = straight_view();
  view.attenuation_db_cm_mhz = 0.0;
  int seen = 0;
  for (int b = 4; b < view.beams; b += 5) {
    const Line line = line_of(s, view, b);
    ASSERT_FALSE(line.echoes.empty()) << b;
    const double x_mm = point_of(view, b, 0.0).x;
    EXPECT_NEAR(line.echoes.front().depth_mm, 25.0 - x_mm * normal.x / normal.y, 0.7) << b;
    ++seen;
  }
  EXPECT_GE(seen, 20);
}

}  // namespace
}  // namespace seldinger::imaging
