// Where beams, widths and the screen's pixels lie (goal 1).
#include "sim/imaging/ultrasound/view/fan.h"

#include "tests/sim/imaging/ultrasound/ultrasound_scene.h"

namespace seldinger::imaging {
namespace {

TEST(Fan, ProbesSpanWhatTheyAreMadeOf) {
  const UltrasoundView curved = curved_view();
  const glm::dvec3 first = fan_of(curved).direction(-0.5), last = fan_of(curved).direction(127.5);
  EXPECT_NEAR(std::acos(glm::dot(first, last)) * 180.0 / M_PI, 75.16, 0.01);
  const UltrasoundView straight = straight_view();
  EXPECT_NEAR(glm::distance(point_of(straight, 0, 0), point_of(straight, 1, 0)), 0.300, 1e-12);
  EXPECT_NEAR(glm::distance(point_of(straight, -0.5, 20), point_of(straight, 127.5, 20)), 38.4, 1e-9);
  EXPECT_LT(point_of(straight, 0, 0).x, 0.0);  // towards the last beam along `lateral`
}

TEST(Fan, ACurvedFaceIsAnArcThroughTheOrigin) {
  const UltrasoundView view = curved_view();
  const glm::dvec3 center(0.0, -49.57, 0.0);
  for (const double beam : {0.0, 31.0, 63.5, 127.0}) {
    EXPECT_NEAR(glm::distance(point_of(view, beam, 0.0), center), 49.57, 1e-9);
    EXPECT_NEAR(glm::distance(point_of(view, beam, 80.0), center), 129.57, 1e-9);
  }
  EXPECT_NEAR(glm::length(point_of(view, 63.5, 0.0)), 0.0, 1e-9);
}

TEST(Fan, PolarAndBackIsTheSame) {
  for (const UltrasoundView& view : {curved_view(), straight_view()})
    for (const double beam : {-0.5, 0.0, 17.3, 63.5, 127.5})
      for (const double depth_mm : {0.0, 0.7, 33.0, 50.0}) {
        const glm::dvec3 p = point_of(view, beam, depth_mm);
        const BeamAndDepth back = beam_and_depth(view, p.x, p.y);
        EXPECT_NEAR(back.beam, beam, 1e-9);
        EXPECT_NEAR(back.depth_mm, depth_mm, 1e-9);
      }
}

TEST(Probe, WidthsAreTheSpecifications) {
  // By hand: axial c/2 · 0.8825 / bandwidth; lateral 0.89 λ F#; elevation √((λz/h)² + (0.6 h |1 − z/F|)²).
  EXPECT_NEAR(beam_width(kC52v, 3.57, 0, 10).axial_sigma_mm * 2.3548, 0.32, 0.005);
  EXPECT_NEAR(beam_width(kL115v, 7.6, 0, 10).axial_sigma_mm * 2.3548, 0.14, 0.01);
  EXPECT_NEAR(beam_width(kC52v, 3.57, 0, 40).lateral_sigma_mm * 2.3548, 0.77, 0.01);
  EXPECT_NEAR(beam_width(kC52v, 3.57, 0, 150).lateral_sigma_mm * 2.3548, 1.8, 0.02);
  EXPECT_NEAR(elevation_fwhm_mm(kC52v, 3.57, 20), 5.4, 0.06);
  EXPECT_NEAR(elevation_fwhm_mm(kC52v, 3.57, 60), 1.9, 0.06);
  EXPECT_NEAR(elevation_fwhm_mm(kC52v, 3.57, 100), 6.3, 0.06);
  EXPECT_NEAR(elevation_fwhm_mm(kL115v, 7.6, 5), 2.2, 0.06);
  EXPECT_NEAR(elevation_fwhm_mm(kL115v, 7.6, 18), 0.73, 0.01);
}

TEST(Probe, AFocusIsSharpestAndNeverSharperThanEverywhere) {
  const double at_focus = beam_width(kC52v, 3.57, 60, 60).lateral_sigma_mm;
  EXPECT_NEAR(at_focus, beam_width(kC52v, 3.57, 0, 60).lateral_sigma_mm, 1e-12);
  for (const double depth_mm : {10.0, 30.0, 60.0, 120.0}) {
    const double one = beam_width(kC52v, 3.57, 60, depth_mm).lateral_sigma_mm,
                 all = beam_width(kC52v, 3.57, 0, depth_mm).lateral_sigma_mm;
    EXPECT_GE(one, all - 1e-12);
    EXPECT_LE(one, all * std::sqrt(2.0));  // what is received stays in focus
  }
  for (const Probe& probe : kProbes) EXPECT_EQ(probe_named(probe.name), &probe);
  EXPECT_EQ(probe_named("L11-5v")->pitch_mm, 0.300);
  EXPECT_EQ(probe_named("X1"), nullptr);
}

TEST(Goal1, ScanConversionPutsPointsWhereTheyAre) {
  for (const Probe& probe : kProbes) expect_holds(practised(probe), &measure::measure_scan_conversion);
}

TEST(ScanConverter, TheWholeFieldFitsAndNothingElseShows) {
  for (const UltrasoundView& view : {curved_view(), straight_view()}) {
    const ScanConverter converter(view, {400, 300});
    PolarPicture polar{view.beams, view.samples, {}};
    polar.envelope.assign(static_cast<std::size_t>(view.beams * view.samples), 100.0F);
    std::vector<unsigned char> grey;
    converter.grey(view, {}, polar, grey);
    int lit = 0;
    for (std::size_t i = 0; i < grey.size(); ++i) {
      EXPECT_TRUE(grey[i] == 0 || grey[i] == 255);
      lit += grey[i] == 255;
    }
    const double step = fan_of(view).beam_step, span = view.beams * step, d = view.depth_mm, r = 49.57;
    const double area_mm2 = fan_of(view).curved ? 0.5 * span * ((r + d) * (r + d) - r * r) : span * d;
    EXPECT_NEAR(lit * converter.pixel_mm() * converter.pixel_mm() / area_mm2, 1.0, 0.01);
  }
}

}  // namespace
}  // namespace seldinger::imaging
