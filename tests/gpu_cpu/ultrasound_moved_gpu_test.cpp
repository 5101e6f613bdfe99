// Ultrasound of tissue that moves, on the GPU against the CPU, grey by grey; and of tissue that lies still, with
// the same bits as ever.
#include <array>

#include "tests/gpu_cpu/ultrasound_pair.h"
#include "tests/sim/imaging/ultrasound/ultrasound_scene.h"

namespace seldinger::imaging {
namespace {

// A needle dragged; and that under a press, in a breath.
std::vector<tissue::Displacement> displacements() {
  const std::array<tissue::SkinPress, 1> press{
      {{.at_lps_mm = {0, 0, 0}, .inward = {0, 1, 0}, .radius_mm = 20.0, .depth_mm = 7.0}}};
  const tissue::NeedleDrag needle{.entry_lps_mm = {-20, 0, 0},
                                  .direction = glm::normalize(glm::dvec3(0.6, 1.0, 0.0)),
                                  .cut_mm = 35.0,
                                  .tip_n = 1.0,
                                  .tip_mm = 2.0,
                                  .shaft_mm = 2.0};
  const tissue::Breath breath{{.half_width_mm = 90.0, .back_y_mm = 120.0, .depth_mm = 160.0, .dome_z_mm = 10.0},
                              {2.0, 6.0, 15.0}};
  return {tissue::displacement_of({.needle = needle}),
          tissue::displacement_of({.presses = press, .needle = needle, .breath = breath})};
}

std::vector<UltrasoundView> moved_views() {
  std::vector<UltrasoundView> all;
  for (UltrasoundView view : {curved_view(110.0), straight_view(45.0)})
    for (const UltrasoundMethod method : {UltrasoundMethod::scatterers, UltrasoundMethod::lattice})
      for (const bool range_error : view.probe.radius_mm > 0.0 ? std::vector{false, true} : std::vector{false}) {
        view.origin_lps_mm = {0.37, 7.11, 0.21};
        view.axial = glm::normalize(glm::dvec3(0.15, 1.0, 0.1));
        view.lateral = glm::normalize(glm::cross(view.axial, glm::dvec3(0.05, 0.0, 1.0)));
        view.beams = 64;
        view.samples = 500;
        view.method = method;
        view.range_error = range_error;
        all.push_back(view);
      }
  return all;
}

class UltrasoundMovedOnGpu : public testing::TestWithParam<LinesBy> {
 protected:
  gpu::Context context_;
};
INSTANTIATE_TEST_SUITE_P(LinesBy, UltrasoundMovedOnGpu, testing::Values(LinesBy::cpu, LinesBy::gpu),
                         [](const auto& by) { return by.param == LinesBy::cpu ? "Cpu" : "Gpu"; });

TEST_P(UltrasoundMovedOnGpu, IsTheCpu) {
  const Scene s = layers();
  UltrasoundGpu gpu(context_, s.tissue(), GetParam(), TissueMoves::yes);
  for (const UltrasoundView& view : moved_views()) {
    Inserted inserted;
    inserted.needle = NeedlePose{.tip_lps_mm = view.origin_lps_mm + 22.0 * view.axial,
                                 .direction = glm::normalize(view.lateral + 0.4 * view.axial)};
    inserted.lesions.push_back({view.origin_lps_mm + 24.0 * view.axial - 8.0 * view.lateral, 5.0, 0.0});
    int which = 0;
    for (const tissue::Displacement& displacement : displacements()) {
      const ScreenPair pair = screen_pair(gpu, s.tissue(), view, inserted, {}, {}, {400, 350}, displacement);
      EXPECT_TRUE(alike(pair)) << view.probe.name << ' ' << static_cast<int>(view.method) << ' ' << which;
      ++which;
    }
  }
}

TEST_P(UltrasoundMovedOnGpu, AProbeOfAnyTiltFindsTheColumns) {
  const Scene s = layers();
  UltrasoundGpu gpu(context_, s.tissue(), GetParam(), TissueMoves::yes);
  const tissue::Displacement displacement = displacements().back();
  for (const glm::dvec3& turn : {glm::dvec3(0, 0, 1), glm::dvec3(1, 0.1, 0.4), glm::dvec3(-0.7, 0.2, -0.75)}) {
    UltrasoundView view = moved_views().front();
    view.lateral = glm::normalize(glm::cross(view.axial, turn));
    EXPECT_TRUE(alike(screen_pair(gpu, s.tissue(), view, {}, {}, {}, {400, 350}, displacement))) << turn.x;
  }
}

TEST_P(UltrasoundMovedOnGpu, WhoLiesStillHasTheSameBits) {
  const Scene s = layers();
  UltrasoundGpu still(context_, s.tissue(), GetParam()),
      may_move(context_, s.tissue(), GetParam(), TissueMoves::yes);
  for (const UltrasoundView& view : moved_views()) {
    PolarPicture a, b, moved;
    still.polar(view, {}, {}, a);
    may_move.polar(view, {}, {}, moved, displacements().back());
    may_move.polar(view, {}, {}, b, tissue::displacement_of({}));
    EXPECT_EQ(a.envelope, b.envelope);
    EXPECT_NE(a.envelope, moved.envelope);
  }
}

}  // namespace
}  // namespace seldinger::imaging
