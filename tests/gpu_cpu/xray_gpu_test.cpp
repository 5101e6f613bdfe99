// X-ray projection on the GPU (float, compute shader) against the double reference, closed forms and the packets of
// the CPU. Small pictures: llvmpipe draws them.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <limits>

#include "sim/base/failure.h"
#include "tests/gpu_cpu/xray_rays.h"
#include "tests/sim/imaging/mpr_scene.h"

namespace seldinger::imaging {
namespace {

constexpr ProjectionMethod kMethods[] = {ProjectionMethod::exact, ProjectionMethod::slab};
constexpr Basis kBases[] = {Basis::water_and_mineral, Basis::total};

class XrayOnGpu : public testing::Test {
 protected:
  void expect_reference(const volume::Volume& volume, const XrayGeometry& geometry) {
    ASSERT_TRUE(check_geometry(geometry).has_value());
    XrayGpu gpu(context_, volume);
    for (const ProjectionMethod method : kMethods)
      for (const Basis basis : kBases)
        EXPECT_TRUE(is_the_reference(gpu.project(geometry, method, basis), volume, geometry, method))
            << static_cast<int>(method) << ' ' << static_cast<int>(basis);
  }

  gpu::Context context_;
};

TEST_F(XrayOnGpu, IsTheReferenceOnNoiseFromEverySide) {
  base::Rng rng(81);
  for (int trial = 0; trial < 12; ++trial) {
    glm::dmat3 direction = random_rotation(rng);
    if (trial % 2 == 1) direction[2] = -direction[2];  // left-handed
    const glm::dvec3 center_mm{-12.0, 30.0, 700.0};
    const volume::Volume volume =
        noise_volume(trial % 3 == 0 ? glm::ivec3{71, 37, 45} : glm::ivec3{29, 100, 33},
                     trial % 3 == 1 ? glm::dvec3{0.74, 0.74, 3.0} : glm::dvec3{0.7, 1.1, 0.9}, direction, center_mm,
                     static_cast<std::uint64_t>(trial));
    // Wide cones, so that a picture holds rays of several main axes.
    expect_reference(volume,
                     random_rays(rng, center_mm, 60.0 + 300.0 * rng.uniform(), 3.1, 67, 45, trial % 4 == 3));
  }
}

// Like a body: much is air, so that cells are skipped, and what is not lies apart.
TEST_F(XrayOnGpu, IsTheReferenceAcrossEmptyCells) {
  base::Rng rng(82);
  volume::Volume volume = volume::make_volume({150, 120, 40}, {0.9, 0.8, 2.5}, glm::dmat3(1.0), {-60, -50, -50});
  for (int k = 0; k < 40; ++k)
    for (int j = 0; j < 120; ++j)
      for (int i = 0; i < 150; ++i)
        if ((i / 13 + j / 17 + k / 9) % 5 == 0)
          volume.hu[volume.index(i, j, k)] = static_cast<std::int16_t>(4000.0 * rng.uniform() - 1000.0);
  for (int trial = 0; trial < 6; ++trial)
    expect_reference(volume, random_rays(rng, {5.0, 0.0, 0.0}, 300.0, 3.0, 80, 60, trial % 3 == 2));
}

TEST_F(XrayOnGpu, IsTheCpu) {
  base::Rng rng(83);
  const volume::Volume volume =
      noise_volume({90, 80, 40}, {0.74, 0.74, 3.0}, random_rotation(rng), glm::dvec3(10.0), 3);
  XrayGpu gpu(context_, volume);
  const XrayCpu cpu(volume);
  for (int trial = 0; trial < 6; ++trial) {
    const XrayGeometry geometry = random_rays(rng, glm::dvec3(10.0), 200.0, 0.9, 200, 150, trial % 3 == 2);
    const PathLengths on_gpu = gpu.project(geometry, ProjectionMethod::exact);
    const PathLengths on_cpu = cpu.project(geometry, ProjectionMethod::exact);
    double worst_nepers = 0.0;
    for (std::size_t i = 0; i < on_gpu.water_mm.size(); ++i) {
      const double water = kWaterPerMm * std::abs(double{on_gpu.water_mm[i]} - on_cpu.water_mm[i]);
      const double mineral = kWaterPerMm * std::abs(double{on_gpu.mineral_mm[i]} - on_cpu.mineral_mm[i]);
      ASSERT_TRUE(water <= 2e-4 && mineral <= 2e-4) << i << ": " << water << ' ' << mineral;
      worst_nepers = std::max({worst_nepers, water, mineral});
    }
    RecordProperty("worst_nepers", std::to_string(worst_nepers));
  }
}

TEST_F(XrayOnGpu, AHomogeneousBoxIsItsChord) {
  base::Rng rng(84);
  for (int trial = 0; trial < 8; ++trial) {
    const glm::dmat3 direction = random_rotation(rng);
    volume::Volume volume = noise_volume({60, 50, 40}, {1.3, 0.8, 2.1}, direction, glm::dvec3(3.0), 4);
    volume.hu.assign(volume.hu.size(), 0);
    XrayGpu gpu(context_, volume);
    const XrayGeometry geometry = random_rays(rng, glm::dvec3(3.0), 150.0, 1.1, 160, 120, trial % 3 == 2);
    for (const ProjectionMethod method : kMethods) {
      const PathLengths picture = gpu.project(geometry, method, Basis::total);
      for (int row = 0; row < 120; ++row)
        for (int column = 0; column < 160; ++column) {
          const double expected_mm = chord_mm(volume, ray_of(geometry, volume, column, row));
          const double off_mm =
              std::abs(picture.water_mm[static_cast<std::size_t>(row * 160 + column)] - expected_mm);
          ASSERT_TRUE(off_mm <= (expected_mm >= 25.0 ? 1e-5 * expected_mm : 3e-4))
              << column << ' ' << row << ": off by " << off_mm << " of " << expected_mm << " mm";
        }
    }
  }
}

// The same volume stored with its axes in another order, seen from the same place.
TEST_F(XrayOnGpu, DoesNotMindTheOrderOfAxes) {
  base::Rng rng(85);
  const volume::Volume volume = noise_volume({40, 30, 20}, {0.8, 1.1, 2.0}, glm::dmat3(1.0), glm::dvec3(0.0), 5);
  volume::Volume turned = volume;
  turned.size_voxels = {30, 20, 40};
  turned.spacing_mm = {1.1, 2.0, 0.8};
  turned.lps_from_voxel = {volume.lps_from_voxel[1], volume.lps_from_voxel[2], volume.lps_from_voxel[0],
                           volume.lps_from_voxel[3]};
  for (int k = 0; k < 20; ++k)
    for (int j = 0; j < 30; ++j)
      for (int i = 0; i < 40; ++i) turned.hu[turned.index(j, k, i)] = volume.at(i, j, k);
  XrayGpu gpu(context_, volume), gpu_turned(context_, turned);
  for (int trial = 0; trial < 6; ++trial) {
    const XrayGeometry geometry = random_rays(rng, glm::dvec3(0.0), 100.0, 0.9, 90, 70, trial % 3 == 2);
    for (const ProjectionMethod method : kMethods) {
      const PathLengths one = gpu.project(geometry, method, Basis::total);
      const PathLengths other = gpu_turned.project(geometry, method, Basis::total);
      for (std::size_t i = 0; i < one.water_mm.size(); ++i)
        ASSERT_NEAR(one.water_mm[i], other.water_mm[i], 1e-5 * one.water_mm[i] + 3e-4) << i;
    }
  }
}

TEST_F(XrayOnGpu, HasTheSameBitsEveryTimeInAnyOrderOfSizes) {
  base::Rng rng(86);
  const volume::Volume volume = noise_volume({40, 30, 20}, glm::dvec3(1.0), glm::dmat3(1.0), glm::dvec3(0.0), 6);
  const XrayGeometry small = random_rays(rng, glm::dvec3(0.0), 80.0, 1.0, 33, 21, false);
  const XrayGeometry large = random_rays(rng, glm::dvec3(0.0), 80.0, 0.5, 130, 97, false);
  XrayGpu gpu(context_, volume);
  EXPECT_EQ(gpu.last_gpu_ms(), 0.0);
  const PathLengths first = gpu.project(small, ProjectionMethod::exact);
  EXPECT_GT(gpu.last_gpu_ms(), 0.0);
  gpu.project(large, ProjectionMethod::slab);
  gpu.project(large, ProjectionMethod::exact, Basis::total);
  const PathLengths again = gpu.project(small, ProjectionMethod::exact);
  EXPECT_EQ(first.water_mm, again.water_mm);
  EXPECT_EQ(first.mineral_mm, again.mineral_mm);
  XrayGpu other(context_, volume);
  EXPECT_EQ(other.project(small, ProjectionMethod::exact).water_mm, first.water_mm);
}

TEST_F(XrayOnGpu, MayOutliveTheContext) {
  base::Rng rng(87);
  const volume::Volume volume = noise_volume({20, 30, 20}, glm::dvec3(1.0), glm::dmat3(1.0), glm::dvec3(0.0), 7);
  const XrayGeometry geometry = random_rays(rng, glm::dvec3(0.0), 60.0, 2.0, 30, 20, false);
  auto context = std::make_unique<gpu::Context>();
  XrayGpu gpu(*context, volume);
  context.reset();
  EXPECT_TRUE(
      is_the_reference(gpu.project(geometry, ProjectionMethod::exact), volume, geometry, ProjectionMethod::exact));
}

TEST_F(XrayOnGpu, TellsWhenTheVolumeExceedsTheLargestTexture) {
  const volume::Volume volume = noise_volume({1, 1, 1 << 17}, glm::dvec3(1.0), glm::dmat3(1.0), glm::dvec3(0.0), 8);
  try {
    const XrayGpu gpu(context_, volume);
    FAIL() << "accepted";
  } catch (const base::Failure& failure) {
    EXPECT_EQ(failure.code(), "gl");
  }
}

}  // namespace
}  // namespace seldinger::imaging
