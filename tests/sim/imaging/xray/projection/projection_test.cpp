// Projectors against closed forms, against each other, and against what must not change a picture.
#include <limits>

#include "sim/volume/analytic.h"
#include "tests/sim/imaging/xray/xray_scene.h"

namespace seldinger::imaging {
namespace {

glm::dvec3 somewhere(std::uint64_t i, double reach_mm) {
  return reach_mm * (2.0 * glm::dvec3(base::uniform_at(11, 3 * i), base::uniform_at(11, 3 * i + 1),
                                      base::uniform_at(11, 3 * i + 2)) -
                     1.0);
}

// 10⁴ rays through a box of water; the double reference.
TEST(Projection, ReferenceIsTheChordOfABox) {
  const volume::Volume box = centered({40, 50, 20}, {1.3, 0.9, 3.1}, 0);
  const glm::dvec3 high = 0.5 * glm::dvec3(box.size_voxels) * box.spacing_mm;
  int long_chords = 0, short_chords = 0;
  for (std::uint64_t i = 0; i < 10'000; ++i) {
    const glm::dvec3 from = 900.0 * glm::normalize(somewhere(2 * i, 1.0));
    const glm::dvec3 to = -0.6 * from + somewhere(2 * i + 1, 60.0);
    const double chord_mm = box_chord_mm(-high, high, from, to);
    const RayLengths ray = lengths_between(box, from, to);
    EXPECT_EQ(ray.mineral_mm, 0.0);
    const bool is_long = chord_mm >= 25.0;
    ASSERT_LE(std::abs(ray.water_mm - chord_mm), is_long ? 1e-12 * chord_mm : 1e-11) << i << ' ' << chord_mm;
    ++(is_long ? long_chords : short_chords);
  }
  EXPECT_GT(long_chords, 1000);
  EXPECT_GT(short_chords, 500);
}

// Rays through every corner and edge of a picture that is larger than the box.
TEST(Projection, FloatIsTheChordOfABox) {
  const volume::Volume box = centered({40, 50, 20}, {1.3, 0.9, 3.1}, 0);
  const glm::dvec3 high = 0.5 * glm::dvec3(box.size_voxels) * box.spacing_mm;
  const XrayCpu cpu(box);
  for (const glm::dvec3& axis : {glm::dvec3(1, 0.3, 0.2), glm::dvec3(-0.2, 1, -0.5), glm::dvec3(0.4, -0.3, 1)}) {
    const XrayGeometry g = facing(axis, 160.0, 257);
    for (const Instructions instructions : all_instructions()) {
      const PathLengths lengths = cpu.project(g, ProjectionMethod::exact, {Basis::total, instructions, 1});
      double worst_long = 0.0, worst_short = 0.0;
      for (int row = 0; row < g.height_px; ++row)
        for (int column = 0; column < g.width_px; ++column) {
          const RaySegment ray = ray_of(g, box, column, row);
          const double chord_mm = box_chord_mm(-high, high, ray.from_lps_mm, ray.to_lps_mm);
          const double error =
              std::abs(total_mm(lengths, static_cast<std::size_t>(row * g.width_px + column)) - chord_mm);
          ASSERT_TRUE(error >= 0.0);
          if (chord_mm >= 25.0)
            worst_long = std::max(worst_long, error / chord_mm);
          else
            worst_short = std::max(worst_short, error);
        }
      EXPECT_LE(worst_long, 1e-5);
      EXPECT_LE(worst_short, 3e-4);
    }
  }
}

struct Setting {
  const char* name;
  volume::Volume volume;
  XrayGeometry geometry;
};

// An oblique, left-handed, anisotropic grid among them.
std::vector<Setting> settings() {
  const volume::Volume plain = noisy({96, 80, 40}, {0.74, 0.74, 3.0});
  volume::Volume oblique = plain;
  const glm::dmat3 direction(glm::dvec3(0.8, 0.6, 0.0), glm::dvec3(-0.48, 0.64, 0.6),
                             glm::dvec3(-0.36, 0.48, -0.8));
  oblique = volume::make_volume(plain.size_voxels, plain.spacing_mm, direction, {-30.0, -40.0, 50.0});
  oblique.hu = plain.hu;
  return {{"point, 7 rad", plain, facing({-std::cos(7.0), -std::sin(7.0), 0.0}, 200.0, 96)},
          {"point, along x", plain, facing({1, 0, 0}, 200.0, 97)},
          {"point, oblique view", plain, facing({0.5, -0.7, 0.6}, 220.0, 96)},
          {"parallel, oblique view", plain, parallel({0.3, 0.9, -0.4}, 150.0, 96)},
          {"point, oblique grid", oblique, facing({0.2, 1.0, 0.1}, 260.0, 96)},
          {"thin voxels", noisy({64, 64, 8}, {0.1, 0.1, 10.0}), facing({1.0, 0.8, 0.3}, 120.0, 64)},
          {"flat voxels", noisy({20, 20, 200}, {10.0, 10.0, 0.05}), facing({0.1, 1.0, 0.02}, 300.0, 64)}};
}

TEST(Projection, FloatAgreesWithDouble) {
  for (const Setting& s : settings()) {
    SCOPED_TRACE(s.name);
    const PathLengths reference = xray_reference(s.volume, s.geometry, ProjectionMethod::exact);
    const Errors errors = errors_of(XrayCpu(s.volume).project(s.geometry, ProjectionMethod::exact), reference);
    EXPECT_GT(errors.compared, 250U);
    EXPECT_LE(errors.median_relative, 5e-6);
    EXPECT_LE(errors.max_relative, 1e-4);
    RecordProperty(std::string("max_relative ") + s.name, std::to_string(errors.max_relative * 1e6) + "e-6");
  }
}

TEST(Projection, SlabAgreesWithItsReference) {
  for (const Setting& s : settings()) {
    SCOPED_TRACE(s.name);
    const PathLengths reference = xray_reference(s.volume, s.geometry, ProjectionMethod::slab);
    const Errors errors = errors_of(XrayCpu(s.volume).project(s.geometry, ProjectionMethod::slab), reference);
    EXPECT_GT(errors.compared, 250U);
    EXPECT_LE(errors.median_relative, 5e-6);
    EXPECT_LE(errors.max_relative, 2e-4);
  }
}

// Any instructions, any number of threads, one or two sums: the same bits.
TEST(Projection, SameBitsForAnyInstructionsAndThreads) {
  for (const Setting& s : settings()) {
    SCOPED_TRACE(s.name);
    const XrayCpu cpu(s.volume);
    for (const ProjectionMethod method : {ProjectionMethod::exact, ProjectionMethod::slab}) {
      const PathLengths first =
          cpu.project(s.geometry, method, {Basis::water_and_mineral, Instructions::scalar, 1});
      for (const Instructions instructions : all_instructions())
        for (const int threads : {1, 3}) {
          const PathLengths other =
              cpu.project(s.geometry, method, {Basis::water_and_mineral, instructions, threads});
          EXPECT_EQ(first.water_mm, other.water_mm);
          EXPECT_EQ(first.mineral_mm, other.mineral_mm);
        }
    }
  }
}

TEST(Projection, TotalIsTheSumOfWaterAndMineral) {
  for (const Setting& s : settings()) {
    SCOPED_TRACE(s.name);
    const XrayCpu cpu(s.volume);
    const PathLengths both = cpu.project(s.geometry, ProjectionMethod::exact);
    const PathLengths total = cpu.project(s.geometry, ProjectionMethod::exact, {Basis::total});
    EXPECT_LE(errors_of(total, both).max_relative, 1e-6);
  }
}

// A picture in parts is the picture: each part a geometry of its own.
TEST(Projection, ATileIsThePartOfTheWhole) {
  const volume::Volume volume = noisy({64, 64, 32}, {1, 1, 2});
  const XrayCpu cpu(volume);
  const XrayGeometry whole = facing({0.4, 1.0, 0.3}, 128.0, 64);
  const PathLengths all = cpu.project(whole, ProjectionMethod::exact);
  for (const int left : {0, 32})
    for (const int top : {0, 32}) {
      XrayGeometry part = whole;
      part.width_px = part.height_px = 32;
      part.detector_center_lps_mm += (left - 16.0) * part.pixel_mm * part.u + (top - 16.0) * part.pixel_mm * part.v;
      const PathLengths one = cpu.project(part, ProjectionMethod::exact);
      for (int row = 0; row < 32; ++row)
        for (int column = 0; column < 32; ++column)
          ASSERT_NEAR(total_mm(one, static_cast<std::size_t>(row * 32 + column)),
                      total_mm(all, static_cast<std::size_t>((row + top) * 64 + column + left)), 1e-3);
    }
}

// Values that add: the lengths add.
TEST(Projection, IsLinear) {
  const glm::ivec3 size(48, 48, 24);
  volume::Volume a = noisy(size, {1, 1, 2}, -1000, -400), b = a, sum = a;
  for (std::size_t i = 0; i < a.hu.size(); ++i) {
    b.hu[i] = static_cast<std::int16_t>(-1000 + base::uniform_at(8, i) * 400.0);
    sum.hu[i] = static_cast<std::int16_t>(a.hu[i] + b.hu[i] + 1000);
  }
  const XrayGeometry g = facing({0.7, 1.0, -0.2}, 110.0, 64);
  const CpuOptions total{Basis::total};
  const PathLengths of_a = XrayCpu(a).project(g, ProjectionMethod::exact, total),
                    of_b = XrayCpu(b).project(g, ProjectionMethod::exact, total),
                    of_sum = XrayCpu(sum).project(g, ProjectionMethod::exact, total);
  for (std::size_t i = 0; i < of_a.water_mm.size(); ++i) {
    const double expected = static_cast<double>(of_a.water_mm[i]) + static_cast<double>(of_b.water_mm[i]);
    ASSERT_NEAR(total_mm(of_sum, i), expected, 1e-6 * expected + 1e-5);
  }
}

TEST(Projection, SourceAndPixelCanChangePlaces) {
  const volume::Volume volume = noisy({48, 40, 30}, {1.1, 0.9, 2.3});
  const XrayCpu cpu(volume);
  for (std::uint64_t i = 0; i < 300; ++i) {
    const glm::dvec3 from = 700.0 * glm::normalize(somewhere(2 * i, 1.0));
    const glm::dvec3 to = -0.5 * from + somewhere(2 * i + 1, 20.0);
    const double there = total_mm(cpu.project(one_ray(from, to), ProjectionMethod::exact), 0);
    const double back = total_mm(cpu.project(one_ray(to, from), ProjectionMethod::exact), 0);
    ASSERT_NEAR(there, back, 1e-5 * there + 1e-6) << i;
  }
}

// The patient and the machine turned together, axes exchanged: the same picture.
TEST(Projection, AxesCanBeExchanged) {
  const volume::Volume volume = noisy({40, 28, 20}, {1.0, 1.5, 2.5});
  volume::Volume turned = volume::make_volume({20, 40, 28}, {2.5, 1.0, 1.5}, glm::dmat3(1.0),
                                              -0.5 * glm::dvec3(19, 39, 27) * glm::dvec3(2.5, 1.0, 1.5));
  for (int k = 0; k < 20; ++k)
    for (int j = 0; j < 28; ++j)
      for (int i = 0; i < 40; ++i) turned.hu[turned.index(k, i, j)] = volume.at(i, j, k);
  const XrayGeometry g = facing({0.5, 1.0, 0.3}, 130.0, 64);
  const auto turn = [](const glm::dvec3& p) { return glm::dvec3(p.z, p.x, p.y); };
  XrayGeometry h = g;
  h.source_lps_mm = turn(*g.source_lps_mm);
  h.detector_center_lps_mm = turn(g.detector_center_lps_mm);
  h.u = turn(g.u);
  h.v = turn(g.v);
  for (const ProjectionMethod method : {ProjectionMethod::exact, ProjectionMethod::slab}) {
    const Errors errors = errors_of(XrayCpu(turned).project(h, method), XrayCpu(volume).project(g, method));
    EXPECT_GT(errors.compared, 250U);
    EXPECT_LE(errors.max_relative, 1e-5);
  }
}

// A field that is linear in space: the trilinear integral is its value at the chord's middle times the chord, as
// long as the ray stays between the outermost centres.
TEST(Projection, TrilinearIntegratesALinearFieldExactly) {
  volume::Volume volume = centered({30, 30, 30}, {1.0, 1.2, 1.5}, 0);
  for (int k = 0; k < 30; ++k)
    for (int j = 0; j < 30; ++j)
      for (int i = 0; i < 30; ++i)
        volume.hu[volume.index(i, j, k)] = static_cast<std::int16_t>(-900 + 5 * i + 7 * j + 11 * k);
  for (std::uint64_t i = 0; i < 500; ++i) {
    const glm::dvec3 from = somewhere(2 * i, 14.0), to = somewhere(2 * i + 1, 14.0);
    const glm::dvec3 middle = glm::dvec3(volume::voxel_from_lps(volume) * glm::dvec4(0.5 * (from + to), 1.0));
    const double expected =
        glm::length(to - from) * (0.1 + (5.0 * middle.x + 7.0 * middle.y + 11.0 * middle.z) / 1000.0);
    ASSERT_NEAR(lengths_between(volume, from, to, ProjectionMethod::trilinear).total_mm(), expected, 1e-10);
  }
}

// Where neighbours differ little the methods agree; the smoother the field the better.
TEST(Projection, InterpolatingMethodsAgreeOnASmoothField) {
  volume::Volume volume = centered({60, 60, 30}, {1.0, 1.0, 2.0}, 0);
  for (int k = 0; k < 30; ++k)
    for (int j = 0; j < 60; ++j)
      for (int i = 0; i < 60; ++i)
        volume.hu[volume.index(i, j, k)] =
            static_cast<std::int16_t>(200.0 * std::sin(0.1 * i) * std::cos(0.13 * j) + 5.0 * k);
  const XrayGeometry g = facing({0.3, 1.0, 0.2}, 40.0, 32);
  const PathLengths trilinear = xray_reference(volume, g, ProjectionMethod::trilinear);
  EXPECT_LE(errors_of(XrayCpu(volume).project(g, ProjectionMethod::slab), trilinear).max_relative, 1e-3);
  EXPECT_LE(errors_of(XrayCpu(volume).project(g, ProjectionMethod::exact), trilinear).max_relative, 5e-3);
  EXPECT_LE(errors_of(XrayCpu(volume).project(g, ProjectionMethod::trilinear), trilinear).max_relative, 1e-6);
}

// The picture of a sphere and of a cylinder in voxels errs in proportion to the voxel.
TEST(Projection, SphereAndCylinderConverge) {
  const volume::Sphere sphere{{3.0, -2.0, 1.0}, 30.0};
  const volume::Cylinder cylinder{{0.0, 0.0, -60.0}, {0.0, 0.0, 60.0}, 25.0};
  for (const bool round : {true, false}) {
    double coarsest = 0.0, finest = 0.0;
    for (const double spacing_mm : {4.0, 2.0, 1.0, 0.5}) {
      volume::AnalyticVolume analytic;
      const int n = static_cast<int>(80.0 / spacing_mm);
      analytic.size_voxels = {n, n, n};
      analytic.spacing_mm = glm::dvec3(spacing_mm);
      analytic.origin_mm = glm::dvec3(-0.5 * spacing_mm * (n - 1));
      if (round)
        analytic.shapes.push_back({sphere, 0.0});
      else
        analytic.shapes.push_back({cylinder, 0.0});
      const volume::Volume volume = volume::rasterize(analytic);
      // The cylinder runs through the volume's ends: seen across, its chord is that of an endless one.
      const XrayGeometry g = parallel({0.6, 0.8, 0.0}, 40.0, 48);
      const PathLengths lengths = XrayCpu(volume).project(g, ProjectionMethod::exact);
      double sum = 0.0;
      for (int row = 0; row < 48; ++row)
        for (int column = 0; column < 48; ++column) {
          const RaySegment ray = ray_of(g, volume, column, row);
          const glm::dvec3 to_center = (round ? sphere.center_mm : glm::dvec3(0.0)) - ray.from_lps_mm;
          const glm::dvec3 miss = to_center - g.direction * glm::dot(to_center, g.direction);
          const double miss_2 = round ? glm::dot(miss, miss) : miss.x * miss.x + miss.y * miss.y;
          const double radius = round ? sphere.radius_mm : cylinder.radius_mm;
          const double chord_mm = 2.0 * std::sqrt(std::max(0.0, radius * radius - miss_2));
          const double error = total_mm(lengths, static_cast<std::size_t>(row * 48 + column)) - chord_mm;
          sum += error * error;
        }
      const double rms_mm = std::sqrt(sum / (48.0 * 48.0));
      EXPECT_LT(rms_mm, spacing_mm);
      if (coarsest == 0.0) coarsest = rms_mm;
      finest = rms_mm;
    }
    EXPECT_LT(finest, 0.18 * coarsest) << coarsest;  // an eighth of the size; measured 0.12 and 0.13
  }
}

TEST(Projection, NothingToSeeIsZero) {
  const volume::Volume air = centered({8, 8, 8}, {1, 1, 1}, -1000);
  const PathLengths lengths = XrayCpu(air).project(facing({1, 0, 0}, 20.0, 8), ProjectionMethod::exact);
  EXPECT_EQ(lengths.water_mm, std::vector<float>(64, 0.0F));
  EXPECT_EQ(lengths.mineral_mm, std::vector<float>(64, 0.0F));
}

TEST(Projection, AFiducialIsSeenWhereItIs) {
  volume::Volume volume = centered({61, 61, 61}, {1, 1, 1}, -1000);
  const glm::ivec3 voxel(40, 22, 45);
  volume.hu[volume.index(voxel.x, voxel.y, voxel.z)] = 2000;
  const glm::dvec3 p(volume.lps_from_voxel * glm::dvec4(voxel, 1.0));
  const XrayGeometry g = facing({0.3, 1.0, -0.4}, 120.0, 240);
  const auto pixel = pixel_of(g, p);
  ASSERT_TRUE(pixel.has_value());
  const PathLengths lengths = XrayCpu(volume).project(g, ProjectionMethod::exact);
  double sum = 0.0;
  glm::dvec2 middle(0.0);
  for (int row = 0; row < 240; ++row)
    for (int column = 0; column < 240; ++column) {
      const double value = total_mm(lengths, static_cast<std::size_t>(row * 240 + column));
      sum += value;
      middle += value * glm::dvec2(column, row);
    }
  ASSERT_GT(sum, 0.0);
  EXPECT_NEAR(middle.x / sum, pixel->x, 0.1);
  EXPECT_NEAR(middle.y / sum, pixel->y, 0.1);
}

TEST(Projection, DegenerateGeometryIsRefused) {
  const XrayGeometry good = facing({0, 1, 0}, 100.0, 16);
  ASSERT_TRUE(check_geometry(good).has_value());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<XrayGeometry> bad(9, good);
  bad[0].pixel_mm = 0.0;
  bad[1].pixel_mm = nan;
  bad[2].width_px = 0;
  bad[3].source_lps_mm = glm::dvec3(nan, 0.0, 0.0);
  bad[4].source_lps_mm = good.detector_center_lps_mm + 30.0 * good.u;
  bad[5].u = good.v;
  bad[6].detector_center_lps_mm.y = std::numeric_limits<double>::infinity();
  bad[7].source_lps_mm.reset();
  bad[7].direction = good.u;
  bad[8].width_px = bad[8].height_px = 1 << 20;
  for (std::size_t i = 0; i < bad.size(); ++i) {
    const auto checked = check_geometry(bad[i]);
    ASSERT_FALSE(checked.has_value()) << i;
    EXPECT_EQ(checked.error().code, "bad_geometry");
  }
}

}  // namespace
}  // namespace seldinger::imaging
