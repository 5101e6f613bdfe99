// NIfTI, NRRD and MetaImage files that are cut, damaged or no CT volume are refused with a stable code, before
// anything is allocated for what they promise.
#include <functional>
#include <glm/matrix.hpp>
#include <limits>
#include <random>

#include "tests/casedb/import/import_case.h"
#include "tests/fixtures/outcomes.h"

namespace seldinger::casedb {
namespace {

class FileRefused : public ImportCase {};

const std::string kMeta =
    "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nCompressedData = False\n"
    "TransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 0 0 0\nElementSpacing = 1 1 1\nDimSize = 8 8 8\n"
    "ElementType = MET_SHORT\nElementDataFile = LOCAL\n";
const std::string kNrrd =
    "NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 8 8 8\n"
    "space directions: (1,0,0) (0,1,0) (0,0,1)\nkinds: domain domain domain\nendian: little\nencoding: raw\n"
    "space origin: (0,0,0)\n\n";

std::string random_voxels() {
  std::mt19937 random(3);
  std::vector<std::int16_t> values;
  for (int i = 0; i < 512; ++i) values.push_back(static_cast<std::int16_t>(random() % 2000) - 1000);
  return little_endian(values);
}

std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string packed_meta() {
  const std::string packed = zlib_stream(random_voxels());
  return with(kMeta, "CompressedData = False",
              "CompressedData = True\nCompressedDataSize = " + std::to_string(packed.size())) +
         packed;
}

glm::dmat4 straight() {
  return glm::dmat4(1.0);
}

TEST_F(FileRefused, EveryFormatCutAnywhere) {
  const std::pair<const char*, std::string> files[] = {
      {"a.mha", kMeta + random_voxels()},
      {"b.mha", packed_meta()},
      {"c.nrrd", kNrrd + random_voxels()},
      {"d.nrrd", with(kNrrd, "raw", "gzip") + gzip(random_voxels())},
      {"e.nii", Nifti({8, 8, 8}, straight()).bytes(random_voxels())},
      {"f.nii.gz", gzip(Nifti({8, 8, 8}, straight()).bytes(random_voxels()))},
  };
  for (const auto& [name, whole] : files) {
    ASSERT_EQ(refusal(write(name, whole)), "") << name;
    for (std::size_t lost = 1; lost < whole.size(); lost += lost < 20 ? 1 : 37) {
      const std::string code = refusal(write(name, whole.substr(0, whole.size() - lost)));
      EXPECT_NE(code, "") << name << " -" << lost;
      if (lost < 300) {
        EXPECT_EQ(code, "truncated") << name << " -" << lost;
      }
    }
    EXPECT_NE(refusal(write(name, "")), "") << name;
  }
}

TEST_F(FileRefused, APackedByteThatChanged) {
  std::string nifti = gzip(Nifti({8, 8, 8}, straight()).bytes(random_voxels()));
  nifti[nifti.size() - 6] = static_cast<char>(nifti[nifti.size() - 6] + 1);  // of the check sum
  EXPECT_EQ(refusal(write("a.nii.gz", nifti)), "damaged");
  std::string meta = packed_meta();
  meta[meta.size() - 1] = static_cast<char>(meta[meta.size() - 1] + 1);
  EXPECT_EQ(refusal(write("a.mha", meta)), "damaged");
}

// It was read as if all behind the header were its voxels.
TEST_F(FileRefused, APackedMetaImageWithoutItsSize) {
  const std::string packed = zlib_stream(random_voxels());
  const auto with_size = [&](const std::string& line) {
    return refusal(write("a.mha", with(kMeta, "CompressedData = False", "CompressedData = True" + line) + packed));
  };
  EXPECT_EQ(with_size("\nCompressedDataSize = " + std::to_string(packed.size())), "");
  for (const char* line : {"", "\nCompressedDataSize =", "\nCompressedDataSize = 0", "\nCompressedDataSize = -5",
                           "\nCompressedDataSize = many", "\nCompressedDataSize = 1 2"})
    EXPECT_EQ(with_size(line), "damaged") << line;
  EXPECT_EQ(with_size("\nCompressedDataSize = " + std::to_string(packed.size() - 1)), "truncated");
}

TEST_F(FileRefused, MorePackedBytesThanPromised) {
  const std::string bomb(std::size_t{64} << 20, '\0');
  EXPECT_EQ(refusal(write("a.nii.gz", gzip(Nifti({8, 8, 8}, straight()).bytes(bomb)))), "damaged");
}

TEST_F(FileRefused, RandomBytesUnderEveryName) {
  std::mt19937 random(5);
  for (const char* name : {"r.nii", "r.nii.gz", "r.nrrd", "r.nhdr", "r.mha", "r.mhd", "r.dcm"})
    for (const int size : {0, 1, 10, 400, 5000}) {
      std::string bytes;
      for (int i = 0; i < size; ++i) bytes.push_back(static_cast<char>(random()));
      EXPECT_EQ(refusal(write(name, bytes)), "damaged") << name << size;
    }
  EXPECT_EQ(refusal(write("r.bin", "whatever")), "unknown_format");
  EXPECT_EQ(refusal(write("r.nii.gz", gzip("whatever"))), "truncated");
  EXPECT_EQ(refusal(write("r.nii.gz", gzip(std::string(1000, 'x')))), "damaged");
}

TEST_F(FileRefused, RandomHeadersAreReadOrRefused) {
  std::mt19937 random(13);
  const std::pair<const char*, std::string> files[] = {
      {"a.mha", kMeta + random_voxels()},
      {"c.nrrd", kNrrd + random_voxels()},
      {"e.nii", Nifti({8, 8, 8}, straight()).bytes(random_voxels())}};
  for (const auto& [name, whole] : files) {
    SCOPED_TRACE(name);
    fixtures::Outcomes outcomes;
    for (int round = 0; round < 300; ++round) {
      std::string bytes = whole;
      const std::size_t header = whole.size() - 1024;
      // Digits as well: in a header of text any other byte is refused at the door.
      for (int i = 0; i <= round % 3; ++i)
        bytes[random() % header] = static_cast<char>(round % 2 == 0 ? random() : '0' + random() % 10);
      outcomes.add(read(write(name, bytes)));
    }
    outcomes.expect_both();
  }
}

TEST_F(FileRefused, WhatIsNoScalarVolume) {
  const std::string v = random_voxels();
  EXPECT_EQ(
      refusal(write("a.mha", with(kMeta, "ElementType", "ElementNumberOfChannels = 3\nElementType") + v + v + v)),
      "not_scalar");
  EXPECT_EQ(refusal(write("a.mha", with(kMeta, "MET_SHORT", "MET_OTHER") + v)), "not_scalar");
  const std::string four = with(with(with(with(kMeta, "NDims = 3", "NDims = 4"), "8 8 8", "8 8 4 2"),
                                     "1 0 0 0 1 0 0 0 1", "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"),
                                "ElementSpacing = 1 1 1", "ElementSpacing = 1 1 1 1");
  EXPECT_EQ(refusal(write("a.mha", with(four, "Offset = 0 0 0", "Offset = 0 0 0 0") + v)), "not_3d");
  EXPECT_EQ(refusal(write("a.nii",
                          Nifti({8, 8, 4}, straight()).put<std::int16_t>(40, 4).put<std::int16_t>(48, 2).bytes(v))),
            "not_3d");
  EXPECT_EQ(refusal(write("a.nii", Nifti({8, 8, 8}, straight()).put<std::int16_t>(70, 128).bytes(v + v))),
            "not_scalar");
  EXPECT_EQ(refusal(write("a.nii", Nifti({8, 8, 8}, straight()).put<std::int16_t>(70, 32).bytes(v + v + v + v))),
            "not_scalar");
  const std::string colour = with(with(kNrrd, "8 8 8", "3 8 8"), "domain domain domain", "RGB-color domain domain");
  EXPECT_EQ(refusal(write("a.nrrd", with(colour, "(1,0,0)", "none") + v)), "not_scalar");
  EXPECT_EQ(refusal(write("a.nrrd", with(with(kNrrd, "dimension: 3", "dimension: 4"), "8 8 8", "8 8 4 2") + v)),
            "not_3d");
  // A volume of one time is one volume.
  EXPECT_EQ(refusal(write("a.nii", Nifti({8, 8, 8}, straight()).put<std::int16_t>(40, 4).bytes(v))), "");
}

TEST_F(FileRefused, NumbersThatAreNone) {
  std::vector<float> values(512, 1.0F);
  const auto bytes = [&] { return std::string(reinterpret_cast<const char*>(values.data()), 2048); };
  const std::string meta = with(kMeta, "MET_SHORT", "MET_FLOAT");
  EXPECT_EQ(refusal(write("a.mha", meta + bytes())), "");
  values[100] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(refusal(write("a.mha", meta + bytes())), "not_finite");
  values[100] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(refusal(write("a.mha", meta + bytes())), "not_finite");
  // ITK's NIfTI reader would make 0 HU of them, which is water.
  const auto nifti = [&] {
    return Nifti({8, 8, 8}, straight()).put<std::int16_t>(70, 16).put<std::int16_t>(72, 32).bytes(bytes());
  };
  EXPECT_EQ(refusal(write("a.nii", nifti())), "not_finite");
  EXPECT_EQ(refusal(write("a.nii.gz", gzip(nifti()))), "not_finite");
  values[100] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(refusal(write("a.nii", nifti())), "not_finite");
  values[100] = 3.0e38F;
  EXPECT_EQ(refusal(write("a.nii", nifti())), "");
}

TEST_F(FileRefused, MetaImageFieldsThatWouldChangeTheNumbers) {
  const std::string v = random_voxels();
  const auto added = [&](const std::string& line) {
    return refusal(write("a.mha", with(kMeta, "ElementDataFile", line + "\nElementDataFile") + v));
  };
  EXPECT_EQ(added("ElementToIntensityFunctionSlope = 2"), "bad_rescale");
  EXPECT_EQ(added("ElementToIntensityFunctionOffset = 10"), "bad_rescale");
  EXPECT_EQ(added("DistanceUnits = cm"), "no_geometry");
  EXPECT_EQ(added("ElementToIntensityFunctionSlope = 1\nElementToIntensityFunctionOffset = 0\nDistanceUnits = mm"),
            "");
}

TEST_F(FileRefused, SizesOutOfRange) {
  const std::string v = random_voxels();
  for (const char* size : {"0 8 8", "8 -8 8", "8 8 5000", "4096 4096 4096", "8 8 1e18", "99999999999999999999 8 8"})
    EXPECT_EQ(refusal(write("a.mha", with(kMeta, "8 8 8", size) + v)), "bad_size") << size;
  EXPECT_EQ(refusal(write("a.nrrd", with(kNrrd, "8 8 8", "8 0 8") + v)), "bad_size");
  EXPECT_EQ(refusal(write("a.nrrd", with(kNrrd, "8 8 8", "4096 4096 4095") + v)), "bad_size");
  EXPECT_EQ(refusal(write("a.nii", Nifti({8, -1, 8}, straight()).bytes(v))), "bad_size");
  EXPECT_EQ(refusal(write("a.nii", Nifti({4096, 4096, 60}, straight()).bytes(v))), "truncated");
  EXPECT_EQ(refusal(write("a.mha", with(kMeta, "8 8 8", "8 8") + v)), "damaged");
}

TEST_F(FileRefused, GeometryThatIsUnsound) {
  const std::string v = random_voxels();
  for (const char* spacing : {"0 1 1", "1 -1 1", "1 nan 1", "1 1 1e9", "1 1", "1 x 1"})
    EXPECT_EQ(refusal(write("a.mha",
                            with(kMeta, "ElementSpacing = 1 1 1", std::string("ElementSpacing = ") + spacing) + v)),
              "no_geometry")
        << spacing;
  EXPECT_EQ(refusal(write("a.mha", with(kMeta, "ElementSpacing = 1 1 1\n", "") + v)), "no_geometry");
  for (const char* matrix :
       {"1 0 0 1 0 0 0 0 1", "0 0 0 0 0 0 0 0 0", "1 0 0 0.2 1 0 0 0 1", "1 0 0 0 1 0 0 0", "1 0 0 0 nan 0 0 0 1"})
    EXPECT_EQ(refusal(write("a.mha", with(kMeta, "1 0 0 0 1 0 0 0 1", matrix) + v)), "no_geometry") << matrix;
  for (const char* directions : {"(1,0,0) (1,0,0) (0,0,1)", "(1,0,0) (0,0,0) (0,0,1)", "(1,0,0) (0.2,1,0) (0,0,1)",
                                 "(1,0,0) (0,nan,0) (0,0,1)", "(1,0,0) (0,1,0)", "none (0,1,0) (0,0,1)"})
    EXPECT_EQ(refusal(write("a.nrrd", with(kNrrd, "(1,0,0) (0,1,0) (0,0,1)", directions) + v)), "no_geometry")
        << directions;
  EXPECT_EQ(refusal(write("a.nrrd", with(kNrrd, "left-posterior-superior", "scanner-xyz") + v)), "no_geometry");
  EXPECT_EQ(refusal(write("a.nrrd", with(kNrrd, "space origin: (0,0,0)\n", "") + v)), "no_geometry");
  const auto nifti = [&](Nifti file) { return refusal(write("a.nii", file.bytes(v))); };
  EXPECT_EQ(nifti(Nifti({8, 8, 8}, straight()).put<float>(80, 0.0F)), "no_geometry");
  EXPECT_EQ(nifti(Nifti({8, 8, 8}, straight()).put<float>(84, -1.0F)), "no_geometry");
  EXPECT_EQ(nifti(Nifti({8, 8, 8}, straight()).put<float>(88, std::numeric_limits<float>::quiet_NaN())),
            "no_geometry");
  EXPECT_EQ(nifti(Nifti({8, 8, 8}, straight()).put<std::int16_t>(254, 0)), "no_geometry");
  for (std::size_t at = 280; at < 328; at += 4)  // ITK's reader ends the program on each
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 3e38F})
      EXPECT_EQ(nifti(Nifti({8, 8, 8}, straight()).put<float>(at, bad)), "no_geometry") << at << ' ' << bad;
  EXPECT_EQ(nifti(Nifti({8, 8, 8}, straight()).put<char>(123, 1)), "no_geometry");      // metres
  EXPECT_EQ(nifti(Nifti({8, 8, 8}, straight()).put<float>(284, 0.3F)), "no_geometry");  // sheared
  EXPECT_EQ(nifti(Nifti({8, 8, 8}, straight()).put<float>(280, 0.0F)), "no_geometry");  // singular
  EXPECT_EQ(nifti(Nifti({8, 8, 8}, straight()).put<float>(280, 2.0F)), "no_geometry");  // not pixdim
}

TEST_F(FileRefused, VoxelFilesThatAreNotBeside) {
  write("v.raw", random_voxels());
  write("short.raw", random_voxels().substr(1));
  write("PLANTED_elsewhere/v.raw", random_voxels());
  std::filesystem::create_symlink("v.raw", folder_ / "link.raw");
  const auto meta = [&](const std::string& name) {
    return refusal(write("PLANTED.mhd", with(kMeta, "LOCAL", name)));
  };
  const auto nrrd = [&](const std::string& name) {
    return refusal(write("PLANTED.nhdr", with(kNrrd, "space origin", "data file: " + name + "\nspace origin")));
  };
  for (const auto& read_beside : {std::function<std::string(const std::string&)>(meta),
                                  std::function<std::string(const std::string&)>(nrrd)}) {
    EXPECT_EQ(read_beside("v.raw"), "");
    EXPECT_EQ(read_beside("short.raw"), "truncated");
    EXPECT_EQ(read_beside("absent.raw"), "no_data_file");
    EXPECT_EQ(read_beside("link.raw"), "no_data_file");
    EXPECT_EQ(read_beside("PLANTED_elsewhere/v.raw"), "bad_data_file");
    EXPECT_EQ(read_beside("../v.raw"), "bad_data_file");
    EXPECT_EQ(read_beside((folder_ / "v.raw").string()), "bad_data_file");
    EXPECT_EQ(read_beside("LIST"), read_beside("LIST"));
    EXPECT_NE(read_beside("LIST"), "");
    EXPECT_EQ(read_beside("v%02d.raw"), "bad_data_file");
  }
}

TEST_F(FileRefused, AChoiceOfSeriesNeedsSeries) {
  const auto file = write("a.mha", kMeta + random_voxels());
  EXPECT_EQ(refusal(file, "2"), "no_series");
  EXPECT_EQ(refusal(file, "1"), "");
}

}  // namespace
}  // namespace seldinger::casedb
