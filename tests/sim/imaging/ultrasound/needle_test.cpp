// The needle in the picture (goals 11 to 13, hard cases).
#include "app/measure/ultrasound_goals/needle.h"
#include "shaders/shared/ultrasound.glsl.h"
#include "tests/sim/imaging/ultrasound/ultrasound_scene.h"

namespace seldinger::imaging {
namespace {

const Scene& water() {
  static const Scene kWater = all_of(TissueClass::fluid);
  return kWater;
}

using measure::needle_at;
using measure::needle_grey;
using measure::peak_of;

TEST(Goal11, TheNeedleIsWhereItIs) {
  for (const Probe& probe : kRealProbes) expect_holds(practised(probe), &measure::measure_needle_place);
}

TEST(Goal12, TheNeedleFadesWithItsTilt) {
  for (const Probe& probe : kRealProbes) {
    const measure::Setting setting = practised(probe);
    expect_holds(setting, &measure::measure_needle_fading);
    double before = needle_grey(setting, 0.0, false);
    EXPECT_NEAR(before, 1.0, 0.001);
    for (const double tilt_deg : {10.0, 20.0, 30.0, 40.0, 50.0, 60.0}) {
      const double now = needle_grey(setting, tilt_deg, false);
      EXPECT_LT(now, before) << tilt_deg;
      EXPECT_LT(now, needle_grey(setting, tilt_deg, true)) << tilt_deg;
      before = now;
    }
    // Mostly invisible beyond 50°: below liver's own grey.
    EXPECT_LT(needle_grey(setting, 50.0, false), shaders::us_grey(-2.5, kWhiteDb, 60.0) / 255.0);
  }
}

TEST(Goal13, TheSliceIsAsThickAsTheBeam) {
  for (const Probe& probe : kRealProbes) expect_holds(practised(probe), &measure::measure_slice);
}

TEST(Needle, AcrossThePlaneItIsADot) {
  Inserted inserted;
  inserted.needle = NeedlePose{};
  inserted.needle->tip_lps_mm = {0.0, 30.0, 50.0};
  inserted.needle->direction = {0.0, 0.0, 1.0};
  const UltrasoundView view = straight_view();
  const PolarPicture picture = polar_of(water(), view, inserted);
  int lit = 0;
  float most = 0.0F;
  int where = 0;
  for (int b = 0; b < view.beams; ++b) {
    const float level = peak_of(picture, view, b).level;
    if (level > most) most = level, where = b;
  }
  for (int b = 0; b < view.beams; ++b) lit += peak_of(picture, view, b).level > 0.5F * most;
  EXPECT_NEAR(where, 63.5, 1.0);
  EXPECT_NEAR(peak_of(picture, view, where).depth_mm, 30.0 - 0.36, 0.1);
  EXPECT_LE(lit, 4);  // 0.53 mm of beam
}

TEST(Needle, AlongTheBeamOnlyItsTipShows) {
  Inserted inserted;
  inserted.needle = NeedlePose{};
  inserted.needle->tip_lps_mm = {0.15, 30.0, 0.0};
  inserted.needle->direction = {0.0, 1.0, 0.0};
  const UltrasoundView view = straight_view();
  const PolarPicture picture = polar_of(water(), view, inserted);
  for (int b = 0; b < view.beams; ++b)
    for (int k = 0; k < view.samples; ++k) {
      ASSERT_TRUE(std::isfinite(at(picture, b, k)));
      const double depth_mm = (k + 0.5) * view.depth_mm / view.samples;
      if (depth_mm < 29.0) {
        EXPECT_LT(at(picture, b, k), 0.05F) << b << " " << depth_mm;
      }
    }
  EXPECT_NEAR(peak_of(picture, view, 64).depth_mm, 30.0, 0.5);
}

TEST(Needle, BehindBoneAndGasItVanishes) {
  for (const TissueClass screen : {TissueClass::bone, TissueClass::gas}) {
    const Scene s =
        scene([=](const glm::dvec3& p) { return p.y > 20.0 && p.y < 40.0 ? screen : TissueClass::fluid; });
    const UltrasoundView view = curved_view();
    // What repeats of the screen's echo would be there anyway.
    const PolarPicture without = polar_of(s, view), with = polar_of(s, view, needle_at(10.0, 70.0, 0.0));
    for (int k = sample_at(view, 68.0); k < sample_at(view, 72.0); ++k)
      EXPECT_NEAR(at(with, 50, k), at(without, 50, k), 1e-3F);
  }
}

TEST(Needle, ItsShadowIsWeak) {
  UltrasoundView view = curved_view();
  const Scene s = all_of(TissueClass::liver);
  const Line without = line_of(s, view, 60), with = line_of(s, view, 60, needle_at(30.0, 60.0, 0.0));
  const auto k = static_cast<std::size_t>(sample_at(view, 80.0)),
             above = static_cast<std::size_t>(sample_at(view, 50.0));
  const double shadow_db = double{with.loss_db[k]} - double{without.loss_db[k]};
  EXPECT_GT(shadow_db, 0.5);
  EXPECT_LT(shadow_db, 6.0);
  EXPECT_EQ(with.loss_db[above], without.loss_db[above]);
}

TEST(Needle, ItsTailIsSpacedByWhatItIsMadeOf) {
  // 18 gauge: lumen 0.838 mm, lines every 0.87; 22 gauge solid: every 0.19: thickness · 1540 / c, reverberation as
  // in Reusz et al., Br. J. Anaesth. 112, 2014, 794.
  for (const auto& [outer_mm, inner_mm, spacing_mm] :
       std::vector<std::tuple<double, double, double>>{{0.635, 0.419, 0.87}, {0.36, 0.0, 0.19}}) {
    const UltrasoundView view = straight_view();
    Inserted inserted = needle_at(15.0, 20.0, 0.0);
    inserted.needle->radius_mm = outer_mm;
    inserted.needle->inner_radius_mm = inner_mm;
    const Line line = line_of(all_of(TissueClass::fluid), view, 64, inserted);
    ASSERT_GE(line.echoes.size(), 9U);
    for (std::size_t i = 1; i < 9; ++i) {
      EXPECT_NEAR(line.echoes[i].depth_mm - line.echoes[i - 1].depth_mm, spacing_mm, 0.01);
      EXPECT_NEAR(decibels(line.echoes[i - 1].amplitude / line.echoes[i].amplitude),
                  inner_mm > 0.0 ? kLumenDbPerLine : kTailDbPerLine, 1e-6);
    }
  }
}

// Lines from the lumen go as the mirror goes that they come from: nowhere do they end at once.
TEST(Needle, ItsTailFadesWithItsMirror) {
  const UltrasoundView view = straight_view();
  const Scene fluid = all_of(TissueClass::fluid);
  double last_db = 100.0;
  for (double tilt_deg = 0.0; tilt_deg < 40.0; tilt_deg += 0.25) {
    Inserted inserted = needle_at(15.0, 20.0, tilt_deg);
    inserted.needle->radius_mm = 0.635;
    inserted.needle->inner_radius_mm = 0.419;
    const Line line = line_of(fluid, view, 64, inserted);
    double strongest = 1e-3;  // of the lines from inside: between the shaft and, last, the tip
    for (const LineEcho& echo : line.echoes)
      if (echo.depth_mm > line.echoes.front().depth_mm + 0.5) strongest = std::max(strongest, echo.amplitude);
    const double db = decibels(strongest);
    if (last_db < 99.0) {
      EXPECT_LT(last_db - db, last_db > kLeastTailDb + 6.0 ? 3.0 : 40.0) << tilt_deg;
    }
    last_db = db;
  }
  EXPECT_LT(last_db, kLeastTailDb + 1.0) << "a steep needle has no tail";
}

TEST(Needle, PosesThatAreNoneShowNothing) {
  const UltrasoundView view = straight_view();
  const PolarPicture none = polar_of(water(), view);
  for (int i = 0; i < 3; ++i) {
    Inserted inserted = needle_at(0.0, 20.0, 0.0);
    if (i == 0) inserted.needle->tip_lps_mm.x = std::nan("");
    if (i == 1) inserted.needle->direction = glm::dvec3(INFINITY);
    if (i == 2) inserted.needle->length_mm = 0.0;
    EXPECT_EQ(polar_of(water(), view, inserted).envelope, none.envelope) << i;
  }
}

TEST(Needle, AtTheFirstSampleItIsFinite) {
  const UltrasoundView view = straight_view();
  for (const double depth_mm : {0.0, 0.02, 0.36, 0.4}) {
    const PolarPicture picture = polar_of(water(), view, needle_at(0.0, depth_mm, 0.0));
    for (const float v : picture.envelope) ASSERT_TRUE(std::isfinite(v)) << depth_mm;
  }
}

// Out of the plane along its length: it fades where the slice ends, not at once.
TEST(Needle, CrossingTheSliceItFadesAsTheSliceIsThick) {
  UltrasoundView view = straight_view();
  view.beams = 256;
  const double depth_mm = 18.0, slope = 0.25;  // mm out for each mm along
  Inserted inserted;
  inserted.needle = NeedlePose{};
  inserted.needle->direction = glm::normalize(glm::dvec3(1.0, 0.0, slope));
  inserted.needle->tip_lps_mm = glm::dvec3(0.0, depth_mm, 0.0) + 60.0 * inserted.needle->direction;
  const PolarPicture picture = polar_of(water(), view, inserted);
  const float in_plane = std::max(peak_of(picture, view, 127).level, peak_of(picture, view, 128).level);
  const double fwhm_mm = elevation_fwhm_mm(view.probe, view.probe.frequency_mhz, depth_mm);
  double first = 1e9, last = -1e9;
  for (int b = 0; b < view.beams; ++b)
    if (peak_of(picture, view, b).level > 0.5F * in_plane) {
      const double x_mm = point_of(view, b, 0.0).x;
      first = std::min(first, x_mm), last = std::max(last, x_mm);
    }
  // The beam's width blurs what it sees of the slanting shaft a little.
  EXPECT_NEAR((last - first) * slope / fwhm_mm, 1.0, 0.1);
  EXPECT_NEAR(0.5 * (first + last), 0.0, 0.2);
}

}  // namespace
}  // namespace seldinger::imaging
