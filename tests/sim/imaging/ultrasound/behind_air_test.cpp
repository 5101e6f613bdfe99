// The haze behind gas and near lung: its law in pictures, that nothing of the tissue is in it, A-lines, and who has
// none of it.
#include "sim/imaging/ultrasound/behind_air.h"

#include "shaders/shared/ultrasound_line.glsl.h"
#include "sim/imaging/ultrasound/mirror.h"
#include "tests/sim/imaging/ultrasound/ultrasound_scene.h"

namespace seldinger::imaging {
namespace {

constexpr double kFrontMm = 30.0;

// Liver down to `front_mm`, then `behind`.
Scene liver_on(TissueClass behind, double front_mm = kFrontMm) {
  return scene([&](const glm::dvec3& p) { return p.y > front_mm ? behind : TissueClass::liver; }, {130, 140, 20},
               1.0);
}
// The same, with tissue again behind a slab of gas.
Scene slab_before(TissueClass behind) {
  return scene(
      [&](const glm::dvec3& p) {
        if (p.y > kFrontMm) return p.y < kFrontMm + 8.0 ? TissueClass::gas : behind;
        return TissueClass::liver;
      },
      {130, 140, 20}, 1.0);
}

std::vector<AirMet> met_in(const Scene& s, const UltrasoundView& view) {
  const TissueAt tissue_at(s.tissue(), {});
  return air_met(view, tissue_at, nullptr, {});
}

UltrasoundView before_haze(UltrasoundView view) {
  view.sight_law = cases::SightLaw::scatter;
  return view;
}

TEST(Haze, FallsBehindGasByItsLawAndIsNotBlack) {
  const Scene s = liver_on(TissueClass::gas);
  for (const UltrasoundView& view : {curved_view(100.0), straight_view(80.0)}) {
    const std::vector<AirMet> met = met_in(s, view);
    ASSERT_EQ(met.size(), static_cast<std::size_t>(view.beams));
    const AirMet& middle = met[met.size() / 2];
    // A beam that goes straight down; the border between voxels lies half a voxel before the first of gas.
    EXPECT_NEAR(middle.depth_mm, kFrontMm + 0.5, 0.6);
    EXPECT_NEAR(middle.loss_db, 0.2 * 0.5 * view.probe.frequency_mhz * middle.depth_mm, 0.2);
    EXPECT_NEAR(middle.source_db, 0.0, 1e-6);  // liver
    const PolarPicture picture = polar_of(s, view);
    for (const double behind_mm : {1.5, 4.0, 8.0, 15.0, 25.0}) {
      const int first = view.beams / 4, last = view.beams - first;
      double sum = 0.0;
      int count = 0;
      for (int b = first; b < last; ++b)
        for (int k = 0; k < view.samples; ++k) {
          const AirMet& here = met[static_cast<std::size_t>(b)];
          const double off_mm = (k + 0.5) * view.depth_mm / view.samples - here.shown_mm;
          if (std::abs(off_mm - behind_mm) > 0.5) continue;
          sum += std::pow(static_cast<double>(at(picture, b, k)), 2.0) *
                 std::pow(10.0, -0.1 * haze_db(view, here, off_mm));
          ++count;
        }
      ASSERT_GT(count, 100);
      EXPECT_NEAR(10.0 * std::log10(sum / count), 0.0, 1.0) << view.probe.name << ' ' << behind_mm;
      const double on_screen_db =
          haze_db(view, middle, behind_mm) + display_gain_db(view, {}, middle.shown_mm + behind_mm);
      const double black_db = kWhiteDb - UltrasoundKnobs{}.dynamic_range_db;
      EXPECT_GT(on_screen_db, behind_mm < 10.0 ? black_db + 10.0 : -kNoAirMm) << behind_mm;
    }
    // The rows: so far below liver's own level at that depth, without the ring.
    EXPECT_NEAR(haze_db(view, {TissueClass::lung}, 0.0), -kHazeBelowDb, 1e-9);
    const double liver_falls_db = 0.2 * kAssumedAttenuationDbCmMhz * view.probe.frequency_mhz * 20.0;
    EXPECT_NEAR(haze_db(view, {TissueClass::lung}, 20.0), -kHazeBelowDb - 20.0 * kHazeFallDbMm - liver_falls_db,
                1e-9);
    EXPECT_NEAR(haze_db(view, middle, 0.0) + middle.loss_db,
                10.0 * std::log10(std::pow(10.0, 0.1 * kRingDb) + std::pow(10.0, -0.1 * kHazeBelowDb)), 1e-9);
  }
}

TEST(Haze, HasNothingOfTheTissueInIt) {
  const UltrasoundView view = straight_view(60.0);
  const PolarPicture liver = polar_of(slab_before(TissueClass::liver), view),
                     fluid = polar_of(slab_before(TissueClass::fluid), view);
  UltrasoundView away = view;
  away.origin_lps_mm.x += 5.0;  // other tissue before the same front, and behind it
  const PolarPicture moved = polar_of(slab_before(TissueClass::liver), away);
  const PolarPicture whole = polar_of(all_of(TissueClass::liver), view);
  const AirMet met = met_in(slab_before(TissueClass::liver), view)[64];
  const double loss_db_mm = 0.2 * 0.5 * view.probe.frequency_mhz;
  std::vector<double> hazy, tissue, mirrored;  // without what all lose with depth
  for (int b = 8; b < view.beams - 8; ++b)
    for (int k = sample_at(view, kFrontMm + 4.0); k < sample_at(view, kFrontMm + 20.0); k += 3) {
      const double here = static_cast<double>(at(liver, b, k));
      // What lies behind gas counts 120 dB less, and before it nothing: but for that the haze is the same.
      ASSERT_NEAR(static_cast<double>(at(fluid, b, k)), here, 1e-4 * here + 1e-6);
      ASSERT_NEAR(static_cast<double>(at(moved, b, k)), here, 1e-4 * here + 1e-6);
      const double sample_mm = view.depth_mm / view.samples, depth_mm = (k + 0.5) * sample_mm;
      const int above = static_cast<int>((2.0 * met.shown_mm - depth_mm) / sample_mm);
      const auto without_loss = [&](const PolarPicture& picture, int sample) {
        return static_cast<double>(at(picture, b, sample)) *
               shaders::us_amplitude(loss_db_mm * (sample + 0.5) * sample_mm);
      };
      hazy.push_back(here * shaders::us_amplitude(-haze_db(view, met, depth_mm - met.shown_mm)));
      tissue.push_back(without_loss(whole, k));
      mirrored.push_back(without_loss(liver, above));
    }
  EXPECT_LT(std::abs(correlation(hazy, tissue)), 0.05);
  EXPECT_LT(std::abs(correlation(hazy, mirrored)), 0.05);
}

TEST(Haze, IsNotBehindBoneNorInAirNorByEarlierLaws) {
  const UltrasoundView view = curved_view(100.0);
  EXPECT_TRUE(met_in(liver_on(TissueClass::bone), view).empty());
  EXPECT_TRUE(met_in(liver_on(TissueClass::air), view).empty());
  EXPECT_TRUE(met_in(all_of(TissueClass::liver), view).empty());
  const Scene gas = liver_on(TissueClass::gas);
  EXPECT_TRUE(met_in(gas, before_haze(view)).empty());
  const int from = sample_at(view, kFrontMm + 3.0), to = sample_at(view, 1.9 * kFrontMm);
  const double clean_db = level_db(polar_of(gas, before_haze(view)), 40, 88, from, to),
               dirty_db = level_db(polar_of(gas, view), 40, 88, from, to);
  EXPECT_LT(clean_db, -60.0);
  EXPECT_GT(dirty_db, -40.0);
  const std::vector<float> in_air(static_cast<std::size_t>(view.probe.elements), -10.0F);
  EXPECT_EQ(polar_of(gas, view, {}, in_air).envelope, polar_of(gas, before_haze(view), {}, in_air).envelope);
  // What lies before gas is what it was.
  const PolarPicture now = polar_of(gas, view), then = polar_of(gas, before_haze(view));
  for (int b = 0; b < view.beams; ++b)
    for (int k = 0; k < sample_at(view, kFrontMm - 2.0); ++k) ASSERT_EQ(at(now, b, k), at(then, b, k));
}

// Of what scatters before gas: half of the last 20 mm, fluid.
TEST(Haze, IsOfWhatScattersBeforeIt) {
  const UltrasoundView view = straight_view(60.0);
  const auto middle_of = [&](double fluid_from_mm) {
    const Scene s = scene(
        [&](const glm::dvec3& p) {
          if (p.y > kFrontMm) return TissueClass::gas;
          return p.y > fluid_from_mm ? TissueClass::fluid : TissueClass::liver;
        },
        {130, 140, 20}, 1.0);
    return met_in(s, view)[64];
  };
  EXPECT_NEAR(middle_of(kFrontMm).source_db, 0.0, 0.1);
  EXPECT_NEAR(middle_of(kFrontMm - 10.0).source_db, -3.0, 0.3);
  EXPECT_NEAR(middle_of(0.0).source_db, -60.0, 1.0);
  EXPECT_NEAR(met_in(liver_on(TissueClass::gas, 2.0), view)[64].source_db, -10.0, 1.5);  // right below the skin
}

TEST(Haze, IsTheSameForAnyNumberOfThreads) {
  const Scene s = liver_on(TissueClass::gas);
  UltrasoundView one = curved_view(100.0), three = one;
  one.threads = 1;
  three.threads = 3;
  EXPECT_EQ(polar_of(s, one).envelope, polar_of(s, three).envelope);
}

TEST(Haze, NearLungShowsItsSurfaceAgainAndFarLungAMirror) {
  const double pleura_mm = 20.0;
  const Scene near = liver_on(TissueClass::lung, pleura_mm), far = liver_on(TissueClass::lung, 50.0);
  UltrasoundView view = straight_view(80.0);
  view.samples = 2048;
  const PolarPicture picture = polar_of(near, view);
  const double met_mm = met_in(near, view)[64].depth_mm;
  const auto peak_db = [&](double depth_mm) {
    double most = -200.0;
    for (int k = sample_at(view, depth_mm - 0.5); k <= sample_at(view, depth_mm + 0.5); ++k)
      most = std::max(most, level_db(picture, 40, 88, k, k + 1));
    return most;
  };
  // As much below the surface's own echo as a way there and back and a reflection at the face take.
  const double loss_db = 0.2 * 0.5 * view.probe.frequency_mhz * met_mm;
  const double face_db = decibels(std::abs(shaders::us_reflection(1.66, 0.20))) + kUsInterfaceDb - loss_db;
  for (int again = 2; again <= 3; ++again)
    EXPECT_NEAR(peak_db(again * met_mm), face_db - (again - 1) * (kUsRepeatDb + loss_db), 1.0) << again;
  EXPECT_LT(peak_db(1.5 * met_mm), peak_db(2.0 * met_mm) - 10.0);
  for (const AirMet& met : met_in(far, view)) EXPECT_FALSE(has_haze(view, met));
  EXPECT_TRUE(mirrors_of(view, met_in(near, view)).empty());
  EXPECT_FALSE(mirrors_of(view, met_in(far, view)).empty());
}

}  // namespace
}  // namespace seldinger::imaging
