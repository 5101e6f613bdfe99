// The real CT volumes: the landmarks their READMEs measure, the six lossless syntaxes, voxels against an own
// decoding, and a skin that is closed and can be punctured.
#include <zlib.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "casedb/import/skin/surface.h"
#include "sim/case/form/mesh_index.h"
#include "sim/volume/body/body_mask.h"
#include "tests/casedb/import/import_case.h"
#include "tests/fixtures/shared_data.h"

namespace seldinger::casedb {
namespace {

class RealCt : public ImportCase {};

struct Landmark {
  glm::dvec3 p_lps_mm;
  double hu;
};

// 7 × 7 voxels in plane around the nearest one.
double mean_hu(const volume::Volume& v, const glm::dvec3& p_lps_mm) {
  const glm::dvec3 index(volume::voxel_from_lps(v) * glm::dvec4(p_lps_mm, 1.0));
  const glm::ivec3 nearest(glm::round(index));
  double sum = 0.0;
  for (int j = -3; j <= 3; ++j)
    for (int i = -3; i <= 3; ++i) sum += v.at(nearest.x + i, nearest.y + j, nearest.z);
  return sum / 49.0;
}

const Landmark kContrast[] = {{{-107, 51, -153}, 164}, {{52, 66, -153}, 155},  {{-14, 25, -153}, 145},
                              {{-42, 16, -153}, 127},  {{-115, -5, -98}, 103}, {{89, 55, -98}, 125},
                              {{-167, 21, -153}, -79}};
const Landmark kPelvis[] = {{{-89, 58, -583}, 24}, {{63, 77, -583}, 33},    {{-104, 33, -506}, 64},
                            {{-4, 27, -583}, 43},  {{-40, 106, -583}, 48},  {{-16, 48, -583}, 199},
                            {{-11, 28, -838}, -2}, {{-16, -79, -583}, -106}};

TEST_F(RealCt, LandmarksOfTheDicomSeries) {
  SELDINGER_NEEDS_SHARED_DATA();
  const auto source = read(shared_data("ct-abdomen-contrast-dicom"));
  ASSERT_TRUE(source);
  EXPECT_EQ(source->volume.size_voxels, glm::ivec3(512, 512, 35));
  EXPECT_EQ(source->slices_used, 35);
  EXPECT_NEAR(source->volume.spacing_mm.x, 0.859375, 1e-9);
  EXPECT_NEAR(source->volume.spacing_mm.z, 5.0, 1e-3);
  for (const Landmark& landmark : kContrast)
    EXPECT_NEAR(mean_hu(source->volume, landmark.p_lps_mm), landmark.hu, 1.0) << landmark.p_lps_mm.x;
}

TEST_F(RealCt, LandmarksOfTheDicomSeriesStayWhenASliceIsLostAndOthersAreDoubled) {
  SELDINGER_NEEDS_SHARED_DATA();
  for (const auto& entry : std::filesystem::directory_iterator(shared_data("ct-abdomen-contrast-dicom"))) {
    const std::string name = entry.path().filename();
    if (name == "1-24.dcm") continue;  // 10 mm or more beside every landmark
    std::filesystem::copy(entry.path(), folder_ / name);
    if (name.starts_with("1-1")) std::filesystem::copy(entry.path(), folder_ / ("copy" + name));
  }
  const auto source = read(folder_);
  ASSERT_TRUE(source) << source.error().text;
  EXPECT_EQ(source->volume.size_voxels, glm::ivec3(512, 512, 35));
  EXPECT_EQ(source->slices_used, 34);
  EXPECT_TRUE(has_code(source->warnings, "uneven_slices"));
  EXPECT_TRUE(has_code(source->warnings, "duplicate_slices"));
  for (const Landmark& landmark : kContrast)
    EXPECT_NEAR(mean_hu(source->volume, landmark.p_lps_mm), landmark.hu, 1.0) << landmark.p_lps_mm.x;
  // The lost slice is halfway between its neighbours: the water of the body stays where it was.
  const auto whole = read(shared_data("ct-abdomen-contrast-dicom"));
  ASSERT_TRUE(whole);
  EXPECT_LT(largest_difference(source->volume.lps_from_voxel, whole->volume.lps_from_voxel), 1e-4);
  std::size_t layers = 0;
  const std::size_t slice = 512 * 512;
  for (std::size_t k = 0; k < 35; ++k)
    layers += std::equal(whole->volume.hu.begin() + static_cast<std::ptrdiff_t>(k * slice),
                         whole->volume.hu.begin() + static_cast<std::ptrdiff_t>((k + 1) * slice),
                         source->volume.hu.begin() + static_cast<std::ptrdiff_t>(k * slice));
  EXPECT_EQ(layers, 34U);  // all but the lost one are as they were
}

TEST_F(RealCt, LandmarksOfTheNifti) {
  SELDINGER_NEEDS_SHARED_DATA();
  const auto source = read(shared_data("ct-abdomen-pelvis/abdomen_pelvis.nii.gz"));
  ASSERT_TRUE(source);
  EXPECT_EQ(source->volume.size_voxels, glm::ivec3(512, 390, 99));
  for (const Landmark& landmark : kPelvis)
    EXPECT_NEAR(mean_hu(source->volume, landmark.p_lps_mm), landmark.hu, 1.0) << landmark.p_lps_mm.x;
}

TEST_F(RealCt, TheMetaImageIsTheNiftiAveraged) {
  SELDINGER_NEEDS_SHARED_DATA();
  const auto full = read(shared_data("ct-abdomen-pelvis/abdomen_pelvis.nii.gz")),
             half = read(shared_data("ct-abdomen-pelvis/abdomen_pelvis_2x.mha"));
  ASSERT_TRUE(full && half);
  const volume::Volume &a = full->volume, &b = half->volume;
  ASSERT_EQ(b.size_voxels, glm::ivec3(256, 195, 99));
  // Centres of 2 × 2 blocks lie half a voxel beyond the first centre.
  const glm::dvec3 first(a.lps_from_voxel * glm::dvec4(0.5, 0.5, 0.0, 1.0));
  EXPECT_LT(glm::length(first - glm::dvec3(b.lps_from_voxel[3])), 1e-3);
  double worst = 0.0;
  std::size_t compared = 0;
  for (int k = 0; k < 99; ++k)
    for (int j = 0; j < 195; ++j)
      for (int i = 0; i < 256; ++i) {
        const int sum = a.at(2 * i, 2 * j, k) + a.at(2 * i + 1, 2 * j, k) + a.at(2 * i, 2 * j + 1, k) +
                        a.at(2 * i + 1, 2 * j + 1, k);
        if (b.at(i, j, k) == -1024) continue;  // there it was averaged with the padding of −3024
        worst = std::max(worst, std::abs(b.at(i, j, k) - 0.25 * sum));
        ++compared;
      }
  EXPECT_GT(compared, b.hu.size() / 2);
  EXPECT_LE(worst, 0.5);  // so every landmark of the one holds in the other
}

TEST_F(RealCt, NrrdVoxelsAreThoseOfTheFile) {
  SELDINGER_NEEDS_SHARED_DATA();
  const auto file = shared_data("ct-neck/neck.nrrd");
  const auto source = read(file);
  ASSERT_TRUE(source);
  std::string bytes = fixtures::whole_file(file);
  const std::size_t data = bytes.find("\n\n") + 2;
  std::vector<std::int16_t> voxels(410 * 290 * 28);
  z_stream stream{};
  ASSERT_EQ(inflateInit2(&stream, MAX_WBITS + 16), Z_OK);
  stream.next_in = reinterpret_cast<Bytef*>(bytes.data() + data);
  stream.avail_in = static_cast<uInt>(bytes.size() - data);
  stream.next_out = reinterpret_cast<Bytef*>(voxels.data());
  stream.avail_out = static_cast<uInt>(voxels.size() * 2);
  ASSERT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  inflateEnd(&stream);
  for (std::int16_t& hu : voxels) hu = std::max<std::int16_t>(hu, -1024);
  EXPECT_EQ(source->volume.hu, voxels);
  const glm::dmat4 expected({0.976562, 0, 0, 0}, {0, 0.976562, 0, 0}, {0, 0, 4.25, 0},
                            {-201.1719, -123.04694, -319.75, 1});
  EXPECT_LT(largest_difference(source->volume.lps_from_voxel, expected), 1e-9);
}

TEST_F(RealCt, TheThoraxInletIsReadAsItsHeaderSays) {
  SELDINGER_NEEDS_SHARED_DATA();
  const auto source = read(shared_data("ct-thorax-inlet/thorax_inlet_1mm.mha"));
  ASSERT_TRUE(source);
  const glm::dmat4 expected({0.759765625, 0, 0, 0}, {0, 0.759765625, 0, 0}, {0, 0, 1, 0},
                            {-166.3271484, -318.5341797, 50.5, 1});
  EXPECT_LT(largest_difference(source->volume.lps_from_voxel, expected), 1e-9);
  const auto [low, high] = std::minmax_element(source->volume.hu.begin(), source->volume.hu.end());
  EXPECT_EQ(*low, -1024);
  EXPECT_EQ(*high, 1556);
}

TEST_F(RealCt, SixLosslessSyntaxesAreOneSlice) {
  SELDINGER_NEEDS_SHARED_DATA();
  const auto sample = [&](const std::string& name) { return read(shared_data("dicom-samples/" + name + ".dcm")); };
  const auto plain = sample("chest_explicit_le");
  ASSERT_TRUE(plain);
  const auto [low, high] = std::minmax_element(plain->volume.hu.begin(), plain->volume.hu.end());
  EXPECT_EQ(*low, -1024);  // −3024 in the file
  EXPECT_EQ(*high, 1378);
  for (const char* name :
       {"chest_deflated", "chest_j2k_lossless", "chest_jpegls_lossless", "chest_jpeg_lossless_sv1", "chest_rle"}) {
    const auto other = sample(name);
    ASSERT_TRUE(other) << name;
    EXPECT_EQ(other->volume.hu, plain->volume.hu) << name;
    EXPECT_EQ(largest_difference(other->volume.lps_from_voxel, plain->volume.lps_from_voxel), 0.0) << name;
    EXPECT_FALSE(has_code(other->warnings, "lossy")) << name;
  }
  const auto lossy = sample("chest_jpeg12_lossy");
  ASSERT_TRUE(lossy);
  EXPECT_TRUE(has_code(lossy->warnings, "lossy"));
  EXPECT_NE(lossy->volume.hu, plain->volume.hu);
  double sum = 0.0;
  for (std::size_t i = 0; i < plain->volume.hu.size(); ++i)
    sum += std::abs(lossy->volume.hu[i] - plain->volume.hu[i]);
  EXPECT_LT(sum / static_cast<double>(plain->volume.hu.size()), 20.0);
}

TEST_F(RealCt, SeveralSeriesInOneFolderAreRefused) {
  SELDINGER_NEEDS_SHARED_DATA();
  EXPECT_EQ(refusal(shared_data("dicom-samples")), "several_series");
}

struct Distances {
  double mean_mm = 0.0, largest_mm = 0.0;
};

Distances distances(const cases::Mesh& from, const cases::Mesh& to) {
  const cases::MeshIndex index(to);
  Distances result;
  std::uint32_t hint = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < from.vertices_lps_mm.size(); i += 4) {
    const glm::vec3& p = from.vertices_lps_mm[i];
    const cases::Closest closest = index.closest(glm::dvec3(p), hint);
    hint = closest.triangle;
    const double d = std::abs(closest.distance_mm);
    result.mean_mm += d;
    ++count;
    result.largest_mm = std::max(result.largest_mm, d);
  }
  result.mean_mm /= static_cast<double>(count);
  return result;
}

int skin_crossings(const cases::MeshIndex& index, glm::dvec3 p, const glm::dvec3& direction, double length_mm) {
  int crossings = 0;
  while (const auto hit = index.first_hit(p, direction, length_mm)) {
    ++crossings;
    p += direction * (hit->distance_mm + 1e-3);
    length_mm -= hit->distance_mm + 1e-3;
  }
  return crossings;
}

TEST_F(RealCt, TheSkinOfTheAbdomenIsCrossedOnceFromBehind) {
  SELDINGER_NEEDS_SHARED_DATA();
  const auto source = read(shared_data("ct-abdomen-pelvis/abdomen_pelvis.nii.gz"));
  ASSERT_TRUE(source);
  const auto skin = skin_surface(source->volume);
  ASSERT_TRUE(skin);
  EXPECT_GT(skin->triangles.size(), 20000U);
  EXPECT_LT(skin->triangles.size(), 120000U);
  const cases::MeshIndex index(*skin);
  // A straight posterior path to the left kidney's lower pole is one puncture, couch or not.
  const glm::dvec3 target(63, 77, -620), start(63, 227, -620);
  EXPECT_LT(index.closest(target).distance_mm, 0.0);
  EXPECT_GT(index.closest(start).distance_mm, 0.0);
  EXPECT_EQ(skin_crossings(index, start, {0, -1, 0}, 150.0), 1);
  // And so through bowel gas from the front, and right through the lungs' bases.
  EXPECT_EQ(skin_crossings(index, {63, -200, -620}, {0, 1, 0}, 600.0), 2);
  EXPECT_EQ(skin_crossings(index, {-80, -200, -440}, {0, 1, 0}, 600.0), 2);

  const auto full = skin_surface(source->volume, {.decimate_share = 0.0});
  ASSERT_TRUE(full);
  const Distances there = distances(*skin, *full), back = distances(*full, *skin);
  RecordProperty("triangles", std::to_string(skin->triangles.size()));
  std::printf(
      "[ decimation ] %zu of %zu triangles; mm from decimated to full: mean %.4f max %.3f, back: mean %.4f max "
      "%.3f\n",
      skin->triangles.size(), full->triangles.size(), there.mean_mm, there.largest_mm, back.mean_mm,
      back.largest_mm);
  EXPECT_LT(there.mean_mm, 0.1);
  EXPECT_LT(back.mean_mm, 0.2);
  EXPECT_LT(back.largest_mm, 3.0);
}

TEST_F(RealCt, TheMattressCoverThatTouchesTheBackIsNoBody) {
  SELDINGER_NEEDS_SHARED_DATA();
  const auto source = read(shared_data("ct-abdomen-contrast-dicom"));
  ASSERT_TRUE(source);
  const auto skin = skin_surface(source->volume);
  ASSERT_TRUE(skin);
  const cases::MeshIndex index(*skin);
  const volume::Volume& v = source->volume;
  const auto mask = body_mask(v);
  // The cover's free edges, beside the back in every slice.
  for (int k = 0; k < 35; ++k)
    for (int j = 388; j < 512; ++j) {
      EXPECT_EQ(mask[v.index(42, j, k)], 0) << k << " " << j;
      EXPECT_EQ(mask[v.index(470, j, k)], 0) << k << " " << j;
    }
  EXPECT_EQ(skin_crossings(index, {-100, 300, -100}, {0, -1, 0}, 600.0), 2);
  EXPECT_EQ(skin_crossings(index, {52, 300, -153}, {0, -1, 0}, 600.0), 2);
}

TEST_F(RealCt, EverySkinIsClosedAndFacesOutwards) {
  SELDINGER_NEEDS_SHARED_DATA();
  for (const char* name :
       {"ct-neck/neck.nrrd", "ct-thorax-inlet/thorax_inlet_1mm.mha", "ct-abdomen-pelvis/abdomen_pelvis_2x.mha"}) {
    const auto source = read(shared_data(name));
    ASSERT_TRUE(source);
    const auto skin = skin_surface(source->volume);
    ASSERT_TRUE(skin) << name;
    double volume_mm3 = 0.0, area_mm2 = 0.0;
    glm::dvec3 sum_of_normals(0.0);
    for (const glm::uvec3& t : skin->triangles) {
      const glm::dvec3 a(skin->vertices_lps_mm[t.x]), b(skin->vertices_lps_mm[t.y]), c(skin->vertices_lps_mm[t.z]);
      volume_mm3 += glm::dot(a, glm::cross(b, c)) / 6.0;
      sum_of_normals += 0.5 * glm::cross(b - a, c - a);
      area_mm2 += 0.5 * glm::length(glm::cross(b - a, c - a));
    }
    EXPECT_GT(volume_mm3, 1e6) << name;
    EXPECT_LT(glm::length(sum_of_normals), 1e-6 * area_mm2) << name;  // 0 for every closed surface
    // The enclosed space is that of the mask's voxels.
    const auto mask = body_mask(source->volume);
    const glm::dvec3 mm = source->volume.spacing_mm;
    const double voxels_mm3 = static_cast<double>(std::count(mask.begin(), mask.end(), 1)) * mm.x * mm.y * mm.z;
    EXPECT_NEAR(volume_mm3 / voxels_mm3, 1.0, 0.02) << name;
  }
}

}  // namespace
}  // namespace seldinger::casedb
