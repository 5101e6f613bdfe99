// NIfTI, NRRD and MetaImage made to harm: long texts that overflowed ITK 5.2's buffers, and small files that unpack
// to gigabytes. Lawful files beside them are read.
#include <algorithm>

#include "casedb/import/jail/jail.h"
#include "tests/casedb/import/import_case.h"
#include "tests/casedb/import/peak_memory.h"

namespace seldinger::casedb {
namespace {

class FileAttacks : public ImportCase {};

std::string voxels() {
  std::vector<std::int16_t> values;
  for (int i = 0; i < 512; ++i) values.push_back(static_cast<std::int16_t>((i * 37) % 1500 - 1000));
  return little_endian(values);
}

// `more`: further lines.
std::string meta(const std::string& more, const std::string& size = "8 8 8", const std::string& data = "LOCAL") {
  return "ObjectType = Image\nNDims = 3\n" + more +
         "BinaryData = True\nBinaryDataByteOrderMSB = False\nTransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 0 0 0\n"
         "ElementSpacing = 1 1 1\nDimSize = " +
         size + "\nElementType = MET_SHORT\nElementDataFile = " + data + "\n";
}

std::string nrrd(const std::string& more, const std::string& size = "8 8 8", const std::string& encoding = "raw") {
  return "NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: " + size +
         "\nspace directions: (1,0,0) (0,1,0) (0,0,1)\nkinds: domain domain domain\nendian: little\nencoding: " +
         encoding + "\nspace origin: (0,0,0)\n" + more + "\n";
}

// Two thousand million bytes of 0 in 2 MB: members of gzip one after the other.
std::string gzip_of_zeros() {
  const std::string member = gzip(std::string(1'000'000, '\0'));
  std::string all;
  for (int i = 0; i < 2000; ++i) all += member;
  return all;
}

TEST_F(FileAttacks, ALongLineOfNrrd) {
  // Comments and pairs of a key and its value may be as long as they like; any other line of about 1,000 letters
  // ended the program (SIGABRT; without FORTIFY memory was overwritten).
  for (const std::size_t length : {10U, 250U, 1000U, 5000U, 60000U}) {
    const std::string text(length, 'x');
    EXPECT_EQ(refusal(write("a.nrrd", nrrd("# " + text + "\n") + voxels())), "") << length;
    EXPECT_EQ(refusal(write("a.nrrd", nrrd("k:=" + text + "\n") + voxels())), "") << length;
    EXPECT_EQ(refusal(write("a.nrrd", nrrd(text + ":=v\n") + voxels())), "") << length;
    EXPECT_EQ(refusal(write("a.nrrd", nrrd("content: " + text + "\n") + voxels())), "") << length;
    EXPECT_EQ(refusal(write("a.nrrd", nrrd(text + "\n") + voxels())), "damaged") << length;
    EXPECT_EQ(refusal(write("a.nrrd", nrrd(text + ": y\n") + voxels())), "damaged") << length;
  }
  EXPECT_EQ(refusal(write("a.nrrd", nrrd("# " + std::string(1 << 20, 'x') + "\n") + voxels())), "truncated");
  EXPECT_EQ(refusal(write("a.mha", meta(std::string(1 << 20, '\n')) + voxels())), "truncated");
}

// 3D Slicer writes some 650 letters of each segment: refused as `truncated` above 64 KiB.
TEST_F(FileAttacks, AHeaderOfManyLongLinesIsLawful) {
  std::string tags;
  for (int segment = 0; segment < 110; ++segment)
    tags += "Segment" + std::to_string(segment) + "_Tags:=" + std::string(650, 't') + "\n";
  EXPECT_EQ(refusal(write("a.nrrd", nrrd(tags) + voxels())), "");
}

// The same comment was read behind ObjectType, and `damaged` at the front.
TEST_F(FileAttacks, ALongCommentAtTheFrontIsLawful) {
  const std::string comment = "Comment = " + std::string(5000, 'c') + "\n";
  EXPECT_EQ(refusal(write("a.mha", comment + meta("") + voxels())), "");
  EXPECT_EQ(refusal(write("a.mha", std::string(5000, 'c') + meta("") + voxels())), "damaged");
}

TEST_F(FileAttacks, ALongCommentOfMetaImageIsLawful) {
  // 300 letters ended the program (SIGABRT).
  for (const std::size_t length : {10U, 254U, 255U, 256U, 300U, 5000U, 60000U}) {
    EXPECT_EQ(refusal(write("a.mha", meta("Comment = " + std::string(length, 'c') + "\n") + voxels())), "")
        << length;
    EXPECT_EQ(refusal(write("a.mha", meta("Name = " + std::string(length, 'c') + "\n") + voxels())), "") << length;
  }
}

TEST_F(FileAttacks, ALongKeyOfMetaImage) {
  // 255 letters ended the program (SIGABRT).
  EXPECT_EQ(refusal(write("a.mha", meta(std::string(254, 'K') + " = 1\n") + voxels())), "");
  for (const std::size_t length : {255U, 256U, 300U, 5000U})
    EXPECT_EQ(refusal(write("a.mha", meta(std::string(length, 'K') + " = 1\n") + voxels())), "damaged") << length;
}

TEST_F(FileAttacks, NumbersOfAHeaderThatFitNowhere) {
  for (const char* size : {"1e300", "-1", "nan", "1e30", "99999999999999999999"})
    EXPECT_NE(
        refusal(write("a.mha",
                      meta(std::string("CompressedData = True\nCompressedDataSize = ") + size + "\n") + voxels())),
        "")
        << size;
  std::string many;
  for (int i = 0; i < 15000; ++i) many += " 8";
  EXPECT_EQ(refusal(write("a.mha", meta("", "8 8 8" + many) + voxels())), "damaged");
  EXPECT_EQ(refusal(write("a.nrrd", nrrd("", "8 8 8" + many) + voxels())), "damaged");
}

TEST_F(FileAttacks, TheSameThingSaidTwiceAndDifferently) {
  EXPECT_EQ(refusal(write("a.mha", meta("Position = 0 0 0\n") + voxels())), "");
  EXPECT_EQ(refusal(write("a.mha", meta("Position = 0 0 5\n") + voxels())), "no_geometry");
  EXPECT_EQ(refusal(write("a.mha", meta("Rotation = 0 1 0 1 0 0 0 0 1\n") + voxels())), "no_geometry");
}

TEST_F(FileAttacks, TwoMegabytesDoNotBecomeTwoThousand) {
  // The first was stored as a case after 207 s and 10.6 GB.
  const std::string zeros = gzip_of_zeros(), header = Nifti({1000, 1000, 1000}, glm::dmat4(1.0)).bytes("");
  ASSERT_LT(zeros.size(), std::size_t{3} << 20);
  write("v.raw.gz", zeros);
  const std::string size = "CompressedData = True\nCompressedDataSize = " + std::to_string(zeros.size()) + "\n";
  const std::filesystem::path bombs[] = {write("a.nii.gz", gzip(header) + zeros),
                                         write("b.nrrd", nrrd("", "1000 1000 1000", "gzip") + zeros),
                                         write("c.nhdr", nrrd("data file: v.raw.gz\n", "1000 1000 1000", "gzip")),
                                         write("d.mha", meta(size, "1000 1000 1000") + zeros),
                                         write("e.mhd", meta(size, "1000 1000 1000", "v.raw.gz"))};
  for (const std::filesystem::path& bomb : bombs) {
    const PeakMemory memory;
    EXPECT_EQ(refusal(bomb), "too_large") << bomb.extension();
    EXPECT_LT(last_jail_use().peak_bytes, std::size_t{64} << 20);
    EXPECT_LT(memory.bytes(), std::size_t{64} << 20);
    EXPECT_LT(last_jail_use().cpu_s, 2.0);
  }
  // As a label map of a small case.
  const auto label = read_source(bombs[0], {}, label_file_limit(1'000'000));
  ASSERT_FALSE(label.has_value());
  EXPECT_EQ(label.error().code, "too_large");
  // 60 MB of nothing are taken.
  const std::string nothing(std::size_t{60} << 20, '\0');
  EXPECT_EQ(refusal(write("f.nrrd", nrrd("", "512 512 120", "gzip") + gzip(nothing))), "");
}

TEST_F(FileAttacks, VoxelsBesideAHeaderThatIsNamedWithoutAFolder) {
  write("v.raw", voxels());
  write("a.mhd", meta("", "8 8 8", "v.raw"));
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder_);
  EXPECT_EQ(refusal("a.mhd"), "");
  std::filesystem::current_path(before);
}

TEST_F(FileAttacks, MoreThanFourGigabytesOnlyWhenAsked) {
  // 700 million voxels in doubles; the voxels themselves are missing.
  Nifti header({1000, 1000, 700}, glm::dmat4(1.0));
  header.put<std::int16_t>(70, 64).put<std::int16_t>(72, 64);
  const auto file = write("a.nii", header.bytes(""));
  EXPECT_EQ(refusal(file), "too_large");
  const auto large = read_source(file, {}, kLargeCtFile);
  ASSERT_FALSE(large.has_value());
  EXPECT_EQ(large.error().code, "truncated");
}

}  // namespace
}  // namespace seldinger::casedb
