// Rays on which projectors fail: each case says what must come out. Beside this file: 15 (no hardware filtering
// anywhere), 18 and 19 (rescale, NaN: tests/casedb/import), 21 (thick absorption: detector_test), 22 (degenerate
// geometry: projection_test), 24 (tiles: projection_test), 25 (a fiducial: projection_test, c_arm tests), 26 (no
// GL: tests/e2e/render_xray_test). Run on the double reference and on the packets of every instruction set;
// tests/gpu_cpu runs the GPU on the same kinds.
#include <functional>
#include <limits>

#include "sim/imaging/xray/projection/coarse.h"
#include "sim/imaging/xray/projection/packet_volume.h"
#include "tests/sim/imaging/xray/xray_scene.h"

namespace seldinger::imaging {
namespace {

// What every projector answers for one ray, mm of water.
std::vector<double> answers(const volume::Volume& volume, const glm::dvec3& from, const glm::dvec3& to) {
  std::vector<double> all = {lengths_between(volume, from, to).total_mm()};
  const XrayCpu cpu(volume);
  for (const Instructions instructions : all_instructions())
    all.push_back(
        total_mm(cpu.project(one_ray(from, to), ProjectionMethod::exact, {Basis::total, instructions, 1}), 0));
  return all;
}

void expect_mm(const volume::Volume& volume, const glm::dvec3& from, const glm::dvec3& to, double expected_mm,
               double tolerance_mm = 3e-4) {
  for (const double answer : answers(volume, from, to)) EXPECT_NEAR(answer, expected_mm, tolerance_mm);
}

// A value of its own for each column of voxels along x, so that a wrong column is seen.
volume::Volume columns() {
  volume::Volume volume = centered({10, 8, 6}, {2, 2, 2}, 0);
  for (int k = 0; k < 6; ++k)
    for (int j = 0; j < 8; ++j)
      for (int i = 0; i < 10; ++i)
        volume.hu[volume.index(i, j, k)] = static_cast<std::int16_t>(-1000 + 20 * (j + 8 * k + 1));
  return volume;
}

double column_mm(int j, int k) {
  return 10 * 2.0 * 20 * (j + 8 * k + 1) / 1000.0;
}

TEST(XrayHardCases, C1RayParallelToAnAxis) {
  const volume::Volume volume = columns();
  for (int j = 0; j < 8; ++j)
    for (int k = 0; k < 6; ++k) {
      const double y = -7.0 + 2 * j + 0.3, z = -5.0 + 2 * k - 0.4;
      expect_mm(volume, {-500, y, z}, {300, y, z}, column_mm(j, k));
      expect_mm(volume, {300, y, z}, {-500, y, z}, column_mm(j, k));
    }
  expect_mm(volume, {-500, 8.5, 0}, {300, 8.5, 0}, 0.0);  // beside the volume
}

TEST(XrayHardCases, C2NearlyParallelIsContinuousWithParallel) {
  const volume::Volume volume = columns();
  for (const double slope : {0.0, 5e-324, 1e-300, 1e-30, 1e-12, 1e-9, 1e-7})
    for (const double sign : {-1.0, 1.0})
      expect_mm(volume, {-500, 1.3, 0.7}, {300, 1.3 + sign * slope * 800.0, 0.7}, column_mm(4, 3), 1e-3);
}

TEST(XrayHardCases, C3RayInAVoxelFaceAlongAnEdgeThroughCorners) {
  // The upper of the two voxels owns the face between them.
  const volume::Volume volume = columns();
  expect_mm(volume, {-500, 2.0, 0.5}, {300, 2.0, 0.5}, column_mm(5, 3));
  expect_mm(volume, {-500, 2.0, 2.0}, {300, 2.0, 2.0}, column_mm(5, 4));
  // In water the answer does not depend on who owns what: corner to corner through every voxel's corners.
  const volume::Volume water = centered({8, 8, 8}, {1.5, 1.5, 1.5}, 0);
  expect_mm(water, {-60, -60, -60}, {60, 60, 60}, 12.0 * std::sqrt(3.0));
  expect_mm(water, {-60, 60, 0.2}, {60, -60, 0.2}, 12.0 * std::sqrt(2.0));
  expect_mm(water, {-60, 60, 60}, {60, -60, -60}, 12.0 * std::sqrt(3.0));
}

TEST(XrayHardCases, C4CornerGrazeTendsToZeroAndIsNeverNegative) {
  const volume::Volume water = centered({8, 8, 8}, {1, 1, 1}, 0);
  for (double inside_mm = 1e-1; inside_mm > 1e-9; inside_mm *= 0.3) {
    const glm::dvec3 near(4.0, 4.0, 4.0 - 0.5 * inside_mm);
    const glm::dvec3 along = glm::normalize(glm::dvec3(1.0, -1.0, 0.001));
    const glm::dvec3 from = near - glm::dvec3(inside_mm, inside_mm, 0) - 200.0 * along,
                     to = near - glm::dvec3(inside_mm, inside_mm, 0) + 200.0 * along;
    const double chord_mm = box_chord_mm(glm::dvec3(-4), glm::dvec3(4), from, to);
    for (const double answer : answers(water, from, to)) {
      EXPECT_GE(answer, 0.0);
      EXPECT_NEAR(answer, chord_mm, 3e-4);
    }
  }
}

TEST(XrayHardCases, C5LowerOuterFaceIsInsideUpperIsOutside) {
  const volume::Volume water = centered({8, 8, 8}, {1, 1, 1}, 0);
  expect_mm(water, {-50, -4.0, 0.3}, {50, -4.0, 0.3}, 8.0);
  expect_mm(water, {-50, 4.0, 0.3}, {50, 4.0, 0.3}, 0.0);
}

TEST(XrayHardCases, C6OneVoxelIsItsChord) {
  const volume::Volume voxel = centered({1, 1, 1}, {2.0, 3.0, 4.0}, 500);
  expect_mm(voxel, {-20, 0.1, 0.2}, {20, 0.1, 0.2}, 2.0 * 1.5);
  const glm::dvec3 from(-30, -20, -25), to(31, 22, 24);
  expect_mm(voxel, from, to, 1.5 * box_chord_mm({-1, -1.5, -2}, {1, 1.5, 2}, from, to));
}

TEST(XrayHardCases, C7OuterHalfVoxelsCount) {
  for (const ProjectionMethod method :
       {ProjectionMethod::exact, ProjectionMethod::slab, ProjectionMethod::trilinear}) {
    const volume::Volume water = centered({12, 10, 8}, {1, 1, 3}, 0);
    EXPECT_NEAR(lengths_between(water, {-50, 4.8, 11.0}, {50, 4.8, 11.0}, method).total_mm(), 12.0, 1e-10);
    EXPECT_NEAR(total_mm(XrayCpu(water).project(one_ray({-50, 4.8, 11.0}, {50, 4.8, 11.0}), method), 0), 12.0,
                1e-4);
  }
}

TEST(XrayHardCases, C8SourceAndDetectorInsideTheVolume) {
  const volume::Volume water = centered({40, 40, 40}, {1, 1, 1}, 0);
  for (const ProjectionMethod method :
       {ProjectionMethod::exact, ProjectionMethod::slab, ProjectionMethod::trilinear}) {
    const auto expect = [&](const glm::dvec3& from, const glm::dvec3& to, double expected_mm) {
      EXPECT_NEAR(lengths_between(water, from, to, method).total_mm(), expected_mm, 1e-10);
      EXPECT_NEAR(total_mm(XrayCpu(water).project(one_ray(from, to), method), 0), expected_mm, 3e-4);
    };
    expect({3.2, 1.1, 0.4}, {100, 1.1, 0.4}, 16.8);      // source inside
    expect({-100, 1.1, 0.4}, {3.2, 1.1, 0.4}, 23.2);     // detector inside
    expect({-3.0, 1.1, -2.0}, {5.0, 7.1, -2.0}, 10.0);   // both inside
    expect({1.21, 1.1, 0.4}, {1.22, 1.1, 0.4}, 0.01);    // both within a voxel
    expect({30.0, 0.0, 0.0}, {100.0, 3.0, 2.0}, 0.0);    // volume behind the source
    expect({-100.0, 0.0, 0.0}, {-30.0, 3.0, 2.0}, 0.0);  // volume behind the detector
  }
  EXPECT_EQ(lengths_between(water, {1, 2, 3}, {1, 2, 3}).total_mm(), 0.0);
}

// Fans so wide that rays of one row run both ways along an axis, in a volume most of which is skipped.
TEST(XrayHardCases, C8WideFansFromASourceInside) {
  volume::Volume sparse = centered({60, 50, 40}, {2, 2, 2}, -1000);
  for (std::size_t i = 0; i < 12; ++i) {
    const auto at = [&](std::uint64_t k, int n) { return static_cast<int>(base::uniform_at(6, 3 * i + k) * n); };
    for (int k = 0; k < 27; ++k)
      sparse.hu[sparse.index(at(0, 57) + k % 3, at(1, 47) + k / 3 % 3, at(2, 37) + k / 9)] = 3000;
  }
  const XrayCpu cpu(sparse);
  for (std::uint64_t i = 0; i < 400; ++i) {
    const auto u = [&](std::uint64_t k) { return 2.0 * base::uniform_at(23, 8 * i + k) - 1.0; };
    XrayGeometry g = facing(glm::normalize(glm::dvec3(u(0), u(1), u(2))), 300.0, 24);
    g.source_lps_mm = 30.0 * glm::dvec3(u(3), u(4), u(5));
    g.detector_center_lps_mm = *g.source_lps_mm + (5.0 + 20.0 * (1.0 + u(6))) * glm::cross(g.u, g.v);
    for (const ProjectionMethod method : {ProjectionMethod::exact, ProjectionMethod::slab})
      ASSERT_LE(errors_of(cpu.project(g, method), xray_reference(sparse, g, method)).max_nepers,
                method == ProjectionMethod::exact ? 1e-4 : 5e-2)
          << i;
  }
}

TEST(XrayHardCases, C9AnisotropicMirroredAndShearedVoxels) {
  // Gantry tilt: slices of 3 mm, each shifted along y by 0.8 mm more.
  volume::Volume tilted = noisy({40, 40, 20}, {1, 1, 1});
  tilted.lps_from_voxel = glm::dmat4(1.0);
  tilted.lps_from_voxel[2] = glm::dvec4(0.0, 0.8, 3.0, 0.0);
  tilted.lps_from_voxel[3] = glm::dvec4(-20.0, -28.0, -30.0, 1.0);
  tilted.spacing_mm = {1.0, 1.0, glm::length(glm::dvec3(0.0, 0.8, 3.0))};
  volume::Volume flipped = noisy({40, 40, 20}, {0.74, 0.74, 3.0});
  flipped.lps_from_voxel = glm::dmat4(glm::dvec4(-0.74, 0, 0, 0), glm::dvec4(0, 0.74, 0, 0),
                                      glm::dvec4(0, 0, -3.0, 0), glm::dvec4(14, -14, 28, 1));
  for (const volume::Volume* volume : {&tilted, &flipped}) {
    const XrayGeometry g = facing({0.4, 1.0, 0.35}, 110.0, 64);
    const Errors errors = errors_of(XrayCpu(*volume).project(g, ProjectionMethod::exact),
                                    xray_reference(*volume, g, ProjectionMethod::exact));
    EXPECT_GT(errors.compared, 500U);
    EXPECT_LE(errors.max_relative, 1e-4);
  }
  const volume::Volume needles = centered({100, 10, 10}, {0.01, 10.0, 10.0}, 0);  // 1 : 1000
  const glm::dvec3 from(-300, -20, 10), to(310, 30, -12);
  expect_mm(needles, from, to, box_chord_mm({-0.5, -50, -50}, {0.5, 50, 50}, from, to));
}

TEST(XrayHardCases, C10ThePictureTurnsWithThePatient) {
  const volume::Volume upright = noisy({32, 24, 16}, {1.0, 1.4, 2.0});
  const glm::dmat3 turn(glm::dvec3(0.8, 0.6, 0.0), glm::dvec3(-0.48, 0.64, 0.6), glm::dvec3(0.36, -0.48, 0.8));
  volume::Volume turned = volume::make_volume(upright.size_voxels, upright.spacing_mm, turn,
                                              turn * glm::dvec3(upright.lps_from_voxel[3]));
  turned.hu = upright.hu;
  const XrayGeometry g = facing({0.5, 1.0, 0.3}, 80.0, 48);
  XrayGeometry h = g;
  h.source_lps_mm = turn * *g.source_lps_mm;
  h.detector_center_lps_mm = turn * g.detector_center_lps_mm;
  h.u = turn * g.u;
  h.v = turn * g.v;
  const Errors errors = errors_of(XrayCpu(turned).project(h, ProjectionMethod::exact),
                                  XrayCpu(upright).project(g, ProjectionMethod::exact));
  EXPECT_GT(errors.compared, 300U);
  EXPECT_LE(errors.max_relative, 1e-5);
}

TEST(XrayHardCases, C11NoDriftOverLongRaysAndFarSources) {
  const volume::Volume rod = centered({4096, 3, 3}, {0.5, 1, 1}, 100);
  expect_mm(rod, {-2000, -0.9, 0.8}, {2000, 0.9, -0.8},
            1.1 * 2048.0 * glm::length(glm::dvec3(4000, 1.8, 1.6)) / 4000.0, 5e-3);
  const volume::Volume volume = noisy({64, 64, 20}, {0.74, 0.74, 3.0});
  XrayGeometry g = facing({0.6, 0.8, 0.1}, 60.0, 48);
  g.source_lps_mm = -100'000.0 * glm::normalize(glm::dvec3(0.6, 0.8, 0.1));
  const Errors errors = errors_of(XrayCpu(volume).project(g, ProjectionMethod::exact),
                                  xray_reference(volume, g, ProjectionMethod::exact));
  EXPECT_GT(errors.compared, 500U);
  EXPECT_LE(errors.max_relative, 1e-4);
}

// Most rays of a row miss by far, in voxels beyond any 32-bit number: they must not disturb the few that hit.
TEST(XrayHardCases, C11RaysThatMissByFarDisturbNothing) {
  const volume::Volume volume = noisy({24, 20, 16}, {0.05, 0.05, 0.05});
  XrayGeometry g = facing({0.6, 0.8, 0.1}, 2.0, 3);
  g.width_px = 63;
  g.pixel_mm = 1e7;  // the middle pixel alone looks at the volume
  const PathLengths reference = xray_reference(volume, g, ProjectionMethod::exact);
  EXPECT_GT(total_mm(reference, 94), 0.0);
  for (const Instructions instructions : all_instructions())
    EXPECT_LE(
        errors_of(XrayCpu(volume).project(g, ProjectionMethod::exact, {Basis::total, instructions, 1}), reference)
            .max_nepers,
        1e-5);
}

// Rays that end within rounding of the last face, at every kind of exit.
TEST(XrayHardCases, C12IndexAtTheExitStaysInside) {
  const volume::Volume water = centered({33, 31, 7}, {0.7, 0.7, 2.9}, 0);
  const glm::dvec3 high = 0.5 * glm::dvec3(water.size_voxels) * water.spacing_mm;
  const XrayCpu cpu(water);
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const auto u = [&](std::uint64_t k) { return 2.0 * base::uniform_at(21, 8 * i + k) - 1.0; };
    glm::dvec3 edge = high * glm::dvec3(u(0), u(1), u(2));
    edge[static_cast<int>(i % 3)] = high[static_cast<int>(i % 3)] * (u(3) < 0 ? -1.0 : 1.0);
    edge[static_cast<int>((i + 1) % 3)] = high[static_cast<int>((i + 1) % 3)] * (u(4) < 0 ? -1.0 : 1.0);
    const glm::dvec3 from(300.0 * u(5), 300.0 * u(6), 900.0 + 10.0 * u(7));
    const glm::dvec3 to = edge + (edge - from);
    const double chord_mm = box_chord_mm(-high, high, from, to);
    ASSERT_NEAR(total_mm(cpu.project(one_ray(from, to), ProjectionMethod::exact), 0), chord_mm, 3e-4) << i;
  }
}

TEST(XrayHardCases, C13NoLossOfDigitsInLongSums) {
  const volume::Volume rod = centered({4096, 2, 2}, {1, 1, 1}, 0);
  const glm::dvec3 from(-3000, 0.5, 0.5), to(3000, 0.5, 0.5);
  for (const double answer : answers(rod, from, to)) EXPECT_NEAR(answer, 4096.0, 4096.0 * 1e-6);
}

TEST(XrayHardCases, C14HuOf16BitsIsExact) {
  const volume::Volume dense = centered({9, 9, 9}, {1, 1, 1}, 2049);
  expect_mm(dense, {-50, 0.2, 0.3}, {50, 0.2, 0.3}, 9.0 * 3.049);
}

TEST(XrayHardCases, C16ExtendedHuIsNeverClamped) {
  const volume::Volume metal = centered({3, 3, 3}, {1, 1, 1}, 32767);
  const glm::dvec3 from(-50, 0.2, 0.3), to(50, 0.2, 0.3);
  expect_mm(metal, from, to, 3.0 * 33.767, 3e-4);
  const RayLengths both = lengths_between(metal, from, to);
  EXPECT_NEAR(both.water_mm, 3.0, 1e-12);
  EXPECT_NEAR(both.mineral_mm, 3.0 * 32.767, 1e-10);
}

TEST(XrayHardCases, C17AirAndPaddingAttenuateNothingAndLungIsKept) {
  for (const int hu : {-1000, -1024}) {
    const volume::Volume air = centered({9, 9, 9}, {1, 1, 1}, hu);
    expect_mm(air, {-50, 0.2, 0.3}, {50, 0.2, 0.3}, 0.0, 0.0);
  }
  const volume::Volume lung = centered({9, 9, 9}, {1, 1, 1}, -850);
  expect_mm(lung, {-50, 0.2, 0.3}, {50, 0.2, 0.3}, 9.0 * 0.15);
}

TEST(XrayHardCases, C20ThinVolumesAndOddPictures) {
  const volume::Volume slice = noisy({50, 40, 1}, {0.8, 0.8, 5.0});
  const volume::Volume line = noisy({1, 1, 200}, {3.0, 3.0, 0.5});
  for (const volume::Volume* volume : {&slice, &line}) {
    XrayGeometry g = facing({0.5, 0.7, 0.3}, 60.0, 33);
    g.height_px = 21;
    for (const ProjectionMethod method : {ProjectionMethod::exact, ProjectionMethod::slab}) {
      const Errors errors = errors_of(XrayCpu(*volume).project(g, method), xray_reference(*volume, g, method));
      EXPECT_GT(errors.compared, 10U);
      EXPECT_LE(errors.max_nepers, 1e-4);
    }
  }
  XrayGeometry wide = facing({0, 1, 0}, 400.0, 8192);
  wide.height_px = 1;
  wide.pixel_mm = 0.01;
  EXPECT_LE(errors_of(XrayCpu(slice).project(wide, ProjectionMethod::exact),
                      xray_reference(slice, wide, ProjectionMethod::exact))
                .max_nepers,
            1e-4);
}

// A plane wave of 2.4 periods a pixel: one ray a pixel sees slow stripes that are not there, the mean of 8 × 8 rays
// hardly any.
TEST(XrayHardCases, C23FastPatternsDoNotTurnIntoStripes) {
  volume::Volume wave = centered({960, 4, 96}, {0.05, 1.0, 0.5}, 0);
  const double pixel_mm = 1.2, period_mm = pixel_mm / 2.4;
  for (int k = 0; k < 96; ++k)
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 960; ++i)
        wave.hu[wave.index(i, j, k)] = static_cast<std::int16_t>(
            std::lround(800.0 * std::sin(2.0 * 3.14159265358979 * (i * 0.05) / period_mm)));
  XrayGeometry g = parallel({0, 1, 0}, 1.0, 30);
  g.pixel_mm = pixel_mm;
  const auto stripes = [](const PathLengths& lengths) {
    double mean = 0.0, square = 0.0;
    for (int column = 2; column < 28; ++column)
      mean += total_mm(lengths, static_cast<std::size_t>(15 * 30 + column)) / 26.0;
    for (int column = 2; column < 28; ++column) {
      const double off = total_mm(lengths, static_cast<std::size_t>(15 * 30 + column)) - mean;
      square += off * off / 26.0;
    }
    return std::sqrt(square);
  };
  const XrayCpu cpu(wave);
  const double alone = stripes(cpu.project(g, ProjectionMethod::exact));
  const double together = stripes(averaged(cpu.project(finer(g, 8), ProjectionMethod::exact), 8));
  EXPECT_GT(alone, 1.0);
  EXPECT_LT(together, 0.2 * alone) << alone;
}

// The cells that are skipped are exactly the empty ones: a volume with isolated voxels in air.
TEST(XrayHardCases, SkippedCellsHoldNothing) {
  volume::Volume sparse = centered({70, 50, 40}, {1, 1, 1}, -1000);
  for (std::size_t i = 0; i < 60; ++i) {
    const auto at = [&](std::uint64_t k, int n) { return static_cast<int>(base::uniform_at(5, 3 * i + k) * n); };
    sparse.hu[sparse.index(at(0, 70), at(1, 50), at(2, 40))] = 3000;
  }
  const PacketVolume kept(sparse);
  for (int k = 0; k < kept.size.z; ++k)
    for (int j = 0; j < kept.size.y; ++j)
      for (int i = 0; i < kept.size.x; ++i) {
        const auto& order = kept.order_for((i + j + k) % 3);  // all orders hold the same
        const int at = i * order.stride.x + j * order.stride.y + k * order.stride.z;
        ASSERT_EQ(kept.first(order)[at],
                  std::max(0, 1000 + sparse.at(kept.low.x + i, kept.low.y + j, kept.low.z + k)));
        if (kept.first(order)[at] != 0) {
          ASSERT_TRUE(kept.any_in({i, j, k}, {i, j, k}));
        }
      }
  const XrayGeometry g = facing({0.7, 1.0, 0.4}, 110.0, 128);
  for (const ProjectionMethod method : {ProjectionMethod::exact, ProjectionMethod::slab})
    EXPECT_LE(errors_of(XrayCpu(sparse).project(g, method), xray_reference(sparse, g, method)).max_nepers, 1e-5);
}

}  // namespace
}  // namespace seldinger::imaging
