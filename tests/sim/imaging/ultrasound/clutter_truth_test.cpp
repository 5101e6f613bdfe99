// What is told of a needle where clutter lies over it: the closed form of its limit, and detectors that look at
// pictures only.
#include <cmath>
#include <numbers>
#include <utility>

#include "shaders/shared/ultrasound.glsl.h"
#include "sim/base/rng.h"
#include "tests/sim/imaging/ultrasound/needle_detector.h"
#include "tests/sim/imaging/ultrasound/ultrasound_scene.h"

namespace seldinger::imaging {
namespace {

NeedlePose needle_through(const glm::dvec3& p_lps_mm, double tilt_deg, double behind_tip_mm) {
  const double a = tilt_deg * std::numbers::pi / 180.0;
  NeedlePose needle;
  needle.direction = {std::cos(a), std::sin(a), 0.0};
  needle.tip_lps_mm = p_lps_mm + behind_tip_mm * needle.direction;
  return needle;
}

double excess_db(const Scene& s, const UltrasoundView& view, const Inserted& inserted, double behind_tip_mm) {
  const NeedleLevel level = needle_level(s.tissue(), view, inserted, {}, behind_tip_mm);
  EXPECT_TRUE(level.in_field);
  return level.echo_db - level.background_db - kNeedleAboveDb;
}

// In fluid nothing but clutter hides a shaft, from the tilt on at which its echo has fallen to 6 dB above it.
TEST(ClutterTruth, InFluidASteepShaftEndsWhereClutterHidesIt) {
  const Scene fluid = all_of(TissueClass::fluid);
  for (UltrasoundView view : {curved_view(90.0), straight_view(40.0)})
    for (const double depth_mm : {15.0, 25.0}) {
      const double f = view.probe.frequency_mhz, loss_db = 0.2 * 0.002 * f * f * depth_mm;
      const double clutter =
          -kClutterBelowDb - (kClutterFallDbMm + 0.2 * kAssumedAttenuationDbCmMhz * f) * depth_mm;
      const double background =
          std::pow(10.0, 0.1 * clutter) + std::pow(10.0, 0.1 * kReceiverNoiseDb) + std::pow(10.0, -6.0);
      const double limit_deg =
          (kNeedleRoughDb - loss_db - 10.0 * std::log10(background) - kNeedleAboveDb) / kPlainFadeDbPerDeg;
      ASSERT_GT(limit_deg, 55.0);
      ASSERT_LT(limit_deg, 85.0);
      for (const double off_deg : {-0.5, 0.5}) {
        // On a beam's middle, so that the tilt to it is the one that is asked for.
        view.beams = view.probe.elements = 33;
        Inserted inserted;
        inserted.needle = needle_through(point_of(view, 16.0, depth_mm), limit_deg + off_deg, 20.0);
        UltrasoundView old = view;
        old.sight_law = cases::SightLaw::scatter;
        EXPECT_EQ(excess_db(fluid, view, inserted, 20.0) >= 0.0, off_deg < 0.0) << limit_deg;
        EXPECT_GE(excess_db(fluid, old, inserted, 20.0), 0.0) << "no clutter in cases of the law before";
      }
    }
}

// What is told of the whole shaft is the same answer, place by place; the steeper it is, the less.
TEST(ClutterTruth, TheShaftsLengthIsOfThePlacesThatStandOut) {
  const Scene s = scene([](const glm::dvec3& p) { return p.y < 10.0 ? TissueClass::liver : TissueClass::fluid; });
  double last_mm = 30.0;
  for (const double tilt_deg : {40.0, 65.0, 72.0, 80.0}) {
    const UltrasoundView view = straight_view(40.0);
    Inserted inserted;
    inserted.needle = needle_through(point_of(view, 64.0, 35.0), tilt_deg, 0.0);
    inserted.needle->length_mm = 30.0;
    double told_mm = 0.0;
    for (double behind_mm = 1.0; behind_mm < 30.0; behind_mm += kShaftStepMm)
      if (needle_level(s.tissue(), view, inserted, {}, behind_mm).stands_out()) told_mm += kShaftStepMm;
    EXPECT_NEAR(ultrasound_visible(s.tissue(), view, inserted, {}).visible.needle_length_mm, told_mm, 1e-9);
    EXPECT_LT(told_mm, last_mm) << tilt_deg;
    last_mm = told_mm;
  }
}

// A target of so little that clutter lies over it is not told: behind what takes more than the scanner makes up
// for.
TEST(ClutterTruth, FillsTargetsToo) {
  const Scene liver = all_of(TissueClass::liver);
  const UltrasoundView view = curved_view(100.0);
  UltrasoundView old = view;
  old.sight_law = cases::SightLaw::scatter;
  Inserted cyst;
  cyst.lesions.push_back({{0.0, 50.0, 0.0}, 12.0, 5.0});
  const double liver_db = -0.2 * 0.5 * view.probe.frequency_mhz * 50.0;
  const double filled = target_level(liver.tissue(), view, cyst, {}).contrast_db;
  EXPECT_NEAR(filled, clutter_db(view, 50.0) - liver_db, 1.0);
  EXPECT_LT(target_level(liver.tissue(), old, cyst, {}).contrast_db, filled - 5.0);
}

struct Drawn {
  UltrasoundView view;
  Inserted inserted;
  PolarPicture picture;
};
struct Asked {
  double behind_tip_mm, least_tilt_deg, off_widths;  // of the slice, at most
};
Drawn draw(const Scene& s, int i, const Asked& asked, base::Rng& rng) {
  Drawn drawn{i % 2 == 0 ? curved_view(90.0) : straight_view(40.0), {}, {}};
  UltrasoundView& view = drawn.view;
  view.probe.elements = view.beams = 33;
  view.samples = view.probe.radius_mm > 0.0 ? 600 : 500;
  view.seed = static_cast<std::uint64_t>(i) + 1;
  const double depth_mm = (0.3 + 0.5 * rng.uniform()) * view.depth_mm;
  const double fwhm_mm = elevation_fwhm_mm(view.probe, view.probe.frequency_mhz, depth_mm);
  const double tilt_deg = asked.least_tilt_deg + (85.0 - asked.least_tilt_deg) * rng.uniform();
  const glm::dvec3 off_mm(0.0, 0.0, 2.0 * asked.off_widths * fwhm_mm * (rng.uniform() - 0.5));
  // Anywhere between two lines: a tip that lies between them is weaker in the picture, and by what is told.
  const double beam = 15.5 + rng.uniform();
  drawn.inserted.needle = needle_through(point_of(view, beam, depth_mm) + off_mm, tilt_deg, asked.behind_tip_mm);
  drawn.picture = polar_of(s, view, drawn.inserted);
  add_clutter(view, {}, drawn.picture);
  add_receiver_noise(view.seed, 1, drawn.picture);
  return drawn;
}

TEST(NeedleTruth, IsWhatADetectorFindsWhoLooksAtThePictureOnly) {
  const Scene liver = all_of(TissueClass::liver);
  base::Rng rng(57);
  Agreement agreement;
  for (int i = 0; i < random_scenes(); ++i) {
    const Drawn drawn = draw(liver, i, {0.0, 0.0, 0.75}, rng);
    agreement.add(excess_db(liver, drawn.view, drawn.inserted, 0.0),
                  tip_detected(drawn.picture, drawn.view, *drawn.inserted.needle));
  }
  agreement.expect_holds("tip in liver", 30);
}

// Where clutter is what hides it: in fluid, in blood, and in both behind tissue.
TEST(ClutterTruth, IsWhatADetectorFindsWhoLooksAtThePictureOnly) {
  const auto behind = [](TissueClass wall, TissueClass lumen) {
    return scene([=](const glm::dvec3& p) { return p.y < 4.0 ? wall : lumen; }, {60, 60, 20}, 2.0);
  };
  const Scene scenes[] = {all_of(TissueClass::fluid), all_of(TissueClass::vessel),
                          behind(TissueClass::kidney, TissueClass::fluid),
                          behind(TissueClass::liver, TissueClass::vessel)};
  base::Rng rng(90);
  Agreement tips, shafts;
  int old_law_disagrees = 0;
  constexpr double kBehindTipMm = 20.0;
  for (int i = 0; i < random_scenes(); ++i) {
    const Scene& s = scenes[(i / 4) % 4];
    const bool tip = (i / 2) % 2 == 0;
    const double behind_mm = tip ? 0.0 : kBehindTipMm;
    const Drawn drawn = draw(s, i, tip ? Asked{0.0, 0.0, 1.5} : Asked{kBehindTipMm, 40.0, 0.75}, rng);
    const double above_db = excess_db(s, drawn.view, drawn.inserted, behind_mm);
    const NeedlePose& needle = *drawn.inserted.needle;
    const bool found = tip ? tip_detected(drawn.picture, drawn.view, needle)
                           : shaft_detected(drawn.picture, drawn.view, needle, behind_mm);
    (tip ? tips : shafts).add(above_db, found);
    UltrasoundView old = drawn.view;
    old.sight_law = cases::SightLaw::scatter;
    const double old_db = excess_db(s, old, drawn.inserted, behind_mm);
    old_law_disagrees += !tip && old_db > 3.0 && !found ? 1 : 0;
  }
  tips.expect_holds("tip in fluid and blood", 0);
  shafts.expect_holds("shaft in fluid and blood", 30);
  printf("without clutter in the law %d shafts would be told that nobody finds\n", old_law_disagrees);
  EXPECT_GT(old_law_disagrees, random_scenes() / 20);
}

}  // namespace
}  // namespace seldinger::imaging
