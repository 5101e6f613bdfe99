// NIfTI, NRRD and MetaImage files written by hand are read with the geometry and values put in: oblique,
// left-handed, RAS or LPS, of any scalar type, packed or not.
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <iomanip>
#include <sstream>

#include "tests/casedb/import/import_case.h"

namespace seldinger::casedb {
namespace {

class FileGeometry : public ImportCase {};

const std::vector<std::int16_t> kVoxels = [] {
  std::vector<std::int16_t> values;
  for (int i = 0; i < 4 * 3 * 2; ++i) values.push_back(static_cast<std::int16_t>(i * 10 - 100));
  return values;
}();

// Columns of a rotation (right-handed) about an axis that is none of the volume's, by 0.5 rad (Rodrigues).
glm::dmat3 rotation() {
  const glm::dvec3 axis = glm::normalize(glm::dvec3(1.0, 2.0, 3.0));
  const double c = std::cos(0.5), s = std::sin(0.5);
  glm::dmat3 turned;
  for (int i = 0; i < 3; ++i) {
    glm::dvec3 unit(0.0);
    unit[i] = 1.0;
    turned[i] = unit * c + glm::cross(axis, unit) * s + axis * glm::dot(axis, unit) * (1.0 - c);
  }
  return turned;
}

glm::dmat4 placed(const glm::dmat3& direction) {
  return {glm::dvec4(0.5 * direction[0], 0), glm::dvec4(0.75 * direction[1], 0), glm::dvec4(2.0 * direction[2], 0),
          glm::dvec4(-11.0, 22.0, -33.0, 1)};
}

std::vector<std::pair<const char*, glm::dmat3>> directions() {
  const glm::dmat3 turned = rotation();
  return {{"straight", glm::dmat3(1.0)},
          {"oblique", turned},
          {"left-handed", glm::dmat3(turned[0], turned[1], -turned[2])},
          {"flipped", glm::dmat3({-1, 0, 0}, {0, 1, 0}, {0, 0, 1})},
          {"permuted", glm::dmat3({0, 1, 0}, {0, 0, 1}, {1, 0, 0})}};
}

glm::dmat4 ras_from(glm::dmat4 lps) {
  for (int column = 0; column < 4; ++column) {
    lps[column].x = -lps[column].x;
    lps[column].y = -lps[column].y;
  }
  return lps;
}

std::string text_of(const glm::dvec3& v, const char* between) {
  std::ostringstream text;
  text << std::setprecision(17) << v.x << between << v.y << between << v.z;
  return text.str();
}

std::string nrrd_header(const glm::dmat4& space_from_voxel, const std::string& space, const std::string& encoding,
                        const std::string& more = "") {
  const auto vector = [&](int column) {
    return std::string("(").append(text_of(glm::dvec3(space_from_voxel[column]), ",")).append(")");
  };
  return "NRRD0004\n# PLANTED\ntype: short\ndimension: 3\nspace: " + space +
         "\nsizes: 4 3 2\nspace directions: " + vector(0) + " " + vector(1) + " " + vector(2) +
         "\nendian: little\nencoding: " + encoding + "\nspace origin: " + vector(3) + "\ncontent: PLANTED\n" +
         more + "\n";
}

std::string meta_header(const glm::dmat3& direction, const std::string& data_file, const std::string& more = "") {
  return "ObjectType = Image\nNDims = 3\nComment = PLANTED\nBinaryData = True\nBinaryDataByteOrderMSB = False\n" +
         more + "TransformMatrix = " + text_of(direction[0], " ") + " " + text_of(direction[1], " ") + " " +
         text_of(direction[2], " ") +
         "\nOffset = -11 22 -33\nElementSpacing = 0.5 0.75 2\nDimSize = 4 3 2\nElementType = MET_SHORT\n"
         "ElementDataFile = " +
         data_file + "\n";
}

void expect_volume(const base::Result<Source>& source, const glm::dmat4& lps_from_voxel, double tolerance,
                   const std::string& what) {
  ASSERT_TRUE(source) << what << " " << source.error().code;
  EXPECT_LT(largest_difference(source->volume.lps_from_voxel, lps_from_voxel), tolerance) << what;
  EXPECT_EQ(source->volume.size_voxels, glm::ivec3(4, 3, 2)) << what;
  EXPECT_EQ(source->volume.hu, kVoxels) << what;
  EXPECT_EQ(source->slices_used, 2) << what;
  EXPECT_TRUE(source->attributes.empty()) << what;
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(source->volume.spacing_mm[axis], glm::length(glm::dvec3(lps_from_voxel[axis])), 1e-6) << what;
}

TEST_F(FileGeometry, NiftiAxesTurnFromRasToLps) {
  for (const auto& [name, direction] : directions()) {
    const glm::dmat4 lps = placed(direction);
    const Nifti nifti({4, 3, 2}, ras_from(lps));
    // The header holds floats, and ITK turns the matrix into a quaternion and back.
    expect_volume(read(write("PLANTED.nii", nifti.bytes(little_endian(kVoxels)))), lps, 2e-5, name);
    expect_volume(read(write("PLANTED.nii.gz", gzip(nifti.bytes(little_endian(kVoxels))))), lps, 2e-5, name);
  }
}

TEST_F(FileGeometry, NiftiQformIsReadAsItsFormulaSays) {
  // nifti1.h, method 2: rotation from the quaternion (a, b, c, d), third column times qfac = pixdim[0].
  for (const float qfac : {1.0F, -1.0F}) {
    const double b = 0.1, c = -0.2, d = 0.3, a = std::sqrt(1.0 - b * b - c * c - d * d);
    const glm::dvec3 r0(a * a + b * b - c * c - d * d, 2 * (b * c + a * d), 2 * (b * d - a * c));
    const glm::dvec3 r1(2 * (b * c - a * d), a * a + c * c - b * b - d * d, 2 * (c * d + a * b));
    const glm::dvec3 r2(2 * (b * d + a * c), 2 * (c * d - a * b), a * a + d * d - c * c - b * b);
    const glm::dmat4 ras(glm::dvec4(0.5 * r0, 0), glm::dvec4(0.75 * r1, 0), glm::dvec4(2.0 * qfac * r2, 0),
                         glm::dvec4(1.0, 2.0, 3.0, 1));
    Nifti nifti({4, 3, 2}, ras);
    nifti.put<std::int16_t>(254, 0).put<std::int16_t>(252, 1).put<float>(76, qfac);
    nifti.put<float>(256, 0.1F).put<float>(260, -0.2F).put<float>(264, 0.3F);
    nifti.put<float>(268, 1.0F).put<float>(272, 2.0F).put<float>(276, 3.0F);
    expect_volume(read(write("q.nii", nifti.bytes(little_endian(kVoxels)))), ras_from(ras), 2e-5,
                  std::to_string(qfac));
  }
}

TEST_F(FileGeometry, OfTwoNiftiFormsTheScannersIsTaken) {
  const glm::dmat4 lps = placed(glm::dmat3(1.0));
  Nifti nifti({4, 3, 2}, ras_from(lps));
  // A qform (axes along RAS) elsewhere: contradictory when both are the scanner's, another frame otherwise.
  nifti.put<std::int16_t>(252, 1).put<float>(268, 50.0F);
  EXPECT_EQ(refusal(write("t.nii", nifti.bytes(little_endian(kVoxels)))), "no_geometry");
  nifti.put<std::int16_t>(252, 2);
  const auto by_sform = read(write("t.nii", nifti.bytes(little_endian(kVoxels))));
  expect_volume(by_sform, lps, 2e-5, "sform");
  EXPECT_TRUE(has_code(by_sform->warnings, "two_geometries"));
  nifti.put<std::int16_t>(252, 1).put<std::int16_t>(254, 4);
  const auto by_qform = read(write("t.nii", nifti.bytes(little_endian(kVoxels))));
  ASSERT_TRUE(by_qform);
  EXPECT_NEAR(by_qform->volume.lps_from_voxel[3].x, -50.0, 1e-4);
  EXPECT_TRUE(has_code(by_qform->warnings, "two_geometries"));
}

TEST_F(FileGeometry, NrrdSpacesAreTurnedToLps) {
  for (const auto& [name, direction] : directions()) {
    const glm::dmat4 lps = placed(direction);
    glm::dmat4 las = lps;
    for (int column = 0; column < 4; ++column) las[column].y = -las[column].y;
    const std::string raw = little_endian(kVoxels);
    expect_volume(read(write("l.nrrd", nrrd_header(lps, "left-posterior-superior", "raw") + raw)), lps, 1e-9, name);
    expect_volume(read(write("r.nrrd", nrrd_header(ras_from(lps), "right-anterior-superior", "gzip") + gzip(raw))),
                  lps, 1e-9, name);
    expect_volume(read(write("a.nrrd", nrrd_header(las, "LAS", "gz") + gzip(raw))), lps, 1e-9, name);
  }
}

TEST_F(FileGeometry, NrrdVoxelsMayLieBeside) {
  const glm::dmat4 lps = placed(rotation());
  write("v.raw", little_endian(kVoxels));
  write("v.raw.gz", gzip(little_endian(kVoxels)));
  expect_volume(read(write("h.nhdr", nrrd_header(lps, "LPS", "raw", "data file: v.raw\n"))), lps, 1e-9, "raw");
  expect_volume(read(write("g.nhdr", nrrd_header(lps, "LPS", "gzip", "data file: v.raw.gz\n"))), lps, 1e-9, "gzip");
}

TEST_F(FileGeometry, MetaImageMatrixRowsAreTheAxes) {
  for (const auto& [name, direction] : directions()) {
    const glm::dmat4 lps = placed(direction);
    const std::string raw = little_endian(kVoxels), packed = zlib_stream(raw);
    expect_volume(read(write("r.mha", meta_header(direction, "LOCAL") + raw)), lps, 1e-9, name);
    const std::string size = "CompressedData = True\nCompressedDataSize = " + std::to_string(packed.size()) + "\n";
    expect_volume(read(write("z.mha", meta_header(direction, "LOCAL", size) + packed)), lps, 1e-9, name);
    write("v.raw", raw);
    expect_volume(read(write("d.mhd", meta_header(direction, "v.raw"))), lps, 1e-9, name);
    write("v.zraw", packed);
    expect_volume(read(write("e.mhd", meta_header(direction, "v.zraw", size))), lps, 1e-9, name);
  }
}

template <typename T>
std::string raw_bytes(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

TEST_F(FileGeometry, EveryScalarTypeIsRoundedAndClamped) {
  std::string header = meta_header(glm::dmat3(1.0), "LOCAL");
  const auto typed = [&](const std::string& type, const std::string& bytes) {
    std::string text = header;
    text.replace(text.find("4 3 2"), 5, "4 1 1");
    text.replace(text.find("MET_SHORT"), 9, type);
    const auto source = read(write("t.mha", text + bytes));
    EXPECT_TRUE(source) << type;
    return source ? source->volume.hu : std::vector<std::int16_t>();
  };
  using Hu = std::vector<std::int16_t>;
  EXPECT_EQ(typed("MET_UCHAR", raw_bytes<std::uint8_t>({0, 1, 128, 255})), (Hu{0, 1, 128, 255}));
  EXPECT_EQ(typed("MET_CHAR", raw_bytes<std::int8_t>({0, 1, -128, 127})), (Hu{0, 1, -128, 127}));
  EXPECT_EQ(typed("MET_USHORT", raw_bytes<std::uint16_t>({0, 40000, 5, 32767})), (Hu{0, 32767, 5, 32767}));
  EXPECT_EQ(typed("MET_SHORT", raw_bytes<std::int16_t>({-32768, -1024, -1025, 9})), (Hu{-1024, -1024, -1024, 9}));
  EXPECT_EQ(typed("MET_INT", raw_bytes<std::int32_t>({-2000000, 2000000, 7, -7})), (Hu{-1024, 32767, 7, -7}));
  EXPECT_EQ(typed("MET_UINT", raw_bytes<std::uint32_t>({4000000000U, 1, 2, 3})), (Hu{32767, 1, 2, 3}));
  EXPECT_EQ(typed("MET_FLOAT", raw_bytes<float>({-0.6F, 1.4F, 1e30F, -1e30F})), (Hu{-1, 1, 32767, -1024}));
  EXPECT_EQ(typed("MET_DOUBLE", raw_bytes<double>({2.5, -2.6, 1e300, -1e300})), (Hu{3, -3, 32767, -1024}));
}

TEST_F(FileGeometry, NiftiRescaleAndByteOrderAreApplied) {
  Nifti nifti({4, 3, 2}, ras_from(placed(glm::dmat3(1.0))));
  nifti.put<float>(112, 2.0F).put<float>(116, 5.0F);
  const auto source = read(write("s.nii", nifti.bytes(little_endian(kVoxels))));
  ASSERT_TRUE(source);
  for (std::size_t i = 0; i < kVoxels.size(); ++i) EXPECT_EQ(source->volume.hu[i], 2 * kVoxels[i] + 5);

  std::string big = little_endian(kVoxels);
  for (std::size_t i = 0; i < big.size(); i += 2) std::swap(big[i], big[i + 1]);
  std::string header = nrrd_header(placed(glm::dmat3(1.0)), "LPS", "raw");
  header.replace(header.find("endian: little"), 14, "endian: big");
  expect_volume(read(write("b.nrrd", header + big)), placed(glm::dmat3(1.0)), 1e-9, "big endian");
}

TEST_F(FileGeometry, OneSliceIsACaseWithAWarning) {
  const std::string voxels = little_endian({-1000, 0, 10, 20, 30, 40, 50, 60, 70, 80, 90, 100});
  const glm::dmat4 lps = placed(rotation());
  const auto nifti = read(write("s.nii", Nifti({4, 3, 1}, ras_from(lps)).bytes(voxels)));
  std::string meta = meta_header(rotation(), "LOCAL"), nrrd = nrrd_header(lps, "LPS", "raw");
  meta.replace(meta.find("4 3 2"), 5, "4 3 1");
  nrrd.replace(nrrd.find("4 3 2"), 5, "4 3 1");
  const auto metaimage = read(write("s.mha", meta + voxels)), nearly_raw = read(write("s.nrrd", nrrd + voxels));
  for (const auto* source : {&nifti, &metaimage, &nearly_raw}) {
    ASSERT_TRUE(*source) << source->error().code;
    EXPECT_TRUE(has_code((*source)->warnings, "single_slice"));
    EXPECT_EQ((*source)->volume.size_voxels, glm::ivec3(4, 3, 1));
    EXPECT_EQ((*source)->slices_used, 1);
    EXPECT_LT(largest_difference((*source)->volume.lps_from_voxel, lps), 2e-5);
    EXPECT_EQ((*source)->volume.hu[11], 100);
  }
}

TEST_F(FileGeometry, AVolumeWithoutAirIsDoubted) {
  const std::vector<std::int16_t> tissue(24, 40);
  const auto source = read(write("t.mha", meta_header(glm::dmat3(1.0), "LOCAL") + little_endian(tissue)));
  ASSERT_TRUE(source);
  EXPECT_TRUE(has_code(source->warnings, "no_air"));
  std::vector<std::int16_t> with_air = tissue;
  with_air[5] = -900;
  EXPECT_FALSE(has_code(
      read(write("t.mha", meta_header(glm::dmat3(1.0), "LOCAL") + little_endian(with_air)))->warnings, "no_air"));
}

}  // namespace
}  // namespace seldinger::casedb
