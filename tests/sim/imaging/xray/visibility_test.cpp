// What a radiologist would expect to see, and what the field and the dose decide.
#include "sim/imaging/xray/visibility.h"

#include <limits>

#include "sim/imaging/xray/instruments.h"
#include "tests/sim/imaging/xray/xray_scene.h"

namespace seldinger::imaging {
namespace {

// An abdomen of water, 260 mm thick along y; source below (posterior), panel above, 785/1100 mm.
class XrayVisible : public testing::Test {
 protected:
  volume::Volume body = centered({80, 52, 60}, {5.0, 5.0, 5.0}, 0);
  cases::Fluoroscope machine;
  Beams beams{machine};
  AutomaticExposure automatic{machine};
  Pulse pulse{{78.0, 60.0, 8.0}, 1100.0, 0, {}};
  XrayGeometry geometry = [] {
    XrayGeometry g;
    g.source_lps_mm = glm::dvec3(0.0, 785.0, 0.0);
    g.detector_center_lps_mm = {0.0, -315.0, 0.0};
    g.u = {1.0, 0.0, 0.0};
    g.v = {0.0, 0.0, -1.0};
    g.pixel_mm = 300.0 / 512.0;
    g.width_px = g.height_px = 512;
    return g;
  }();
  NeedlePose needle{{10.0, 0.0, 5.0}, glm::normalize(glm::dvec3(1.0, -0.7, 0.2)), 120.0, 0.36, 0.0, 3000.0};

  // As automatic exposure would set it for this patient.
  void SetUp() override {
    const PathLengths field{1, 1, {260.0F}, {0.0F}, {}};
    for (int i = 0; i < 4; ++i) pulse.technique = meter(beams, automatic, pulse, field, {}).next;
  }
  Visible see(const Inserted& inserted) {
    return xray_visible(body, geometry, beams.at(pulse.technique.kv), pulse, inserted);
  }
  Contrast of_target(const cases::Lesion& lesion) {
    return *target_contrast(body, geometry, beams.at(pulse.technique.kv), pulse, {std::nullopt, {lesion}});
  }
  // Where a point's shadow falls, from the picture's middle.
  glm::dvec2 shadow_mm(const glm::dvec3& p) {
    return geometry.pixel_mm * (*pixel_of(geometry, p) - glm::dvec2(255.5, 255.5));
  }
};

TEST_F(XrayVisible, ANeedleIsSeenInTheAbdomen) {
  Visible visible = see({needle, {}});
  EXPECT_TRUE(visible.needle_tip);
  EXPECT_FALSE(visible.target);
  EXPECT_FALSE(visible.joint);
  needle.inner_radius_mm = 0.25;  // a cannula
  EXPECT_TRUE(see({needle, {}}).needle_tip);
  needle.direction = {0.0, -1.0, 0.0};  // seen end on
  EXPECT_TRUE(see({needle, {}}).needle_tip);
}

TEST_F(XrayVisible, ContrastIsTheChordsInClosedForm) {
  needle.direction = {1.0, 0.0, 0.0};
  needle.tip_lps_mm = {1.0, 0.0, 0.0};
  const BeamSignal& beam = beams.at(pulse.technique.kv);
  const auto contrast = needle_contrast(body, geometry, beam, pulse, {needle, {}}, 1.0);
  ASSERT_TRUE(contrast.has_value());
  const double expected = 1.0 - std::exp(beam.log_share(260.0 - 0.72, 0.0, 0.72) - beam.log_share(260.0, 0.0));
  EXPECT_NEAR(contrast->relative, expected, 1e-9);
  EXPECT_GT(contrast->relative, 0.2);
  // 2 mm by 0.72 mm, magnified, of the quanta there.
  const double m = 1100.0 / 785.0;
  const double quanta = std::exp(beam.log_share(260.0, 0.0)) * beam.open_quanta_per_mas_mm2() * pulse.mas() / 1.21 *
                        (0.72 * m) * (2.0 * m);
  EXPECT_NEAR(contrast->sigma * std::sqrt(quanta), 1.0, 1e-9);
}

TEST_F(XrayVisible, SoftTissueLesionsAreNotAnOpacifiedCalyxIs) {
  for (const double radius_mm : {6.0, 8.0, 12.0, 20.0}) {
    const Contrast lesion = of_target({{0.0, 10.0, 0.0}, radius_mm, 20.0});
    EXPECT_FALSE(lesion.visible()) << radius_mm << ' ' << lesion.relative / lesion.sigma;
  }
  const Contrast calyx = of_target({{0.0, 10.0, 0.0}, 5.0, 300.0});
  EXPECT_TRUE(calyx.visible()) << calyx.relative / calyx.sigma;
  const Contrast stone = of_target({{0.0, 10.0, 0.0}, 4.0, 1200.0});
  EXPECT_TRUE(stone.visible()) << stone.relative / stone.sigma;
  EXPECT_EQ(of_target({{0.0, 10.0, 0.0}, 8.0, 0.0}).relative, 0.0);  // of water in water
}

TEST_F(XrayVisible, JointIsBoth) {
  const Visible visible = see({needle, {{{0.0, 10.0, 0.0}, 6.0, 300.0}}});
  EXPECT_TRUE(visible.needle_tip);
  EXPECT_TRUE(visible.target);
  EXPECT_TRUE(visible.joint);
}

TEST_F(XrayVisible, TheCollimatorHides) {
  const Inserted inserted{needle, {{{40.0, 0.0, 5.0}, 6.0, 300.0}}};
  const double tip_share = std::abs(shadow_mm(needle.tip_lps_mm).x) / 150.0;
  const double target_share = std::abs(shadow_mm({40.0, 0.0, 5.0}).x) / 150.0;
  ASSERT_LT(tip_share, target_share);
  pulse.collimator = {target_share + 1e-6, 1.0};
  EXPECT_TRUE(see(inserted).joint);
  pulse.collimator = {target_share - 1e-6, 1.0};
  EXPECT_TRUE(see(inserted).needle_tip);
  EXPECT_FALSE(see(inserted).target);
  pulse.collimator = {tip_share - 1e-6, 1.0};
  EXPECT_FALSE(see(inserted).needle_tip);
}

// The shaft's part inside, found by walking along it.
TEST_F(XrayVisible, LengthIsTheShaftInsideTheField) {
  for (const cases::Collimator& collimator : {cases::Collimator{1.0, 1.0}, {0.5, 0.4}, {0.2, 1.0}, {0.05, 0.05}})
    for (const glm::dvec3& direction : {glm::dvec3(1, -0.7, 0.2), glm::dvec3(-0.3, 1, 0.9), glm::dvec3(0, 0, 1)})
      for (const bool parallel_rays : {false, true}) {
        pulse.collimator = collimator;
        needle.direction = glm::normalize(direction);
        XrayGeometry g = geometry;
        if (parallel_rays) {
          g.source_lps_mm.reset();
          g.direction = {0.0, -1.0, 0.0};
        }
        double expected_mm = 0.0;
        constexpr double kStep = 0.005;
        for (double s = 0.5 * kStep; s < needle.length_mm; s += kStep) {
          const auto pixel = pixel_of(g, needle.tip_lps_mm - s * needle.direction);
          const glm::dvec2 mm = g.pixel_mm * (*pixel - glm::dvec2(255.5, 255.5));
          if (std::abs(mm.x) <= 150.0 * collimator.open_u && std::abs(mm.y) <= 150.0 * collimator.open_v)
            expected_mm += kStep;
        }
        const Visible visible = xray_visible(body, g, beams.at(pulse.technique.kv), pulse, {needle, {}});
        EXPECT_NEAR(visible.needle_length_mm, expected_mm, 3.0 * kStep)
            << collimator.open_u << ' ' << direction.x << ' ' << parallel_rays;
      }
}

TEST_F(XrayVisible, DoseAndThicknessDecide) {
  const Inserted inserted{needle, {}};
  ASSERT_TRUE(see(inserted).needle_tip);
  const double ma = pulse.technique.ma;
  pulse.technique.ma = 1e-3 * ma;
  EXPECT_FALSE(see(inserted).needle_tip);
  EXPECT_EQ(see(inserted).needle_length_mm, 0.0);
  pulse.technique.ma = 0.0;
  EXPECT_FALSE(see(inserted).needle_tip);
  pulse.technique.ma = ma;
  body = centered({80, 120, 60}, {5.0, 5.0, 5.0}, 0);  // 600 mm
  EXPECT_FALSE(see(inserted).needle_tip);
}

TEST_F(XrayVisible, WhatIsNotBetweenSourceAndPanel) {
  needle.tip_lps_mm = {0.0, -400.0, 0.0};  // beyond the panel
  EXPECT_FALSE(see({needle, {}}).needle_tip);
  needle.tip_lps_mm = {0.0, 900.0, 0.0};  // behind the source
  EXPECT_FALSE(see({needle, {}}).needle_tip);
  needle.tip_lps_mm = {std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0};
  EXPECT_FALSE(see({needle, {}}).needle_tip);
  EXPECT_EQ(see({needle, {}}).needle_length_mm, 0.0);
  EXPECT_FALSE(see({}).needle_tip);
  EXPECT_FALSE(see({}).joint);
}

// Scatter is part of the signal and of its noise, and asks 5 σ.
TEST_F(XrayVisible, ScatterVeils) {
  const BeamSignal& beam = beams.at(pulse.technique.kv);
  const auto of_needle = [&] { return *needle_contrast(body, geometry, beam, pulse, {needle, {}}, 1.0); };
  const double primary = std::exp(beam.log_share(260.0, 0.0));
  needle.direction = {1.0, 0.0, 0.0};
  needle.tip_lps_mm = {1.0, 0.0, 0.0};
  const Contrast bare = of_needle();
  pulse.scatter = 0.0;
  const Contrast behind_grid = of_needle();
  EXPECT_EQ(behind_grid.relative, bare.relative);
  EXPECT_NEAR(behind_grid.sigma / bare.sigma, 1.0 / std::sqrt(kGridPrimaryShare), 1e-12);
  pulse.scatter = 0.6 * primary;
  const Contrast veiled = of_needle();
  EXPECT_NEAR(veiled.relative / bare.relative, 1.0 / 1.6, 1e-9);
  EXPECT_NEAR(veiled.sigma / behind_grid.sigma, 1.0 / std::sqrt(1.6), 1e-9);
  EXPECT_EQ(Contrast({0.1, 0.025}).visible(), true);
  EXPECT_EQ(Contrast({0.1, 0.025, veiled.least_sigmas}).visible(), false) << "4 σ";

  // With what this abdomen scatters, needle and opacified calyx are seen all the same.
  const PathLengths field{1, 1, {260.0F}, {0.0F}, {}};
  for (int i = 0; i < 4; ++i) {
    pulse.scatter = scatter_share(beams, pulse, field);
    pulse.technique = meter(beams, automatic, pulse, field, {}).next;
  }
  EXPECT_TRUE(see({needle, {{{0.0, 10.0, 0.0}, 5.0, 300.0}}}).joint);
  const cases::Lesion faint{{0.0, 10.0, 0.0}, 5.0, 160.0};
  const Contrast open = of_target(faint);
  pulse.collimator = {0.35, 0.35};
  pulse.scatter = scatter_share(beams, pulse, field);
  const Contrast closed = of_target(faint);
  EXPECT_GT(closed.relative / closed.sigma, 1.1 * open.relative / open.sigma);
  pulse.scatter = 1.0;  // as much as the open beam
  EXPECT_FALSE(of_target(faint).visible());
}

// A needle over the target is the needle's contrast, not the target's.
TEST_F(XrayVisible, TheTargetIsSeenWithoutTheNeedle) {
  const cases::Lesion lesion{{0.0, 0.0, 0.0}, 6.0, 20.0};
  needle.tip_lps_mm = {-40.0, 0.0, 0.0};
  needle.direction = {-1.0, 0.0, 0.0};
  EXPECT_FALSE(see({needle, {lesion}}).target);
}

}  // namespace
}  // namespace seldinger::imaging
