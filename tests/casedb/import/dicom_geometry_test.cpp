// What lies unevenly, leans or is doubled is brought onto a regular grid, and spheres of known place are still
// there: within half a voxel. Beyond the limits of slice_stack.h it is refused.
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "tests/casedb/import/dicom_writer.h"
#include "tests/casedb/import/import_case.h"

namespace seldinger::casedb {
namespace {

constexpr double kDegree = 0.017453292519943295;

struct Sphere {
  glm::dvec3 center_mm;
  double radius_mm, hu;
};

class DicomGeometry : public ImportCase {
 protected:
  // Slices of 48 × 40 pixels of 0.8 × 0.9 mm that sample the spheres in air where their pixels lie.
  struct Scan {
    glm::dvec3 row{1, 0, 0}, column{0, 1, 0};
    std::vector<glm::dvec3> first_pixels_mm;
    std::vector<Sphere> spheres;
  };
  static constexpr glm::ivec2 kSize{48, 40};
  static constexpr glm::dvec2 kSpacing{0.8, 0.9};

  static double hu_at(const Scan& scan, const glm::dvec3& p) {
    double hu = -1000.0;
    for (const Sphere& sphere : scan.spheres) {  // a ramp of 1 mm, as a scanner's blur
      const double inside = sphere.radius_mm - glm::length(p - sphere.center_mm);
      hu += (sphere.hu + 1000.0) * std::clamp(inside + 0.5, 0.0, 1.0);
    }
    return hu;
  }

  static TestDicom slice(const Scan& scan, const glm::dvec3& first_pixel_mm) {
    std::vector<int> stored;
    for (int j = 0; j < kSize.y; ++j)
      for (int i = 0; i < kSize.x; ++i)
        stored.push_back(static_cast<int>(std::lround(
            hu_at(scan, first_pixel_mm + scan.row * (i * kSpacing.x) + scan.column * (j * kSpacing.y)))));
    return TestDicom::ct_slice(kSize)
        .lying(scan.row, scan.column)
        .at(first_pixel_mm)
        .text(0x00280030, "DS", "0.9\\0.8")
        .pixels(stored);
  }

  void write_scan(const Scan& scan) {
    for (std::size_t k = 0; k < scan.first_pixels_mm.size(); ++k)
      write(numbered("PLANTED", static_cast<int>(k)), slice(scan, scan.first_pixels_mm[k]).bytes());
  }

  // The places of equal slices one behind the other.
  static std::vector<glm::dvec3> along(const glm::dvec3& from, const glm::dvec3& step, int count) {
    std::vector<glm::dvec3> places;
    for (int k = 0; k < count; ++k) places.push_back(from + step * static_cast<double>(k));
    return places;
  }

  // The sphere's centre of mass in the volume, within 3 mm around it.
  static glm::dvec3 found_center(const volume::Volume& v, const Sphere& sphere) {
    glm::dvec3 sum(0.0);
    double mass = 0.0;
    for (int k = 0; k < v.size_voxels.z; ++k)
      for (int j = 0; j < v.size_voxels.y; ++j)
        for (int i = 0; i < v.size_voxels.x; ++i) {
          const glm::dvec3 p(v.lps_from_voxel * glm::dvec4(i, j, k, 1.0));
          if (glm::length(p - sphere.center_mm) > sphere.radius_mm + 3.0) continue;
          const double m = v.at(i, j, k) + 1000.0;
          sum += p * m;
          mass += m;
        }
    return sum / mass;
  }

  static void expect_in_place(const volume::Volume& v, const Scan& scan) {
    const double voxel_mm = std::min({v.spacing_mm.x, v.spacing_mm.y, v.spacing_mm.z});
    double worst_mm = 0.0;
    for (const Sphere& sphere : scan.spheres) {
      const double off_mm = glm::length(found_center(v, sphere) - sphere.center_mm);
      EXPECT_LT(off_mm, 0.5 * voxel_mm)
          << sphere.center_mm.x << ' ' << sphere.center_mm.y << ' ' << sphere.center_mm.z;
      worst_mm = std::max(worst_mm, off_mm);
    }
    // Its axes are perpendicular and right-handed: the library knows no others.
    const glm::dvec3 x = glm::normalize(glm::dvec3(v.lps_from_voxel[0])),
                     y = glm::normalize(glm::dvec3(v.lps_from_voxel[1])),
                     z = glm::normalize(glm::dvec3(v.lps_from_voxel[2]));
    EXPECT_GT(glm::dot(glm::cross(x, y), z), 1.0 - 1e-5);
    std::printf("[ spheres    ] %.3f mm off at most, voxels of %.2f mm\n", worst_mm, voxel_mm);
  }

  static std::string text_of(const std::vector<base::Problem>& problems, const std::string& code) {
    for (const base::Problem& problem : problems)
      if (problem.code == code) return problem.text;
    return "";
  }
};

const std::vector<Sphere> kSpheres = {{{12, 14, 20}, 6, 60}, {{26, 22, 34}, 5, 1000}, {{20, 12, 52}, 4, 300}};

TEST_F(DicomGeometry, ATiltedGantryIsShearedBack) {
  for (const double degrees : {-20.0, 0.2, 12.5, 30.0}) {
    // The table moves along z, the slices lean about x.
    Scan scan;
    scan.column = {0.0, std::cos(degrees * kDegree), -std::sin(degrees * kDegree)};
    scan.spheres = {{{16, 16, 12}, 6, 60}, {{24, 20, 26}, 5, 1000}, {{14, 18, 40}, 4, 300}};
    scan.first_pixels_mm = along({0, 0, degrees > 0 ? 6.0 : -6.0}, {0, 0, 1.5}, 34);
    write_scan(scan);
    const auto source = read(folder_);
    ASSERT_TRUE(source) << source.error().text;
    SCOPED_TRACE(degrees);
    EXPECT_EQ(source->slices_used, 34);
    EXPECT_EQ(source->volume.size_voxels.z, 34);
    EXPECT_NEAR(source->volume.spacing_mm.z, 1.5 * std::cos(degrees * kDegree), 1e-6);
    EXPECT_NE(text_of(source->warnings, "gantry_tilt").find("tilted by "), std::string::npos);
    expect_in_place(source->volume, scan);
    for (std::size_t k = 0; k < 34; ++k) {  // each slice is its layer, moved by whole and broken pixels
      const glm::dvec4 first(scan.first_pixels_mm[k], 1.0);
      const glm::dvec3 index(volume::voxel_from_lps(source->volume) * first);
      EXPECT_NEAR(index.z, static_cast<double>(k), 1e-6);
      EXPECT_GE(index.y, -1e-3);
      EXPECT_LE(index.y, source->volume.size_voxels.y - kSize.y + 1e-3);
    }
  }
}

TEST_F(DicomGeometry, ATiltedGantryIsAMatterOfADegree) {
  const auto tilted = [&](double degrees) {
    for (int k = 0; k < 6; ++k)
      write(numbered("s", k),
            TestDicom::ct_slice({4, 3}).at({0.0, 50.0 * k * std::tan(degrees * kDegree), 50.0 * k}).bytes());
    const auto source = read(folder_);
    if (!source) return source.error().code;
    return text_of(source->warnings, "gantry_tilt");
  };
  EXPECT_EQ(tilted(0.0), "");
  EXPECT_EQ(tilted(0.05), "");
  EXPECT_NE(tilted(0.2).find("tilted by 0.2 degrees"), std::string::npos);
  EXPECT_NE(tilted(-15.0).find("tilted by 15 degrees"), std::string::npos);
  EXPECT_EQ(tilted(31.0), "gantry_tilt");
}

TEST_F(DicomGeometry, MissingSlicesAreFilledAndSaid) {
  Scan scan;
  scan.spheres = kSpheres;
  scan.first_pixels_mm = along({0, 0, 8}, {0, 0, 1.5}, 36);
  for (const int missing : {30, 19, 18, 5}) scan.first_pixels_mm.erase(scan.first_pixels_mm.begin() + missing);
  write_scan(scan);
  const auto source = read(folder_);
  ASSERT_TRUE(source) << source.error().text;
  EXPECT_EQ(source->slices_used, 32);
  EXPECT_EQ(source->volume.size_voxels, glm::ivec3(48, 40, 36));
  EXPECT_NEAR(source->volume.spacing_mm.z, 1.5, 1e-9);
  EXPECT_NE(text_of(source->warnings, "uneven_slices").find("1.5 to 4.5 mm apart, usually 1.5 mm; 4 seem"),
            std::string::npos)
      << text_of(source->warnings, "uneven_slices");
  expect_in_place(source->volume, scan);
  // What was there is as it was.
  for (std::size_t k : {0U, 10U, 31U}) {
    const glm::dvec3 index(volume::voxel_from_lps(source->volume) * glm::dvec4(scan.first_pixels_mm[k], 1.0));
    for (int j = 0; j < kSize.y; ++j)
      for (int i = 0; i < kSize.x; ++i)
        ASSERT_EQ(source->volume.at(i, j, static_cast<int>(std::lround(index.z))),
                  std::lround(hu_at(scan, scan.first_pixels_mm[k] + glm::dvec3(i * 0.8, j * 0.9, 0.0))));
  }
}

TEST_F(DicomGeometry, ATiltedSeriesWithAGapIsBothAtOnce) {
  Scan scan;
  scan.column = {0.0, std::cos(15 * kDegree), -std::sin(15 * kDegree)};
  scan.spheres = {{{16, 16, 12}, 6, 60}, {{24, 20, 26}, 5, 1000}};
  scan.first_pixels_mm = along({0, 0, 6}, {0, 0, 1.5}, 26);
  scan.first_pixels_mm.erase(scan.first_pixels_mm.begin() + 12);
  write_scan(scan);
  const auto source = read(folder_);
  ASSERT_TRUE(source) << source.error().text;
  EXPECT_TRUE(has_code(source->warnings, "gantry_tilt"));
  EXPECT_TRUE(has_code(source->warnings, "uneven_slices"));
  expect_in_place(source->volume, scan);
}

TEST_F(DicomGeometry, VaryingSpacingBecomesTheUsualOne) {
  Scan scan;
  scan.spheres = kSpheres;
  scan.first_pixels_mm = along({0, 0, 8}, {0, 0, 1.25}, 24);
  for (const glm::dvec3& place : along({0, 0, 8 + 23 * 1.25 + 2.5}, {0, 0, 2.5}, 9))
    scan.first_pixels_mm.push_back(place);
  write_scan(scan);
  const auto source = read(folder_);
  ASSERT_TRUE(source) << source.error().text;
  EXPECT_NEAR(source->volume.spacing_mm.z, 1.25, 1e-9);
  EXPECT_EQ(source->volume.size_voxels.z, 24 + 18);
  EXPECT_TRUE(has_code(source->warnings, "uneven_slices"));
  expect_in_place(source->volume, scan);
}

TEST_F(DicomGeometry, PlacesThatJitterAreBelieved) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> jitter(-0.25, 0.25);
  Scan scan;
  scan.spheres = kSpheres;
  scan.first_pixels_mm = along({0, 0, 8}, {0, 0, 1.5}, 36);
  for (glm::dvec3& place : scan.first_pixels_mm)
    place += glm::dvec3(jitter(random), jitter(random), jitter(random));
  write_scan(scan);
  const auto source = read(folder_);
  ASSERT_TRUE(source) << source.error().text;
  EXPECT_TRUE(has_code(source->warnings, "uneven_slices"));
  EXPECT_TRUE(has_code(source->warnings, "shifted_slices"));
  EXPECT_FALSE(has_code(source->warnings, "gantry_tilt")) << text_of(source->warnings, "gantry_tilt");
  expect_in_place(source->volume, scan);
}

TEST_F(DicomGeometry, AnObliqueSeriesWithAGapKeepsItsPlaces) {
  Scan scan;
  scan.row = glm::normalize(glm::dvec3(0.9, 0.3, -0.1));
  scan.column = glm::normalize(glm::cross(glm::normalize(glm::dvec3(-0.1, 0.2, 0.95)), scan.row));
  const glm::dvec3 normal = glm::cross(scan.row, scan.column);
  const auto inside = [&](double x, double y, double z) { return x * scan.row + y * scan.column + z * normal; };
  scan.spheres = {{inside(12, 14, 12), 6, 60}, {inside(26, 22, 26), 5, 1000}};
  scan.first_pixels_mm = along({0, 0, 0}, 1.5 * normal, 25);
  scan.first_pixels_mm.erase(scan.first_pixels_mm.begin() + 17);
  write_scan(scan);
  const auto source = read(folder_);
  ASSERT_TRUE(source) << source.error().text;
  EXPECT_TRUE(has_code(source->warnings, "uneven_slices"));
  EXPECT_FALSE(has_code(source->warnings, "gantry_tilt"));
  expect_in_place(source->volume, scan);
}

TEST_F(DicomGeometry, TooLittleIsRefused) {
  const auto stack = [&](const std::vector<double>& heights_mm) {
    std::filesystem::remove_all(folder_);
    for (std::size_t k = 0; k < heights_mm.size(); ++k)
      write(numbered("s", static_cast<int>(k)), TestDicom::ct_slice({4, 3}).at({0, 0, heights_mm[k]}).bytes());
    return refusal(folder_);
  };
  EXPECT_EQ(stack({0, 5, 10, 20, 25, 30}), "");                    // a hole of 10 mm
  EXPECT_EQ(stack({0, 5, 10, 25, 30, 35}), "uneven_slices");       // of 15 mm
  EXPECT_EQ(stack({0, 12, 24, 36, 50, 62}), "");                   // wide, and none is missing
  EXPECT_EQ(stack({0, 12, 24, 48, 60}), "uneven_slices");          // wide, and one is
  EXPECT_EQ(stack({0, 1, 2, 3, 4, 13, 22, 31}), "uneven_slices");  // 32 layers of 8 slices
  EXPECT_EQ(stack({0, 1, 2, 3, 9, 10, 11, 12}), "");
}

TEST_F(DicomGeometry, AVolumeMuchLargerThanItsSlicesIsRefused) {
  // 1500 slices of 16 × 512 pixels that lean by 29 degrees: 24 MB of them would become 370 MB.
  const TestDicom slice = TestDicom::ct_slice({512, 16}).text(0x00280030, "DS", "0.5\\0.5");
  for (int k = 0; k < 1500; ++k)
    write(numbered("s", k), TestDicom(slice).at({0, k * std::tan(29 * kDegree), 1.0 * k}).bytes());
  EXPECT_EQ(refusal(folder_), "bad_size");
}

TEST_F(DicomGeometry, AGapIsNamedByTheSliceBehindIt) {
  for (const int k : {0, 1, 2, 3, 7, 8})
    write(numbered("s", k), TestDicom::ct_slice({4, 3}).at({0, 0, 4.0 * k}).bytes());
  const auto result = read(folder_);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, "uneven_slices");
  EXPECT_NE(result.error().text.find("3 seem to be missing, the widest gap before slice 5 of 6"), std::string::npos)
      << result.error().text;
  EXPECT_TRUE(result.error().findings.empty());
}

TEST_F(DicomGeometry, ASliceShiftedAlongItsPlaneIsMovedBackOrRefused) {
  const auto shifted = [&](double mm) {
    for (int k = 0; k < 7; ++k)
      write(numbered("s", k), TestDicom::ct_slice({4, 3}).at({k == 3 ? mm : 0.0, 0, 2.0 * k}).bytes());
    const auto source = read(folder_);
    if (!source) return source.error().code + ": " + source.error().text;
    return source->warnings.empty() ? "" : source->warnings.front().code;
  };
  EXPECT_EQ(shifted(0.0), "no_air");  // 0 to 11 HU, and nothing else
  EXPECT_EQ(shifted(0.8), "shifted_slices");
  EXPECT_EQ(shifted(1.5).substr(0, 22), "shifted_slices: slice ");
}

TEST_F(DicomGeometry, DoubledSlicesWithTheSamePixelsAreDropped) {
  for (int k = 0; k < 5; ++k) {
    const TestDicom file = TestDicom::ct_slice({4, 3}, 100 * k).at({0, 0, 2.0 * k});
    write(numbered("s", k), file.bytes());
    if (k != 2) write(numbered("copies/s", k), file.bytes(TestSyntax::explicit_be));
  }
  const auto source = read(folder_);
  ASSERT_TRUE(source) << source.error().text;
  EXPECT_EQ(source->slices_used, 5);
  EXPECT_EQ(source->volume.size_voxels.z, 5);
  EXPECT_EQ(source->volume.at(0, 0, 4), 400);
  EXPECT_NE(text_of(source->warnings, "duplicate_slices").find("4 of 9 slices"), std::string::npos);
}

TEST_F(DicomGeometry, DoubledSlicesWithOtherPixelsAreRefused) {
  for (int k = 0; k < 5; ++k) write(numbered("s", k), TestDicom::ct_slice({4, 3}).at({0, 0, 2.0 * k}).bytes());
  write("other", TestDicom::ct_slice({4, 3}, 7).at({0, 0, 4.0}).bytes());
  auto result = read(folder_);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, "duplicate_slices");
  EXPECT_NE(result.error().text.find("up to 7 HU"), std::string::npos) << result.error().text;
  // The same pixels beside one another are no copy either.
  write("other", TestDicom::ct_slice({4, 3}).at({5, 0, 4.0}).bytes());
  EXPECT_EQ(refusal(folder_), "duplicate_slices");
}

TEST_F(DicomGeometry, PicturesAcrossTheSeriesAreLeftOut) {
  for (int k = 0; k < 9; ++k) write(numbered("s", k), TestDicom::ct_slice({4, 3}, k).at({0, 0, 2.0 * k}).bytes());
  for (int k = 0; k < 2; ++k)  // coronal, of another size
    write(numbered("across", k),
          TestDicom::ct_slice({5, 7}).lying({1, 0, 0}, {0, 0, -1}).at({0, 3.0 * k, 9}).bytes());
  auto source = read(folder_);
  ASSERT_TRUE(source) << source.error().text;
  EXPECT_EQ(source->slices_used, 9);
  EXPECT_NE(text_of(source->warnings, "mixed_orientation").find("2 of 11"), std::string::npos);
  for (int k = 2; k < 4; ++k)
    write(numbered("across", k),
          TestDicom::ct_slice({5, 7}).lying({1, 0, 0}, {0, 0, -1}).at({0, 3.0 * k, 9}).bytes());
  EXPECT_EQ(refusal(folder_), "mixed_orientation");  // 4 of 13: who is the series?
  for (int k = 0; k < 4; ++k) std::filesystem::remove(folder_ / numbered("across", k));
  ASSERT_EQ(refusal(folder_), "");
  write("leaning",
        TestDicom::ct_slice({4, 3}).lying({1, 0, 0}, {0, std::cos(0.3), std::sin(0.3)}).at({0, 0, 9}).bytes());
  EXPECT_EQ(refusal(folder_), "mixed_orientation");
  write("leaning",
        TestDicom::ct_slice({4, 3}).lying({0, 1, 0}, {-1, 0, 0}).at({0, 0, 9}).bytes());  // turned in plane
  EXPECT_EQ(refusal(folder_), "mixed_orientation");
}

TEST_F(DicomGeometry, ThinSlicesFarApartAreSaid) {
  for (int k = 0; k < 4; ++k)
    write(numbered("s", k),
          TestDicom::ct_slice({4, 3}).at({0, 0, 10.0 * k}).text(0x00180050, "DS", "1.25").bytes());
  const auto source = read(folder_);
  ASSERT_TRUE(source);
  EXPECT_NE(text_of(source->warnings, "sparse_slices").find("1.25 mm thick and 10 mm apart"), std::string::npos);
}

}  // namespace
}  // namespace seldinger::casedb
