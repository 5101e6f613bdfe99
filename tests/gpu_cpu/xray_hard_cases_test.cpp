// What goes wrong in projectors, on the GPU, each with what must come out.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <limits>
#include <memory>

#include "tests/gpu_cpu/xray_rays.h"
#include "tests/sim/imaging/mpr_scene.h"

namespace seldinger::imaging {
namespace {

constexpr ProjectionMethod kExactOrSlab[] = {ProjectionMethod::exact, ProjectionMethod::slab};

class XrayHardCases : public testing::Test {
 protected:
  // Voxel (i,j,k) reaches from (i,j,k) to (i+1,j+1,k+1) mm; exact numbers in float and double.
  static volume::Volume at_whole_mm(glm::ivec3 size) {
    return noise_volume(size, glm::dvec3(1.0), glm::dmat3(1.0), 0.5 * glm::dvec3(size), 91);
  }
  static volume::Volume filled(volume::Volume volume, std::int16_t hu) {
    volume.hu.assign(volume.hu.size(), hu);
    return volume;
  }

  double through(XrayGpu& gpu, const glm::dvec3& from, const glm::dvec3& to,
                 ProjectionMethod method = ProjectionMethod::exact) {
    const XrayGeometry geometry = one_ray(from, to);
    const PathLengths both = gpu.project(geometry, method);
    const double sum = double{both.water_mm.at(0)} + both.mineral_mm.at(0);
    const double total = gpu.project(geometry, method, Basis::total).water_mm.at(0);
    EXPECT_NEAR(sum, total, 1e-5 * sum);
    return sum;
  }

  void expect_reference(const volume::Volume& volume, const XrayGeometry& geometry) {
    ASSERT_TRUE(check_geometry(geometry).has_value());
    XrayGpu gpu(context_, volume);
    for (const ProjectionMethod method : kExactOrSlab)
      EXPECT_TRUE(is_the_reference(gpu.project(geometry, method), volume, geometry, method))
          << static_cast<int>(method);
  }

  // Along `axis` through the voxels whose other indices are `at`'s.
  static double column_mm(const volume::Volume& volume, int axis, glm::ivec3 at) {
    double sum = 0.0;
    for (at[axis] = 0; at[axis] < volume.size_voxels[axis]; ++at[axis])
      sum += std::max(0.0, 1.0 + volume.at(at.x, at.y, at.z) / 1000.0);
    return sum;
  }

  gpu::Context context_;
};

TEST_F(XrayHardCases, RayParallelToAnAxis) {
  const volume::Volume volume = at_whole_mm({23, 19, 21});
  XrayGpu gpu(context_, volume);
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      glm::dvec3 from(7.5, 11.25, 9.75), to = from;
      from[axis] = 10.0 - side * 40.0;
      to[axis] = 10.0 + side * 40.0;
      const double expected_mm = column_mm(volume, axis, {7, 11, 9});
      EXPECT_NEAR(through(gpu, from, to), expected_mm, 1e-5 * expected_mm) << axis << ' ' << side;
      const double slab_mm = lengths_between(volume, from, to, ProjectionMethod::slab).total_mm();
      EXPECT_NEAR(through(gpu, from, to, ProjectionMethod::slab), slab_mm, 1e-5 * slab_mm) << axis << ' ' << side;
    }
}

TEST_F(XrayHardCases, RayWithADenormalComponent) {
  const volume::Volume volume =
      noise_volume({23, 19, 21}, glm::dvec3(1.0), glm::dmat3(1.0), glm::dvec3(0.0), 92);  // 0 is a voxel's centre
  XrayGpu gpu(context_, volume);
  const double expected_mm = column_mm(volume, 0, {0, 9, 10});
  for (const double tiny : {5e-324, -5e-324, 1e-310, -1e-200, 1e-45, -1e-39, 1e-30})
    EXPECT_NEAR(through(gpu, {-40.0, 0.0, tiny}, {40.0, tiny, 0.0}), expected_mm, 1e-5 * expected_mm) << tiny;
}

TEST_F(XrayHardCases, NearlyParallelTendsToParallel) {
  const volume::Volume volume = at_whole_mm({23, 19, 21});
  XrayGpu gpu(context_, volume);
  const double expected_mm = column_mm(volume, 0, {0, 11, 9});
  for (const double slope : {1e-14, 1e-10, 1e-7, -1e-7, 1e-5, -1e-3})
    EXPECT_NEAR(through(gpu, {-20.0, 11.5, 9.5}, {40.0, 11.5 + 60.0 * slope, 9.5 - 60.0 * slope}), expected_mm,
                1e-5 * expected_mm)
        << slope;
  // Nearly parallel, close to a face and crossing it somewhere within.
  for (const double slope : {1e-9, 1e-7, 1e-5, 1e-3, -1e-7, -1e-4})
    for (const double x : {11.0, 11.37, 4.8}) {
      const glm::dvec3 from(-20.0, 11.0 - (x + 20.0) * slope, 9.5), to(40.0, 11.0 + (40.0 - x) * slope, 9.5);
      const double crossing_mm = lengths_between(volume, from, to).total_mm();
      // A face crossed at slope s is met where double tells coordinates apart by 1e-15·20/s.
      EXPECT_NEAR(through(gpu, from, to), crossing_mm, 1e-5 * crossing_mm + 1e-13 / std::abs(slope))
          << slope << " at " << x;
    }
}

TEST_F(XrayHardCases, RayInAVoxelFace) {
  const volume::Volume volume = at_whole_mm({23, 19, 21});
  XrayGpu gpu(context_, volume);
  for (int axis = 0; axis < 3; ++axis)
    for (int other = 0; other < 3; ++other) {
      if (other == axis) continue;
      glm::dvec3 from(7.5), to(7.5);
      from[axis] = -30.0;
      to[axis] = 50.0;
      from[other] = to[other] = 12.0;  // the lower face of voxel 12
      glm::ivec3 at(7);
      at[other] = 12;
      const double expected_mm = column_mm(volume, axis, at);
      EXPECT_NEAR(through(gpu, from, to), expected_mm, 1e-5 * expected_mm) << axis << ' ' << other;
      EXPECT_NEAR(through(gpu, to, from), expected_mm, 1e-5 * expected_mm) << axis << ' ' << other;
    }
}

TEST_F(XrayHardCases, RayAlongAnEdge) {
  const volume::Volume volume = at_whole_mm({23, 19, 21});
  XrayGpu gpu(context_, volume);
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 from(8.0), to(8.0);
    from[axis] = -30.0;
    to[axis] = 50.0;
    const double expected_mm = column_mm(volume, axis, {8, 8, 8});
    EXPECT_NEAR(through(gpu, from, to), expected_mm, 1e-5 * expected_mm) << axis;
  }
}

// Every crossing is of two or three axes at once.
TEST_F(XrayHardCases, RayThroughCorners) {
  const volume::Volume volume = at_whole_mm({24, 24, 24}), water = filled(volume, 0);
  XrayGpu gpu(context_, volume), gpu_water(context_, water);
  for (const glm::dvec3& step : {glm::dvec3(1, 1, 1), glm::dvec3(1, -1, 1), glm::dvec3(-1, 1, 1),
                                 glm::dvec3(-1, -1, -1), glm::dvec3(1, 1, 0), glm::dvec3(0, -1, 1)}) {
    const glm::dvec3 from = glm::dvec3(12.0) - 30.0 * step, to = glm::dvec3(12.0) + 30.0 * step;
    EXPECT_NEAR(through(gpu_water, from, to), 24.0 * glm::length(step), 2.4e-4 * glm::length(step));
    if (step.x != 0.0 && step.y != 0.0 && step.z != 0.0) {  // else it lies in faces: which is RayInAVoxelFace
      const double expected_mm = lengths_between(volume, from, to).total_mm();
      EXPECT_NEAR(through(gpu, from, to), expected_mm, 1e-5 * expected_mm);
    }
  }
}

// The pattern of an even volume under an odd detector: rows and columns of rays in faces.
TEST_F(XrayHardCases, EvenVolumeOddDetector) {
  const volume::Volume volume = filled(at_whole_mm({24, 24, 24}), 0);
  XrayGpu gpu(context_, volume);
  for (const bool parallel : {false, true}) {
    const glm::dvec3 center(60.0, 12.0, 12.0), u(0, 1, 0), v(0, 0, 1);
    const XrayGeometry geometry = parallel ? parallel_rays({1, 0, 0}, center, u, v, 0.5, 33, 33)
                                           : rays_from({-60.0, 12.0, 12.0}, center, u, v, 1.0, 33, 33);
    const PathLengths picture = gpu.project(geometry, ProjectionMethod::exact);
    for (int row = 0; row < 33; ++row)
      for (int column = 0; column < 33; ++column) {
        const double expected_mm = chord_mm(volume, ray_of(geometry, volume, column, row));
        EXPECT_NEAR(picture.water_mm[static_cast<std::size_t>(row * 33 + column)], expected_mm, 1e-5 * expected_mm)
            << column << ' ' << row;
      }
  }
}

TEST_F(XrayHardCases, CornerGraze) {
  const volume::Volume volume = filled(at_whole_mm({24, 24, 24}), 0);
  XrayGpu gpu(context_, volume);
  for (double in = 1.0; in > 1e-16; in *= 0.1)
    for (const glm::dvec3& aside : {glm::dvec3(1, -1, 0), glm::dvec3(1, 0, -1), glm::dvec3(2, -1, -1)}) {
      const glm::dvec3 middle = glm::dvec3(24.0) - (aside.z == 0.0   ? glm::dvec3(in, in, 12.0)
                                                    : aside.y == 0.0 ? glm::dvec3(in, 12.0, in)
                                                                     : glm::dvec3(in));
      const glm::dvec3 from = middle - 20.0 * aside, to = middle + 20.0 * aside;
      const double mm = through(gpu, from, to);
      EXPECT_GE(mm, 0.0) << in;
      EXPECT_NEAR(mm, chord_mm(volume, {from, to}), 1e-5) << in;
    }
}

TEST_F(XrayHardCases, RayInTheOuterFace) {
  const volume::Volume volume = at_whole_mm({23, 19, 21});
  XrayGpu gpu(context_, volume);
  for (int axis = 0; axis < 3; ++axis)
    for (int other = 0; other < 3; ++other) {
      if (other == axis) continue;
      glm::dvec3 from(7.5), to(7.5);
      from[axis] = -30.0;
      to[axis] = 50.0;
      from[other] = to[other] = 0.0;
      glm::ivec3 at(7);
      at[other] = 0;
      const double expected_mm = column_mm(volume, axis, at);
      EXPECT_NEAR(through(gpu, from, to), expected_mm, 1e-5 * expected_mm);  // the lower face is inside
      from[other] = to[other] = volume.size_voxels[other];
      EXPECT_EQ(through(gpu, from, to), 0.0);  // the upper one is not
    }
}

TEST_F(XrayHardCases, FirstAndLastVoxelAndOuterHalves) {
  base::Rng rng(93);
  for (int trial = 0; trial < 6; ++trial) {
    const volume::Volume volume = filled(
        noise_volume({1, 1, 1}, {2.0, 3.0, 0.5}, random_rotation(rng), glm::dvec3(40.0, 0.0, -7.0), 94), 1500);
    XrayGpu gpu(context_, volume);
    const XrayGeometry geometry = random_rays(rng, glm::dvec3(40.0, 0.0, -7.0), 20.0, 0.2, 90, 90, trial % 2 == 1);
    for (const ProjectionMethod method : kExactOrSlab) {
      const PathLengths picture = gpu.project(geometry, method);
      double most_mm = 0.0;
      for (int row = 0; row < 90; ++row)
        for (int column = 0; column < 90; ++column) {
          const double expected_mm = chord_mm(volume, ray_of(geometry, volume, column, row));
          const auto at = static_cast<std::size_t>(row * 90 + column);
          EXPECT_NEAR(picture.water_mm[at], expected_mm, 1e-5 * expected_mm + 3e-6);
          EXPECT_NEAR(picture.mineral_mm[at], 1.5 * expected_mm, 1.5e-5 * expected_mm + 1e-7);
          most_mm = std::max(most_mm, expected_mm);
        }
      EXPECT_GT(most_mm, 0.4);
    }
  }
}

TEST_F(XrayHardCases, SourceAndPixelInside) {
  base::Rng rng(95);
  const volume::Volume volume =
      noise_volume({60, 50, 40}, {0.8, 1.1, 2.0}, random_rotation(rng), glm::dvec3(0.0), 96);
  XrayGpu gpu(context_, volume);
  for (const double distance_mm : {1.0, 4.0, 12.0})  // both inside
    for (int trial = 0; trial < 3; ++trial)
      expect_reference(volume, random_rays(rng, glm::dvec3(0.0), distance_mm, 0.1 * distance_mm, 30, 30, false));
  for (int trial = 0; trial < 4; ++trial) {
    const glm::dmat3 turn = random_rotation(rng);
    const glm::dvec3 inside = 5.0 * random_direction(rng), outside = inside + 150.0 * turn[2];
    expect_reference(volume, rays_from(inside, outside, turn[0], turn[1], 4.0, 30, 30));
    expect_reference(volume, rays_from(outside, inside, turn[0], turn[1], 1.0, 30, 30));
    expect_reference(volume, parallel_rays(turn[2], inside, turn[0], turn[1], 1.0, 30, 30));
    // The volume behind the source, and beyond the detector.
    const glm::dvec3 source = 150.0 * turn[2];
    for (const XrayGeometry& geometry : {rays_from(source, 2.0 * source, turn[0], turn[1], 4.0, 30, 30),
                                         rays_from(2.0 * source, source, turn[0], turn[1], 1.0, 30, 30)}) {
      const PathLengths picture = gpu.project(geometry, ProjectionMethod::exact, Basis::total);
      for (const float mm : picture.water_mm) EXPECT_EQ(mm, 0.0F);
    }
  }
  // Within one voxel.
  EXPECT_NEAR(through(gpu, {0.01, 0.02, 0.03}, {0.06, 0.05, 0.02}),
              lengths_between(volume, {0.01, 0.02, 0.03}, {0.06, 0.05, 0.02}).total_mm(), 1e-5);
}

TEST_F(XrayHardCases, AnisotropicLeftHandedAndShearedVoxels) {
  base::Rng rng(97);
  for (const glm::dvec3& spacing_mm : {glm::dvec3(0.74, 0.74, 3.0), glm::dvec3(0.1, 0.1, 10.0),
                                       glm::dvec3(0.05, 1.0, 50.0), glm::dvec3(20.0, 0.02, 0.5)}) {
    const glm::ivec3 size = glm::clamp(glm::ivec3(60.0 / spacing_mm), glm::ivec3(2), glm::ivec3(120));
    for (int trial = 0; trial < 3; ++trial) {
      glm::dmat3 direction = random_rotation(rng);
      if (trial == 1) direction[0] = -direction[0];
      volume::Volume volume = noise_volume(size, spacing_mm, direction, glm::dvec3(0.0), 98);
      if (trial == 2) volume.lps_from_voxel[2] += 0.3 * volume.lps_from_voxel[1];  // gantry tilt
      const double near_mm = 0.1 * glm::length(spacing_mm * glm::dvec3(size));
      expect_reference(volume, random_rays(rng, glm::dvec3(0.0), 100.0, 0.1 * near_mm, 30, 30, trial == 1));
    }
  }
}

TEST_F(XrayHardCases, PictureTurnsWithThePatient) {
  base::Rng rng(99);
  const volume::Volume volume = noise_volume({50, 40, 30}, {0.8, 0.9, 1.7}, glm::dmat3(1.0), glm::dvec3(0.0), 100);
  const XrayGeometry geometry =
      rays_from({3.0, -200.0, 10.0}, {0.0, 120.0, 0.0}, {1, 0, 0}, {0, 0, -1}, 1.0, 70, 70);
  XrayGpu gpu(context_, volume);
  const PathLengths first = gpu.project(geometry, ProjectionMethod::exact, Basis::total);
  for (int trial = 0; trial < 3; ++trial) {
    const glm::dmat3 turn = random_rotation(rng);
    volume::Volume turned_volume = volume;
    turned_volume.lps_from_voxel = glm::dmat4(turn) * volume.lps_from_voxel;
    XrayGeometry turned = geometry;
    turned.source_lps_mm = turn * *geometry.source_lps_mm;
    turned.detector_center_lps_mm = turn * geometry.detector_center_lps_mm;
    turned.u = turn * geometry.u;
    turned.v = turn * geometry.v;
    XrayGpu turned_gpu(context_, turned_volume);
    const PathLengths second = turned_gpu.project(turned, ProjectionMethod::exact, Basis::total);
    for (std::size_t i = 0; i < first.water_mm.size(); ++i)
      ASSERT_NEAR(first.water_mm[i], second.water_mm[i], 1e-5 * first.water_mm[i] + 1e-5) << i;
  }
}

TEST_F(XrayHardCases, LongRays) {
  for (int axis = 0; axis < 3; ++axis) {
    glm::ivec3 size(5);
    size[axis] = 2048;  // as many layers as any OpenGL has
    const volume::Volume volume = at_whole_mm(size), water = filled(volume, 0);
    XrayGpu gpu(context_, volume), gpu_water(context_, water);
    glm::dvec3 from(0.3), to(4.7);
    from[axis] = -1e3;
    to[axis] = 4e3;
    for (const ProjectionMethod method : kExactOrSlab) {
      const double chord = chord_mm(water, {from, to});
      EXPECT_NEAR(through(gpu_water, from, to, method), chord, 1e-5 * chord);
      const double expected_mm = lengths_between(volume, from, to, method).total_mm();
      EXPECT_NEAR(through(gpu, from, to, method), expected_mm, 1e-5 * expected_mm);
    }
  }
}

TEST_F(XrayHardCases, SourceAtAHundredMetres) {
  base::Rng rng(101);
  const volume::Volume volume =
      noise_volume({60, 50, 40}, {0.74, 0.74, 3.0}, random_rotation(rng), glm::dvec3(0.0), 102);
  for (int trial = 0; trial < 4; ++trial) {
    const glm::dmat3 turn = random_rotation(rng);
    const XrayGeometry far = rays_from(-1e5 * turn[2], 200.0 * turn[2], turn[0], turn[1], 2.0, 60, 60);
    expect_reference(volume, far);
    XrayGeometry near = far;  // and a kilometre is nearly parallel
    near.source_lps_mm = -1e6 * turn[2];
    expect_reference(volume, near);
  }
}

TEST_F(XrayHardCases, RoundingAtTheExitReadsNothingOutside) {
  base::Rng rng(103);
  // Outside would be seen: the outermost voxels are empty, and textures repeat theirs.
  const volume::Volume volume =
      noise_volume({4, 4, 4}, {1.1, 0.7, 0.9}, random_rotation(rng), glm::dvec3(0.0), 104);
  for (int trial = 0; trial < 4; ++trial)
    expect_reference(volume, random_rays(rng, glm::dvec3(0.0), 37.0, 0.05, 180, 180, trial % 2 == 1));
}

TEST_F(XrayHardCases, ExtendedHuAndPadding) {
  const volume::Volume metal = filled(at_whole_mm({8, 8, 8}), 32767);
  XrayGpu gpu(context_, metal);
  EXPECT_NEAR(through(gpu, {-5.0, 3.5, 3.5}, {15.0, 3.5, 3.5}), 8.0 * 33.767, 3e-3);
  for (const std::int16_t hu : {std::int16_t{-1000}, std::int16_t{-1024}, std::int16_t{-32768}}) {
    const volume::Volume nothing = filled(metal, hu);
    XrayGpu none(context_, nothing);
    EXPECT_EQ(through(none, {-5.0, 3.5, 3.5}, {15.0, 3.5, 3.5}), 0.0);
    volume::Volume one = nothing;
    one.hu[one.index(3, 4, 5)] = -999;
    XrayGpu few(context_, one);
    EXPECT_NEAR(through(few, {-5.0, 4.5, 5.5}, {15.0, 4.5, 5.5}), 0.001, 1e-8);
    EXPECT_EQ(through(few, {-5.0, 5.5, 5.5}, {15.0, 5.5, 5.5}), 0.0);
  }
}

TEST_F(XrayHardCases, FlatVolumesAndOddPictures) {
  base::Rng rng(105);
  for (const glm::ivec3& size : {glm::ivec3{1, 1, 60}, {60, 1, 1}, {1, 60, 1}, {50, 40, 1}, {1, 40, 50}, {1, 1, 1}})
    for (const bool parallel : {false, true})
      expect_reference(noise_volume(size, {1.0, 1.3, 0.8}, random_rotation(rng), glm::dvec3(0.0), 106),
                       random_rays(rng, glm::dvec3(0.0), 90.0, 0.7, 60, 50, parallel));
  const volume::Volume volume = noise_volume({30, 40, 20}, glm::dvec3(1.0), glm::dmat3(1.0), glm::dvec3(0.0), 107);
  expect_reference(volume, random_rays(rng, glm::dvec3(0.0), 90.0, 0.7, 1, 1, false));
  expect_reference(volume, random_rays(rng, glm::dvec3(0.0), 90.0, 0.01, 8192, 1, false));
  expect_reference(volume, random_rays(rng, glm::dvec3(0.0), 90.0, 0.01, 1, 8192, false));
  for (const double scale : {1e-3, 1e3}) {
    const volume::Volume scaled =
        noise_volume({30, 40, 20}, glm::dvec3(scale), glm::dmat3(1.0), glm::dvec3(0.0), 108);
    XrayGpu gpu(context_, scaled);
    for (int trial = 0; trial < 2; ++trial) {
      const glm::dmat3 turn = random_rotation(rng);
      const XrayGeometry geometry =
          rays_from(-90.0 * scale * turn[2], 90.0 * scale * turn[2], turn[0], turn[1], 2.0 * scale, 30, 30);
      const PathLengths picture = gpu.project(geometry, ProjectionMethod::exact, Basis::total);
      for (int row = 0; row < 30; ++row)
        for (int column = 0; column < 30; ++column) {
          const RaySegment ray = ray_of(geometry, scaled, column, row);
          const double expected_mm = lengths_between(scaled, ray.from_lps_mm, ray.to_lps_mm).total_mm();
          EXPECT_NEAR(picture.water_mm[static_cast<std::size_t>(row * 30 + column)], expected_mm,
                      1e-5 * expected_mm + 1e-5 * scale);
        }
    }
  }
}

TEST_F(XrayHardCases, APartOfThePictureIsThatPart) {
  base::Rng rng(109);
  const volume::Volume volume =
      noise_volume({40, 30, 20}, glm::dvec3(1.0), random_rotation(rng), glm::dvec3(0.0), 110);
  XrayGpu gpu(context_, volume);
  for (const bool parallel : {false, true}) {
    const XrayGeometry whole = random_rays(rng, glm::dvec3(0.0), 60.0, 1.0, 80, 60, parallel);
    const PathLengths picture = gpu.project(whole, ProjectionMethod::exact);
    XrayGeometry part = whole;
    part.width_px = 40;
    part.height_px = 30;
    part.detector_center_lps_mm = whole.detector_center_lps_mm - 10.0 * whole.u + 5.0 * whole.v;
    const PathLengths detail = gpu.project(part, ProjectionMethod::exact);
    for (int row = 0; row < 30; ++row)
      for (int column = 0; column < 40; ++column) {
        const auto in_whole = static_cast<std::size_t>((row + 20) * 80 + column + 10);
        ASSERT_NEAR(detail.water_mm[static_cast<std::size_t>(row * 40 + column)], picture.water_mm[in_whole],
                    1e-6 * picture.water_mm[in_whole] + 1e-6);
      }
  }
}

}  // namespace
}  // namespace seldinger::imaging
