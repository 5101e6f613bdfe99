// The needle in the picture (goals 11 to 13, hard cases of ultrasound.md §4c).
#include "shaders/shared/ultrasound.glsl.h"
#include "ultrasound_scene.h"

namespace seldinger::imaging {
namespace {

const Scene& water() {
  static const Scene kWater = all_of(TissueClass::fluid);
  return kWater;
}

// In the plane, tip at (x, depth), rising towards the first beam at `tilt_deg` to the face.
Inserted needle_at(double x_mm, double depth_mm, double tilt_deg, double out_mm = 0.0) {
  const double a = tilt_deg * M_PI / 180.0;
  Inserted inserted;
  NeedlePose needle;
  needle.tip_lps_mm = {x_mm, depth_mm, out_mm};
  needle.direction = {std::cos(a), std::sin(a), 0.0};
  inserted.needle = needle;
  return inserted;
}

struct Peak {
  double depth_mm = 0.0;
  float level = 0.0F;
};
Peak peak_of(const PolarPicture& picture, const UltrasoundView& view, int beam) {
  Peak peak;
  for (int k = 0; k < view.samples; ++k)
    if (at(picture, beam, k) > peak.level) peak = {(k + 0.5) * view.depth_mm / view.samples, at(picture, beam, k)};
  return peak;
}

TEST(Goal11, TheNeedleIsWhereItIs) {
  double worst_axis_mm = 0.0, worst_deg = 0.0, worst_tip_mm = 0.0;
  for (UltrasoundView view : {curved_view(), straight_view()}) {
    view.beams = 256;
    for (const double share : {0.15, 0.4, 0.65})
      for (const double tilt_deg : {0.0, 15.0, 30.0, 45.0, 60.0}) {
        const double depth_mm = share * view.depth_mm + 5.0;
        const Inserted inserted = needle_at(4.0, depth_mm, tilt_deg);
        const NeedlePose& needle = *inserted.needle;
        const PolarPicture picture = polar_of(water(), view, inserted);
        double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
        double first_tip_mm = 1e9;
        for (int b = 0; b < view.beams; ++b) {
          const Peak peak = peak_of(picture, view, b);
          if (peak.level < 1e-2F) continue;  // ten times what water scatters
          const glm::dvec3 p = point_of(view, b, peak.depth_mm);
          const glm::dvec3 from_tip = p - needle.tip_lps_mm;
          const double along = -glm::dot(from_tip, needle.direction);
          first_tip_mm = std::min(first_tip_mm, glm::length(from_tip));
          if (along < 2.0 || along > 40.0) continue;
          // Of the near side, one radius above the axis.
          const double off_mm = glm::length(from_tip + along * needle.direction) - needle.radius_mm;
          worst_axis_mm = std::max(worst_axis_mm, std::abs(off_mm));
          ++n, sx += p.x, sy += p.y, sxx += p.x * p.x, sxy += p.x * p.y;
        }
        worst_tip_mm = std::max(worst_tip_mm, first_tip_mm);
        ASSERT_GE(n, 5) << view.probe.name << " " << depth_mm << " mm, " << tilt_deg;
        const double slope = (sxy - sx * sy / n) / (sxx - sx * sx / n);
        worst_deg = std::max(worst_deg, std::abs(std::atan(slope) * 180.0 / M_PI - tilt_deg));
      }
  }
  printf("goal 11: axis off by %.3f mm, angle by %.2f degrees, tip by %.3f mm at most\n", worst_axis_mm, worst_deg,
         worst_tip_mm);
  EXPECT_LE(worst_axis_mm, 0.25);  // a pixel of 800 × 700 over 150 mm
  EXPECT_LE(worst_deg, 0.5);
  EXPECT_LE(worst_tip_mm, 0.5);
}

// Grey of the shaft, as a share of white, seen `tilt_deg` off its normal, without loss on the way.
double grey_at(double tilt_deg, bool echogenic) {
  UltrasoundView view = straight_view();
  view.beams = 256;
  view.echogenic_needle = echogenic;
  const double depth_mm = 25.0;
  // So long that beam 128, in the middle, meets the shaft far from the tip.
  const Inserted inserted = needle_at(6.0, depth_mm + 6.0 * std::tan(tilt_deg * M_PI / 180.0), tilt_deg);
  const PolarPicture picture = polar_of(water(), view, inserted);
  float level = 0.0F;
  for (int b = 126; b < 130; ++b) level = std::max(level, peak_of(picture, view, b).level);
  return shaders::us_grey(decibels(level), kWhiteDb, 60.0) / 255.0;
}

TEST(Goal12, TheNeedleFadesWithItsTilt) {
  EXPECT_NEAR(grey_at(0.0, false), 1.0, 0.001);
  const double plain = grey_at(75.0, false) / grey_at(0.0, false),
               echogenic = grey_at(75.0, true) / grey_at(0.0, true);
  printf("goal 12: 75 over 0 degrees: plain %.3f, echogenic %.3f\n", plain, echogenic);
  EXPECT_NEAR(plain, 0.08, 0.03);
  EXPECT_NEAR(echogenic, 0.55, 0.10);
  double before = 1.0;
  for (const double tilt_deg : {10.0, 20.0, 30.0, 40.0, 50.0, 60.0}) {
    const double now = grey_at(tilt_deg, false);
    EXPECT_LT(now, before) << tilt_deg;
    EXPECT_LT(now, grey_at(tilt_deg, true)) << tilt_deg;
    before = now;
  }
  // Mostly invisible beyond 50°: below liver's own grey.
  EXPECT_LT(grey_at(50.0, false), shaders::us_grey(-2.5, kWhiteDb, 60.0) / 255.0);
}

TEST(Goal13, TheSliceIsAsThickAsTheBeam) {
  double worst = 0.0;
  for (UltrasoundView view : {curved_view(), straight_view()})
    for (const double share : {0.15, 0.4, 0.8}) {
      view.beams = 16;
      const double depth_mm = share * view.depth_mm;
      const auto level = [&](double out_mm) {
        return decibels(peak_of(polar_of(water(), view, needle_at(30.0, depth_mm, 0.0, out_mm)), view, 8).level);
      };
      const double in_plane = level(0.0);
      const double fwhm_mm = elevation_fwhm_mm(view.probe, view.probe.frequency_mhz, depth_mm);
      // Half the amplitude, by bisection.
      double low = 0.0, high = 2.0 * fwhm_mm;
      for (int i = 0; i < 20; ++i)
        (level(0.5 * (low + high)) > in_plane - 6.0206 ? low : high) = 0.5 * (low + high);
      const double error = low / (0.5 * fwhm_mm) - 1.0;
      worst = std::max(worst, std::abs(error));
      EXPECT_LE(std::abs(error), 0.10) << view.probe.name << " at " << depth_mm;
    }
  printf("goal 13: slice off by at most %.1f %%\n", 100.0 * worst);
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
  // 18 gauge: lumen 0.838 mm, lines every 0.87; 22 gauge solid: every 0.19 (ultrasound.md §3).
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
      EXPECT_NEAR(decibels(line.echoes[i - 1].amplitude / line.echoes[i].amplitude), kTailDbPerLine, 1e-6);
    }
  }
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

}  // namespace
}  // namespace seldinger::imaging
