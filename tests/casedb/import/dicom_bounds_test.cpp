// What is huge, or pretends to be, is refused in little time and memory.
#include <sys/stat.h>

#include "casedb/import/jail/jail.h"
#include "tests/casedb/import/dicom_writer.h"
#include "tests/casedb/import/fuzz_import.h"
#include "tests/casedb/import/import_case.h"
#include "tests/casedb/import/packed_frame.h"
#include "tests/casedb/import/peak_memory.h"
#include "tests/fixtures/cpu_time.h"
#include "tests/fixtures/mutate.h"

namespace seldinger::casedb {
namespace {

constexpr const char *kRle = "1.2.840.10008.1.2.5", *kJpeg = "1.2.840.10008.1.2.4.70",
                     *kJpegLs = "1.2.840.10008.1.2.4.80", *kJpeg2000 = "1.2.840.10008.1.2.4.90";

class DicomBounds : public ImportCase {
 protected:
  // The code, after a look at memory and the processor's time.
  std::string bounded(const std::filesystem::path& source, std::size_t honest_bytes, double most_seconds = 10.0) {
    const PeakMemory memory;
    const double begin_s = fixtures::cpu_s();
    const auto result = read(source);
    const double seconds = fixtures::cpu_s() - begin_s + last_jail_use().cpu_s;
    EXPECT_LT(memory.bytes(), allowed_bytes(honest_bytes));
    EXPECT_LT(last_jail_use().peak_bytes, allowed_bytes(honest_bytes));
    EXPECT_LT(seconds, most_seconds);
    return result ? "" : result.error().code;
  }
};

TEST_F(DicomBounds, ADeflateBombIsNotUnpacked) {
  TestDicom file = TestDicom::ct_slice({4, 3});
  file.raw(0x00091010, "OB", std::string(std::size_t{80} << 20, '\0'));
  const std::string bomb = file.bytes(TestSyntax::deflated);
  ASSERT_LT(bomb.size(), std::size_t{1} << 20);
  EXPECT_EQ(bounded(write("PLANTED.dcm", bomb), bomb.size()), "bad_size");
  // Beside a series it may be one of its slices.
  for (int k = 0; k < 3; ++k) write(numbered("s", k), TestDicom::ct_slice({4, 3}).at({0, 0, 2.0 * k}).bytes());
  EXPECT_EQ(bounded(folder_, bomb.size()), "bad_size");
}

TEST_F(DicomBounds, AZipBombIsAFileLikeAnyOther) {
  write("PLANTED.zip", std::string("PK\3\4", 4) + zlib_stream(std::string(std::size_t{100} << 20, '\0')));
  for (int k = 0; k < 3; ++k) write(numbered("s", k), TestDicom::ct_slice({4, 3}).at({0, 0, 2.0 * k}).bytes());
  EXPECT_EQ(bounded(folder_, 1 << 20), "");
}

TEST_F(DicomBounds, FramesThatPromiseAnotherSizeThanTheHeader) {
  constexpr glm::ivec2 kSize{16, 12};
  const std::vector<int> stored(16 * 12, 7);
  const auto promising = [&](const char* syntax, const std::string& mark, std::size_t at, const std::string& size) {
    std::string frame = packed_frame(syntax, kSize, stored);
    EXPECT_EQ(refusal(write("PLANTED.dcm", TestDicom::ct_slice(kSize).fragments(syntax, {frame}).bytes())), "")
        << syntax;
    const std::size_t found = frame.find(mark);
    EXPECT_NE(found, std::string::npos) << syntax;
    frame.replace(found + at, size.size(), size);
    return bounded(write("PLANTED.dcm", TestDicom::ct_slice(kSize).fragments(syntax, {frame}).bytes()), 4096);
  };
  EXPECT_EQ(promising(kJpeg, "\xFF\xC3", 5, std::string(4, '\xFF')), "damaged");
  EXPECT_EQ(promising(kJpegLs, "\xFF\xF7", 5, std::string(4, '\xFF')), "damaged");
  EXPECT_EQ(promising(kJpeg2000, "\xFF\x51", 6, std::string("\0\0\xFF\xFF\0\0\xFF\xFF", 8)), "damaged");
  EXPECT_EQ(promising(kJpeg2000, "\xFF\x51", 22, std::string("\0\0\0\1\0\0\0\1", 8)), "damaged");  // a tile a pixel
}

// JPEG 2000 streams with FF behind their end were refused as cut.
TEST_F(DicomBounds, PaddingBehindAFramesEndIsNoPartOfIt) {
  constexpr glm::ivec2 kSize{16, 12};
  std::vector<int> stored;
  for (int i = 0; i < 16 * 12; ++i) stored.push_back(i * 5 - 300);
  for (const char* syntax : {kJpeg, kJpegLs, kJpeg2000}) {
    std::string frame = packed_frame(syntax, kSize, stored);
    frame.resize(frame.rfind("\xFF\xD9") + 2);
    for (const std::string& padding : {std::string("\xFF"), std::string("\xFF\xFF\xFF\xFF"),
                                       std::string("\0\xFF\0", 3), std::string(4097, '\xFF')}) {
      std::string padded = frame + padding;
      if (padded.size() % 2 != 0) padded.push_back(padding.back());
      const auto source =
          read(write("PLANTED.dcm", TestDicom::ct_slice(kSize).fragments(syntax, {padded}).bytes()));
      ASSERT_TRUE(source) << syntax << source.error().text;
      for (std::size_t i = 0; i < stored.size(); ++i) ASSERT_EQ(source->volume.hu[i], stored[i]) << syntax;
    }
    // Without its end it is cut, padded or not.
    const std::string cut = frame.substr(0, frame.size() - 4) + std::string(4, '\xFF');
    EXPECT_EQ(refusal(write("PLANTED.dcm", TestDicom::ct_slice(kSize).fragments(syntax, {cut}).bytes())),
              "truncated");
  }
}

TEST_F(DicomBounds, RleFramesThatLie) {
  const std::string frame = rle_frame(std::vector<int>(16 * 12, 7));
  const auto with = [&](std::size_t at, const std::string& bytes) {
    std::string lying = frame;
    lying.replace(at, bytes.size(), bytes);
    return bounded(write("PLANTED.dcm", TestDicom::ct_slice({16, 12}).fragments(kRle, {lying}).bytes()), 4096);
  };
  EXPECT_EQ(with(0, ""), "");
  EXPECT_EQ(with(0, std::string("\2\0\x24\0", 4)), "damaged");  // 2359298 segments: GDCM ends there
  EXPECT_EQ(with(0, "\1"), "damaged");
  EXPECT_EQ(with(4, "\xFF"), "damaged");
  EXPECT_EQ(with(8, std::string(4, '\xFF')), "damaged");
  EXPECT_EQ(with(8, std::string(4, '\0')), "damaged");
  EXPECT_EQ(with(64, "\xFF"), "damaged");  // two bytes instead of 128
  EXPECT_EQ(
      bounded(write("PLANTED.dcm", TestDicom::ct_slice({16, 12}).fragments(kRle, {frame.substr(0, 200)}).bytes()),
              4096),
      "damaged");
}

TEST_F(DicomBounds, AHeaderThatPromisesMoreThanItsFrames) {
  const std::string frame = packed_frame(kJpeg2000, {16, 12}, std::vector<int>(16 * 12, 7));
  EXPECT_EQ(bounded(write("PLANTED.dcm",
                          TestDicom::ct_slice({4096, 4096}).pixels({}).fragments(kJpeg2000, {frame}).bytes()),
                    0),
            "damaged");
  // 40 slices of 32 MB, in some kB.
  for (int k = 0; k < 40; ++k)
    write(numbered("many/s", k), TestDicom::ct_slice({1, 1})
                                     .u16(0x00280010, "US", 4096)
                                     .u16(0x00280011, "US", 4096)
                                     .at({0, 0, 2.0 * k})
                                     .fragments(kRle, {std::string(100, '\1')})
                                     .bytes());
  EXPECT_EQ(bounded(folder_ / "many", 1 << 20), "bad_size");
  EXPECT_EQ(bounded(write("native.dcm", TestDicom::ct_slice({4, 3}).u16(0x00280010, "US", 4096).bytes()), 4096),
            "truncated");
}

TEST_F(DicomBounds, FramesWithoutEnd) {
  TestDicom file = enhanced_ct({4, 3}, {{0, 0, 0}});
  file.text(0x00280008, "IS", "20000").sequence(0x52009230, std::vector<TestDicom>(20000));
  EXPECT_EQ(bounded(write("PLANTED.dcm", file.bytes()), file.bytes().size()), "damaged");
  // 8000 places for pixels that are not there.
  std::vector<glm::dvec3> places;
  for (int k = 0; k < 5000; ++k) places.emplace_back(0, 0, k);
  file = enhanced_ct({1, 1}, places);
  EXPECT_EQ(bounded(write("PLANTED.dcm", file.bytes()), file.bytes().size()), "too_many_slices");
}

TEST_F(DicomBounds, AMillionFragments) {
  std::string all;
  for (int i = 0; i < 1100000; ++i) all += std::string("\xFE\xFF\x00\xE0\0\0\0\0", 8);
  TestDicom file = TestDicom::ct_slice({4, 3});
  file.fragments(kRle, {});
  std::string bytes = file.bytes();
  bytes.insert(bytes.size() - 8, all);
  EXPECT_EQ(bounded(write("PLANTED.dcm", bytes), bytes.size()), "damaged");
}

TEST_F(DicomBounds, ThirtyThousandSlices) {
  const auto first = write("s", TestDicom::ct_slice({1, 1}).bytes());
  for (int k = 1; k < 30000; ++k) std::filesystem::create_hard_link(first, folder_ / numbered("s", k));
  EXPECT_EQ(bounded(folder_, std::size_t{30000} * 1024, 60.0), "too_many_slices");
}

TEST_F(DicomBounds, AFileOfTwoGigabytesIsToldByItsBeginning) {
  for (int k = 0; k < 3; ++k) write(numbered("s", k), TestDicom::ct_slice({4, 3}).at({0, 0, 2.0 * k}).bytes());
  TestDicom file = TestDicom::ct_slice({4, 3});
  const auto large = write("large", file.text(0x00080060, "CS", "US").bytes());
  std::filesystem::resize_file(large, std::uint64_t{2} << 30);  // a hole: takes no room
  EXPECT_EQ(bounded(folder_, 0), "");
  write("large", file.text(0x00080060, "CS", "CT").bytes());
  std::filesystem::resize_file(large, std::uint64_t{2} << 30);
  EXPECT_EQ(bounded(folder_, 0), "bad_size");
  EXPECT_EQ(bounded(large, 0), "bad_size");
}

TEST_F(DicomBounds, APipeInTheFolderIsNotWaitedFor) {
  for (int k = 0; k < 3; ++k) write(numbered("s", k), TestDicom::ct_slice({4, 3}).at({0, 0, 2.0 * k}).bytes());
  ASSERT_EQ(::mkfifo((folder_ / "pipe.dcm").c_str(), 0600), 0);
  EXPECT_EQ(refusal(folder_), "");
  EXPECT_EQ(refusal(folder_ / "pipe.dcm"), "unknown_format");
}

TEST_F(DicomBounds, ALargeMultiFrameFileIsHeldOnce) {
  std::vector<glm::dvec3> places;
  for (int k = 0; k < 160; ++k) places.emplace_back(0, 0, k);
  std::string bytes;
  {
    TestDicom file = enhanced_ct({1, 1}, places);
    file.u16(0x00280010, "US", 512).u16(0x00280011, "US", 512);
    file.raw(0x7FE00010, "OW", std::string(std::size_t{160} * 512 * 512 * 2, '\0'));
    bytes = file.bytes();
  }
  const auto file = write("PLANTED.dcm", bytes);
  const std::size_t size = bytes.size();
  bytes = {};
  bytes.shrink_to_fit();
  EXPECT_EQ(bounded(file, size, 30.0), "");
}

TEST_F(DicomBounds, MutatedFilesNeverHarm) {
  for (const FuzzedReader reader : kFuzzedReaders)
    fuzz_import(folder_, reader, 20240607, fixtures::fuzz_rounds(250));
}

}  // namespace
}  // namespace seldinger::casedb
