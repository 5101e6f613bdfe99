// Shadows behind the edges of round bodies, the law against Snell's, and lung as a mirror; in the picture.
#include "shaders/shared/ultrasound_line.glsl.h"
#include "shaders/shared/ultrasound_mirror.glsl.h"
#include "sim/imaging/ultrasound/mirror.h"
#include "tests/sim/imaging/ultrasound/ultrasound_scene.h"

namespace seldinger::imaging {
namespace {

// By Snell's law, without approximation: how far a ray is turned towards the middle of a ball.
double turned_by_snell(double n, double off_radii) {
  return 2.0 * (std::asin(off_radii) - std::asin(off_radii / n));
}

TEST(EdgeShadow, TurnsRaysAsSnellsLawDoes) {
  for (const double n : {1540.0 / 1510.0, 1540.0 / 1575.0, 1462.0 / 1510.0})
    for (double off = -0.8; off <= 0.8; off += 0.1)
      EXPECT_NEAR(shaders::us_turned_rad(n - 1.0, off), turned_by_snell(n, off),
                  0.15 * std::abs(turned_by_snell(n, off)) + 1e-9)
          << n << ' ' << off;
  EXPECT_EQ(shaders::us_turned_rad(0.02, 1.0), 0.0);  // it runs by
}

TEST(EdgeShadow, RaysPartAtTheEdgeAndNotInTheMiddle) {
  constexpr double kRadiusMm = 10.0, kWidthMm = 1.5, kBehindMm = 40.0, kFluid = 1540.0 / 1510.0 - 1.0;
  const auto left_db = [](double off, double radius_mm) {
    const double cosine = std::sqrt(1.0 - off * off);
    const double parting = shaders::us_parting_per_mm(kFluid, 0.0, 2.0 * radius_mm * cosine, cosine, kWidthMm);
    return decibels(shaders::us_behind_edge(parting, kBehindMm));
  };
  EXPECT_EQ(left_db(0.0, kRadiusMm), 0.0);
  EXPECT_LT(left_db(0.95, kRadiusMm), -6.0);
  EXPECT_GE(left_db(0.95, kRadiusMm), -shaders::kUsMostEdgeDb - 1e-9);
  EXPECT_EQ(left_db(0.95, 0.5 * shaders::kUsLeastRoundMm), 0.0);
  EXPECT_EQ(shaders::us_behind_edge(0.5, -1.0), 1.0);  // before it
}

// A gallbladder across the picture, or a cyst: 10 mm of radius, 45 mm deep.
const glm::dvec3 kMiddle(0.0, 45.0, 0.0);
constexpr double kCystMm = 10.0;

// Mean levels 35 to 55 mm behind the cyst's middle, of beams that pass it at these shares of its radius.
double behind_db(const PolarPicture& picture, const UltrasoundView& view, double from, double to) {
  double sum = 0.0;
  int count = 0;
  for (int b = 0; b < view.beams; ++b) {
    const glm::dvec3 start = point_of(view, b, 0.0), along = glm::normalize(point_of(view, b, 1.0) - start);
    const double off = glm::length(glm::cross(kMiddle - start, along)) / kCystMm;
    if (off < from || off > to) continue;
    for (int k = sample_at(view, kMiddle.y + 35.0); k < sample_at(view, kMiddle.y + 55.0); ++k, ++count)
      sum += std::pow(static_cast<double>(at(picture, b, k)), 2.0);
  }
  EXPECT_GT(count, 0);
  return 10.0 * std::log10(sum / count);
}

TEST(EdgeShadow, IsSeenBehindACystAsSphereAndInTheVolume) {
  const Scene liver = all_of(TissueClass::liver);
  const Scene drawn = scene(
      [](const glm::dvec3& p) {
        return glm::length(p - kMiddle) < kCystMm ? TissueClass::fluid : TissueClass::liver;
      },
      {110, 160, 60}, 1.0);
  UltrasoundView view = curved_view(110.0);
  view.attenuation_db_cm_mhz = 0.0;
  view.beams = 256;
  Inserted cyst;
  cyst.lesions.push_back({kMiddle, kCystMm, 8.0});  // by HU: fluid
  UltrasoundView old = view;
  old.sight_law = cases::SightLaw::half_slice;
  for (const auto& [picture, without] : {std::pair{polar_of(liver, view, cyst), polar_of(liver, old, cyst)},
                                         std::pair{polar_of(drawn, view), polar_of(drawn, old)}}) {
    const double edge = behind_db(picture, view, 0.92, 1.0);
    printf("behind the edge %.1f dB, the middle %.1f dB, beside it %.1f dB\n", edge,
           behind_db(picture, view, 0.0, 0.5), behind_db(picture, view, 1.2, 1.6));
    EXPECT_LT(edge, behind_db(without, view, 0.92, 1.0) - 3.0);
    EXPECT_NEAR(behind_db(picture, view, 0.0, 0.6), behind_db(without, view, 0.0, 0.6), 0.5);
    EXPECT_EQ(behind_db(picture, view, 1.2, 1.6), behind_db(without, view, 1.2, 1.6));
  }
}

// By how far a ball reaches to both sides of the beam, and a layer, at any tilt.
TEST(EdgeShadow, ABallIsToldFromALayerByItsWidth) {
  constexpr double kWidthMm = 1.5, kFluid = 1540.0 / 1510.0 - 1.0;
  for (const double radius_mm : {4.0, 10.0, 25.0})
    for (double off = 0.0; off < 0.96; off += 0.05) {
      const double cosine = std::sqrt(1.0 - off * off);
      const double by_width = shaders::us_parting_by_width(kFluid, 0.0, radius_mm * (1.0 + off),
                                                           radius_mm * (1.0 - off), kWidthMm),
                   by_chord = shaders::us_parting_per_mm(kFluid, 0.0, 2.0 * radius_mm * cosine, cosine, kWidthMm);
      EXPECT_NEAR(by_width, std::clamp(by_chord, -shaders::kUsMostPartingPerMm, shaders::kUsMostPartingPerMm), 1e-9)
          << radius_mm << ' ' << off;
      EXPECT_EQ(shaders::us_parting_by_width(kFluid, 0.0, radius_mm, radius_mm, kWidthMm), 0.0);
    }
  EXPECT_EQ(shaders::us_stronger(0.1, -0.2), -0.2);
}

// A vein across the picture in fat, told by voxels, with muscle before it and an artery behind: its shadows are
// those of its circle, and none is cast from its middle.
TEST(EdgeShadow, OfAVoxelVesselIsItsCirclesOwn) {
  const glm::dvec3 vein(0.3, 22.0, 0.0), artery(4.0, 34.0, 0.0);
  constexpr double kVeinMm = 6.5, kArteryMm = 4.0;
  const auto away = [](const glm::dvec3& p, const glm::dvec3& axis) {
    return std::hypot(p.x - axis.x, p.y - axis.y);
  };
  const Scene s = scene(
      [&](const glm::dvec3& p) {
        if (away(p, vein) < kVeinMm || away(p, artery) < kArteryMm) return TissueClass::vessel;
        return p.y < 13.0 + 0.3 * p.x ? TissueClass::muscle : TissueClass::fat;
      },
      {60, 60, 20}, 1.0);
  const UltrasoundView view = straight_view(30.0);  // no deeper than the vein's shadow
  const double inside = shaders::us_shift_per_mm(1.575), outside = shaders::us_shift_per_mm(1.462);
  const double width_mm = shaders::us_lateral_fwhm_mm(vein.y, shaders::us_wavelength_mm(view.probe.frequency_mhz),
                                                      view.probe.f_number, view.probe.aperture_mm, view.focus_mm);
  int at_edges = 0;
  for (int b = 0; b < view.beams; ++b) {
    const double off = std::abs(point_of(view, b, 0.0).x - vein.x) / kVeinMm;
    double parting = 0.0;
    for (const LineEcho& echo : line_of(s, view, b).echoes)
      if (echo.depth_mm < 30.0) parting += echo.parting_per_mm;
    if (off < 0.4 || off > 1.15) {
      EXPECT_EQ(parting, 0.0) << off;
    } else if (off > 0.7 && off < 0.88) {
      const double cosine = std::sqrt(1.0 - off * off);
      const double wanted =
          std::min(shaders::kUsMostPartingPerMm,
                   shaders::us_parting_per_mm(inside, outside, 2.0 * kVeinMm * cosine, cosine, width_mm));
      EXPECT_GT(parting / wanted, 0.5) << off;  // half a voxel to a side counts for so much there
      EXPECT_LT(parting / wanted, 2.0) << off;
      ++at_edges;
    }
  }
  EXPECT_GE(at_edges, 6);
}

// Whether any beam's rays part.
bool casts_shadows(const Scene& s, const UltrasoundView& view) {
  for (int b = 0; b < view.beams; ++b)
    for (const LineEcho& echo : line_of(s, view, b).echoes)
      if (echo.parting_per_mm != 0.0) return true;
  return false;
}

// What has two sides that run along each other is no round body, at any tilt.
TEST(EdgeShadow, IsNotCastByLayers) {
  for (const double slope : {0.3, 1.0, 2.2})
    for (const TissueClass flat : {TissueClass::fluid, TissueClass::vessel})
      for (const TissueClass beyond : {TissueClass::liver, TissueClass::fat}) {
        const Scene layers = scene([&](const glm::dvec3& p) {
          if (p.y < 15.0 + slope * p.x) return TissueClass::muscle;
          return p.y < 25.0 + slope * p.x ? flat : beyond;
        });
        const UltrasoundView view = straight_view(80.0);
        EXPECT_FALSE(casts_shadows(layers, view)) << slope;
        UltrasoundView old = view;
        old.sight_law = cases::SightLaw::scatter;
        if (slope > 2.0 && flat == TissueClass::fluid && beyond == TissueClass::liver) {
          EXPECT_TRUE(casts_shadows(layers, old)) << "what was published keeps the shadow of a ball";
        }
      }
}

// Liver down to lung, whose surface lies 60 mm deep and rises to the right; in the liver a cyst.
constexpr double kLungMm = 60.0, kRise = 0.25;
const glm::dvec3 kAboveLung(-4.0, 42.0, 0.0);
constexpr double kMirroredMm = 6.0;
Scene liver_on_lung() {
  return scene(
      [](const glm::dvec3& p) {
        if (p.y > kLungMm - kRise * p.x) return TissueClass::lung;
        return glm::length(p - kAboveLung) < kMirroredMm ? TissueClass::fluid : TissueClass::liver;
      },
      {130, 140, 40}, 1.0);
}

double around_db(const PolarPicture& picture, const UltrasoundView& view, const glm::dvec3& p) {
  const BeamAndDepth at = beam_and_depth(view, p.x, p.y);
  const int b = static_cast<int>(std::lround(at.beam)), k = sample_at(view, at.depth_mm);
  return level_db(picture, b - 2, b + 3, k - 20, k + 20);
}

TEST(LungMirror, ShowsWhatLiesBeforeItBehindIt) {
  const Scene s = liver_on_lung();
  UltrasoundView view = curved_view(110.0), old = view;
  old.sight_law = cases::SightLaw::half_slice;
  const PolarPicture now = polar_of(s, view), before = polar_of(s, old);
  // Where the cyst and the liver beside it seem to lie, by the closed form of the surface.
  const glm::dvec3 normal = glm::normalize(glm::dvec3(kRise, 1.0, 0.0));
  const auto behind = [&](const glm::dvec3& p) {
    return p + 2.0 * glm::dot(glm::dvec3(0.0, kLungMm, 0.0) - p, normal) * normal;
  };
  const glm::dvec3 beside = kAboveLung + glm::dvec3(-14.0, 0.0, 0.0);
  const double loss_db = shaders::us_loss_db_per_mm(kAssumedAttenuationDbCmMhz, 1.0, view.probe.frequency_mhz);
  const auto loss_to = [&](const glm::dvec3& p) { return loss_db * beam_and_depth(view, p.x, p.y).depth_mm; };
  const double reflection = shaders::us_reflection(1.66, 0.20);
  const double share_db = decibels(shaders::us_mirrored_share(reflection));
  EXPECT_NEAR(around_db(now, view, behind(beside)) + loss_to(behind(beside)),
              around_db(now, view, beside) + loss_to(beside) + share_db, 3.0);
  EXPECT_LT(around_db(now, view, behind(kAboveLung)), around_db(now, view, behind(beside)) - 10.0);
  EXPECT_LT(around_db(before, old, behind(beside)), around_db(now, view, behind(beside)) - 30.0);
  // What lies before lung is what it was.
  for (int b = 0; b < view.beams; ++b)
    for (int k = 0; k < sample_at(view, 30.0); ++k) ASSERT_EQ(at(now, b, k), at(before, b, k));
}

TEST(LungMirror, IsNotThereBehindBoneOrGasOrInAir) {
  for (const TissueClass shade : {TissueClass::bone, TissueClass::gas}) {
    const Scene s = scene(
        [&](const glm::dvec3& p) {
          if (p.y > 20.0 && p.y < 26.0) return shade;
          return p.y > 60.0 ? TissueClass::lung : TissueClass::liver;
        },
        {130, 140, 20}, 1.0);
    const UltrasoundView view = curved_view(110.0);
    const TissueAt tissue_at(s.tissue(), {});
    EXPECT_TRUE(mirrors_of(view, tissue_at, nullptr, {}).empty());
  }
  const Scene s = liver_on_lung();
  const UltrasoundView view = curved_view(110.0);
  const TissueAt tissue_at(s.tissue(), {});
  EXPECT_FALSE(mirrors_of(view, tissue_at, nullptr, {}).empty());
  const std::vector<float> in_air(static_cast<std::size_t>(view.probe.elements), -10.0F);
  EXPECT_TRUE(mirrors_of(view, tissue_at, nullptr, in_air).empty());
  EXPECT_TRUE(mirrors_of(curved_view(40.0), tissue_at, nullptr, {}).empty());  // deeper than the picture
}

// Mean square echo of beams about the middle at a depth, a mm either way.
double power_db(const PolarPicture& picture, const UltrasoundView& view, double depth_mm) {
  return level_db(picture, 40, 88, sample_at(view, depth_mm - 1.0), sample_at(view, depth_mm + 1.0));
}

TEST(Clutter, FillsWhatIsBlackAndFallsWithDepth) {
  const Scene fluid = all_of(TissueClass::fluid), liver = all_of(TissueClass::liver);
  for (const UltrasoundView& view : {curved_view(100.0), straight_view(50.0)}) {
    const PolarPicture empty = polar_of(fluid, view), without = polar_of(liver, view);
    PolarPicture cyst = empty, tissue = without;
    add_clutter(view, {}, cyst);
    add_clutter(view, {}, tissue);
    double last_below_db = 0.0;
    for (const double share : {0.1, 0.3, 0.5}) {
      const double depth_mm = share * view.depth_mm, liver_db = power_db(without, view, depth_mm);
      const double both =
          std::pow(10.0, 0.1 * clutter_db(view, depth_mm)) + std::pow(10.0, 0.1 * power_db(empty, view, depth_mm));
      EXPECT_NEAR(power_db(cyst, view, depth_mm), 10.0 * std::log10(both), 1.0) << depth_mm;
      EXPECT_NEAR(power_db(tissue, view, depth_mm), liver_db, 0.3) << depth_mm;
      const double below_db = liver_db - power_db(cyst, view, depth_mm);
      EXPECT_GT(below_db, last_below_db + 1.0);
      last_below_db = below_db;
    }
  }
  // In the picture of a gallbladder 5 cm deep: within what was measured in bladders.
  EXPECT_GT(clutter_db(curved_view(), 50.0) + 0.2 * 0.5 * 3.57 * 50.0, -31.0);
}

TEST(Clutter, LiesStillIsNotInAirAndOfTheNewestLawAlone) {
  const Scene fluid = all_of(TissueClass::fluid);
  const UltrasoundView view = straight_view(50.0);
  const PolarPicture bare = polar_of(fluid, view);
  PolarPicture once = bare, again = bare, moved = bare, in_air = bare, older = bare;
  add_clutter(view, {}, once);
  add_clutter(view, {}, again);
  EXPECT_NE(once.envelope, bare.envelope);
  EXPECT_EQ(once.envelope, again.envelope);
  UltrasoundView away = view;
  away.origin_lps_mm.x += 7.0;
  add_clutter(away, {}, moved);
  EXPECT_EQ(moved.envelope, once.envelope) << "what lies behind moves, it does not";
  add_clutter(view, std::vector<float>(static_cast<std::size_t>(view.probe.elements), -10.0F), in_air);
  EXPECT_EQ(in_air.envelope, bare.envelope);
  away.sight_law = cases::SightLaw::scatter;
  add_clutter(away, {}, older);
  EXPECT_EQ(older.envelope, bare.envelope);
}

// Kept from picture to picture it is what each picture's own would be, whatever the console is set to meanwhile.
TEST(Clutter, IsTheSameWhereItIsKept) {
  const Scene fluid = all_of(TissueClass::fluid);
  UltrasoundView deeper = straight_view(60.0), other = straight_view(50.0), higher = straight_view(50.0);
  other.seed = 99;
  higher.frequency_mhz = 9.0;
  Clutter kept;
  std::vector<float> last;
  for (const UltrasoundView& view : {straight_view(50.0), deeper, other, higher, straight_view(50.0)}) {
    PolarPicture once = polar_of(fluid, view), again = once;
    add_clutter(view, {}, once);
    kept.add(view, {}, again);
    EXPECT_EQ(again.envelope, once.envelope);
    EXPECT_NE(again.envelope, last) << "the console shows in it";
    last = again.envelope;
  }
}

// What was published by an earlier law is drawn as it was, behind a cyst and behind lung.
TEST(Artefacts, AreOfNewerLawsAlone) {
  const Scene s = liver_on_lung();
  const TissueAt tissue_at(s.tissue(), {});
  const UltrasoundView view = curved_view(110.0);
  UltrasoundView half_slice = view, echo = view;
  half_slice.sight_law = cases::SightLaw::half_slice;
  echo.sight_law = cases::SightLaw::echo;
  EXPECT_NE(polar_of(s, view).envelope, polar_of(s, echo).envelope);
  EXPECT_EQ(polar_of(s, half_slice).envelope, polar_of(s, echo).envelope);
  EXPECT_FALSE(mirrors_of(view, tissue_at, nullptr, {}).empty());
  EXPECT_TRUE(mirrors_of(echo, tissue_at, nullptr, {}).empty());
}

// Sound is slower in fat, so that the console shows lung deeper than it lies: the mirror is where it is shown.
TEST(LungMirror, LiesWhereThePictureShowsLung) {
  constexpr double kFatMm = 25.0;
  const Scene s = scene(
      [](const glm::dvec3& p) {
        if (p.y > kLungMm) return TissueClass::lung;
        return p.y < kFatMm ? TissueClass::fat : TissueClass::liver;
      },
      {130, 140, 20}, 1.0);
  const TissueAt tissue_at(s.tissue(), {});
  const UltrasoundView view = straight_view(110.0);
  UltrasoundView shifted = view;
  shifted.range_error = true;
  const auto lies = mirrors_of(view, tissue_at, nullptr, {}), seems = mirrors_of(shifted, tissue_at, nullptr, {});
  ASSERT_EQ(lies.size(), static_cast<std::size_t>(view.beams));
  ASSERT_EQ(seems.size(), lies.size());
  const auto shift_mm = [](TissueClass tissue) {
    return shaders::us_shift_per_mm(1e-3 * acoustic_table()[static_cast<std::size_t>(tissue)].speed_m_s);
  };
  const double expected_mm =
      kFatMm * shift_mm(TissueClass::fat) + (kLungMm - kFatMm) * shift_mm(TissueClass::liver);
  EXPECT_GT(expected_mm, 0.5);
  const std::size_t middle = lies.size() / 2;
  EXPECT_NEAR(seems[middle].met.x - lies[middle].met.x, expected_mm, 0.1);
  EXPECT_NEAR(seems[middle].plane.y - lies[middle].plane.y, expected_mm, 0.1);
}

// Of one ray twice mirrored nothing is left to do: a mirror is its own way back.
TEST(LungMirror, IsItsOwnInverse) {
  const glm::dvec4 mirror(3.0, 50.0, std::sin(0.3), std::cos(0.3));
  const glm::dvec4 there = shaders::us_mirrored(mirror, -7.0, 80.0);
  const glm::dvec4 back = shaders::us_mirrored(mirror, there.x, there.y);
  EXPECT_NEAR(back.x, -7.0, 1e-12);
  EXPECT_NEAR(back.y, 80.0, 1e-12);
  EXPECT_LT((there.y - 50.0) * std::cos(0.3) + (there.x - 3.0) * std::sin(0.3), 0.0);  // before it
}

}  // namespace
}  // namespace seldinger::imaging
