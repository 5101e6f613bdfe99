// MPR on the GPU (float, compute shader) against the cpu and reference backends, away from where rounding decides.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <memory>

#include "sim/base/failure.h"
#include "tests/sim/imaging/mpr_scene.h"

namespace seldinger::imaging {
namespace {

constexpr double kToleranceHu = 0.5;
// Float keeps an index of some hundred voxels to about 3e-5, a position of some hundred mm to about 2e-5.
constexpr double kFaceVoxels = 5e-4, kEdgeMm = 0.005;

Inserted random_shapes(base::Rng& rng, const MprView& view, bool hollow) {
  Inserted inserted;
  // Near the plane, so that much of it is seen.
  const glm::dvec3 direction = glm::normalize(view.u + rng.uniform() * view.v + 0.02 * random_direction(rng));
  inserted.needle = NeedlePose{.tip_lps_mm = view.center_lps_mm + 3.0 * random_direction(rng),
                               .direction = direction,
                               .length_mm = 20.0 + 60.0 * rng.uniform(),
                               .radius_mm = 0.36 + 2.0 * rng.uniform()};
  if (hollow) inserted.needle->inner_radius_mm = 0.7 * inserted.needle->radius_mm;
  for (int i = 0; i < 6; ++i)
    inserted.lesions.push_back(
        {view.center_lps_mm + 25.0 * random_direction(rng), 4.0 + 14.0 * rng.uniform(), 15.0 * i - 30.0});
  return inserted;
}

class MprOnGpu : public testing::Test {
 protected:
  gpu::Context context_;
};

TEST_F(MprOnGpu, IsTheCpuOnNoiseWithNeedleAndLesions) {
  base::Rng rng(51);
  for (int trial = 0; trial < 6; ++trial) {
    glm::dmat3 direction = random_rotation(rng);
    if (trial % 2 == 1) direction[2] = -direction[2];  // left-handed
    const glm::dvec3 center_mm{-12.0, 30.0, 700.0};
    // Not a multiple of anything, and one that reaches beyond 256 voxels, where float has fewer digits.
    const volume::Volume volume = noise_volume(trial < 3 ? glm::ivec3{131, 67, 45} : glm::ivec3{64, 401, 33},
                                               {0.7, 0.6, 1.7}, direction, center_mm, 5);
    MprGpu gpu(context_, volume);
    for (const Interpolation interpolation : {Interpolation::linear, Interpolation::nearest})
      for (const double slab_mm : {0.0, 4.0}) {
        MprView view = random_view(rng, center_mm, 20.0, 0.37, 243, 157, interpolation);
        view.needle_slab_mm = slab_mm;
        const Inserted inserted = random_shapes(rng, view, trial % 3 == 0);
        const PixelMask left_out =
            either(near_shape_edges(view, inserted, kEdgeMm), near_voxel_faces(volume, view, kFaceVoxels));
        EXPECT_LT(share_of(left_out), 0.03);
        const HuImage on_gpu = gpu.render(view, inserted);
        EXPECT_TRUE(images_agree(on_gpu, mpr_cpu(volume, view, inserted), view.width_px, kToleranceHu, left_out,
                                 "gpu_and_cpu"));
        EXPECT_TRUE(images_agree(on_gpu, mpr_reference(volume, view, inserted), view.width_px, kToleranceHu,
                                 left_out, "gpu_and_reference"));
      }
  }
}

// Every needle angle to the plane, down to parallel and up to end-on, where the closed form divides by little.
TEST_F(MprOnGpu, ShowsTheSameNeedleAtEveryAngle) {
  const volume::Volume volume = noise_volume({9, 9, 9}, glm::dvec3(20.0), glm::dmat3(1.0), glm::dvec3(0.0), 6);
  MprGpu gpu(context_, volume);
  for (const double angle_rad :
       {0.0, 1e-9, 1e-7, 1e-6, 3e-6, 1e-5, 1e-3, 0.1, 0.7, 1.4, 1.57, 1.5707963, 1.5707963268})
    for (const double slab_mm : {0.0, 1.0, 30.0}) {
      MprView view;
      view.center_lps_mm = {3.0, 4.0, 5.0};
      view.width_px = 120;
      view.height_px = 90;
      view.pixel_mm = 0.251;
      view.needle_slab_mm = slab_mm;
      view.interpolation = Interpolation::nearest;
      Inserted inserted;
      inserted.needle = NeedlePose{.tip_lps_mm = {8.1, 5.3, 5.21},
                                   .direction = {std::cos(angle_rad), 0.0, -std::sin(angle_rad)},
                                   .length_mm = 9.03,
                                   .radius_mm = 1.07,
                                   .inner_radius_mm = 0.51};
      const PixelMask left_out =
          either(near_shape_edges(view, inserted, kEdgeMm), near_voxel_faces(volume, view, kFaceVoxels));
      EXPECT_LT(share_of(left_out), 0.03);
      EXPECT_TRUE(images_agree(gpu.render(view, inserted), mpr_reference(volume, view, inserted), view.width_px,
                               kToleranceHu, left_out, "gpu_needle_angle"))
          << angle_rad << ' ' << slab_mm;
    }
}

TEST_F(MprOnGpu, ShowsALinearRampExactly) {
  volume::Volume volume = noise_volume({90, 80, 70}, {0.7, 0.9, 1.3}, glm::dmat3(1.0), glm::dvec3(0.0), 7);
  for (int k = 0; k < 70; ++k)
    for (int j = 0; j < 80; ++j)
      for (int i = 0; i < 90; ++i)
        volume.hu[volume.index(i, j, k)] = static_cast<std::int16_t>(5 * i - 7 * j + 9 * k);
  MprGpu gpu(context_, volume);
  base::Rng rng(52);
  std::size_t compared = 0;
  for (int trial = 0; trial < 8; ++trial) {
    const MprView view = random_view(rng, glm::dvec3(0.0), 10.0, 0.4, 100, 130, Interpolation::linear);
    const HuImage image = gpu.render(view, {});
    for (int row = 0; row < view.height_px; ++row)
      for (int column = 0; column < view.width_px; ++column) {
        const glm::dvec3 index =
            (pixel_lps_mm(view, column, row) - glm::dvec3(volume.lps_from_voxel[3])) / volume.spacing_mm;
        if (!glm::all(glm::greaterThan(index, glm::dvec3(0.01))) ||
            !glm::all(glm::lessThan(index, glm::dvec3(volume.size_voxels) - 1.01)))
          continue;
        ++compared;
        ASSERT_NEAR(image[static_cast<std::size_t>(row * view.width_px + column)],
                    5.0 * index.x - 7.0 * index.y + 9.0 * index.z, 0.01);
      }
  }
  EXPECT_GT(compared, 50000U);
}

TEST_F(MprOnGpu, RepeatsTheOutermostVoxelsInTheLastHalfAndIsPaddingBeyond) {
  for (const glm::ivec3& size : {glm::ivec3{3, 4, 5}, {1, 4, 5}, {3, 1, 5}, {3, 4, 1}, {1, 1, 1}}) {
    const volume::Volume volume = noise_volume(size, glm::dvec3(4.0), glm::dmat3(1.0), glm::dvec3(0.0), 8);
    MprGpu gpu(context_, volume);
    base::Rng rng(53);
    for (int trial = 0; trial < 6; ++trial) {
      const MprView view = random_view(rng, glm::dvec3(0.0), 3.0, 0.5, 61, 47,
                                       trial % 2 == 0 ? Interpolation::linear : Interpolation::nearest);
      EXPECT_TRUE(images_agree(gpu.render(view, {}), mpr_reference(volume, view, {}), view.width_px, kToleranceHu,
                               near_voxel_faces(volume, view, kFaceVoxels), "gpu_borders"));
    }
  }
}

TEST_F(MprOnGpu, TakesPicturesOfAnySizeInAnyOrder) {
  const volume::Volume volume = noise_volume({20, 20, 20}, glm::dvec3(1.0), glm::dmat3(1.0), glm::dvec3(0.0), 9);
  MprGpu gpu(context_, volume);
  base::Rng rng(54);
  for (const glm::ivec2& size_px : {glm::ivec2{1, 1}, {300, 2}, {16, 16}, {17, 33}, {2, 300}, {400, 300}, {5, 5}}) {
    const MprView view = random_view(rng, glm::dvec3(0.0), 2.0, 0.05, size_px.x, size_px.y, Interpolation::linear);
    EXPECT_TRUE(images_agree(gpu.render(view, {}), mpr_cpu(volume, view, {}), view.width_px, kToleranceHu,
                             near_voxel_faces(volume, view, kFaceVoxels), "gpu_sizes"));
  }
}

TEST_F(MprOnGpu, ALostViewIsPaddingAndALostNeedleIsNotShown) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const volume::Volume volume = noise_volume({20, 20, 20}, glm::dvec3(1.0), glm::dmat3(1.0), glm::dvec3(0.0), 10);
  MprGpu gpu(context_, volume);
  MprView view;
  view.width_px = view.height_px = 20;
  Inserted inserted;
  inserted.needle = NeedlePose{.tip_lps_mm = {0.0, kNan, 0.0}};
  EXPECT_EQ(gpu.render(view, inserted), gpu.render(view, {}));
  for (const double at_mm : {kNan, std::numeric_limits<double>::infinity(), 1e30}) {
    view.center_lps_mm.x = at_mm;
    inserted.needle->tip_lps_mm.y = 0.0;
    EXPECT_EQ(gpu.render(view, inserted), HuImage(400, -1024.0F)) << at_mm;
  }
}

TEST_F(MprOnGpu, SeveralVolumesAndContextsLiveSideBySide) {
  const glm::dmat3 straight(1.0);
  const volume::Volume a = noise_volume({20, 20, 20}, glm::dvec3(1.0), straight, glm::dvec3(0.0), 11);
  const volume::Volume b = noise_volume({30, 10, 20}, glm::dvec3(1.0), straight, glm::dvec3(0.0), 12);
  auto other = std::make_unique<gpu::Context>();
  MprGpu gpu_a(context_, a);
  MprGpu gpu_b(*other, b);
  MprGpu again_b(context_, b);
  other.reset();
  base::Rng rng(55);
  for (int trial = 0; trial < 3; ++trial) {
    const MprView view = random_view(rng, glm::dvec3(0.0), 2.0, 0.3, 40, 50, Interpolation::linear);
    const PixelMask faces = either(near_voxel_faces(a, view, kFaceVoxels), near_voxel_faces(b, view, kFaceVoxels));
    EXPECT_TRUE(images_agree(gpu_a.render(view, {}), mpr_cpu(a, view, {}), 40, kToleranceHu, faces, "gpu_a"));
    EXPECT_TRUE(images_agree(gpu_b.render(view, {}), mpr_cpu(b, view, {}), 40, kToleranceHu, faces, "gpu_b"));
    EXPECT_EQ(again_b.render(view, {}), gpu_b.render(view, {}));
  }
}

TEST_F(MprOnGpu, RefusesAVolumeBeyondTheLargestTexture) {
  const volume::Volume volume =
      volume::make_volume({1, 1, 1 << 17}, glm::dvec3(1.0), glm::dmat3(1.0), glm::dvec3(0.0));
  try {
    const MprGpu gpu(context_, volume);
    FAIL() << "accepted";
  } catch (const base::Failure& failure) {
    EXPECT_EQ(failure.code(), "gl");
  }
}

}  // namespace
}  // namespace seldinger::imaging
