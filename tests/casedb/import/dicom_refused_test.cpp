// DICOM that would give a wrong volume, or none, is refused with a stable code, without a crash and without a word
// of what the file says.
#include <cmath>
#include <random>

#include "tests/casedb/import/dicom_writer.h"
#include "tests/casedb/import/import_case.h"
#include "tests/fixtures/outcomes.h"
#include "tests/fixtures/shared_data.h"

namespace seldinger::casedb {
namespace {

class DicomRefused : public ImportCase {
 protected:
  void write_stack(int count) {
    for (int k = 0; k < count; ++k) write_slice(k, slice(k));
  }
  static TestDicom slice(int k) { return TestDicom::ct_slice(kSize).at({0.0, 0.0, 2.0 * k}); }
  void write_slice(int k, const TestDicom& file) { write(numbered("PLANTED", k), file.bytes()); }
  static constexpr glm::ivec2 kSize{4, 3};
};

TEST_F(DicomRefused, NothingToRead) {
  EXPECT_EQ(refusal(folder_), "empty_folder");
  EXPECT_EQ(refusal(folder_ / "absent"), "not_found");
  EXPECT_EQ(refusal("/dev/null"), "unknown_format");
  write("a.txt", "no picture");
  EXPECT_EQ(refusal(folder_), "no_dicom");
  EXPECT_EQ(refusal(folder_ / "a.txt"), "unknown_format");
}

// It said no more than that no file is DICOM. The file's name is not told: it may be a patient's.
TEST_F(DicomRefused, AFolderOfVolumeFilesSaysToGiveTheFile) {
  write("README", "about it");
  write("PLANTED.nii", "damaged, and no volume file");
  write("PLANTED.nrrd", "NRRD0004\n");
  const auto one = read(folder_);
  ASSERT_FALSE(one);
  EXPECT_EQ(one.error().code, "no_dicom");
  EXPECT_EQ(one.error().text,
            "no file in the folder is DICOM; it holds one volume file (.nrrd): give that file itself");
  write("PLANTED.mha", "ObjectType = Image\n");
  const auto two = read(folder_);
  ASSERT_FALSE(two);
  EXPECT_EQ(two.error().text, "no file in the folder is DICOM; it holds 2 volume files: give one of them itself");
}

TEST_F(DicomRefused, OtherKindsOfObject) {
  const auto one = [&](const TestDicom& file) { return refusal(write("PLANTED", file.bytes())); };
  EXPECT_EQ(one(slice(0).text(0x00080060, "CS", "MR")), "not_ct");
  EXPECT_EQ(one(slice(0).remove(0x00080060)), "not_ct");
  EXPECT_EQ(one(slice(0).text(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.128")), "not_ct");  // PET, says CT
  EXPECT_EQ(one(slice(0).text(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.2.1")), "multi_frame");
  EXPECT_EQ(one(slice(0).text(0x00280008, "IS", "2")), "multi_frame");
  EXPECT_EQ(one(slice(0).text(0x00080008, "CS", "ORIGINAL\\PRIMARY\\LOCALIZER")), "localizer");
  EXPECT_EQ(one(slice(0).text(0x00080008, "CS", "DERIVED\\SECONDARY\\SCREEN SAVE")), "burned_in");
  EXPECT_EQ(one(slice(0).text(0x00280301, "CS", "YES")), "burned_in");
  EXPECT_EQ(one(slice(0).remove(0x7FE00010)), "no_image");
  EXPECT_EQ(one(slice(0).u16(0x00280002, "US", 3).text(0x00280004, "CS", "RGB")), "rgb");
  EXPECT_EQ(one(slice(0).text(0x00280004, "CS", "PALETTE COLOR")), "rgb");
  EXPECT_EQ(one(slice(0).u16(0x00280100, "US", 32)), "unknown_pixels");
  EXPECT_EQ(one(slice(0).u16(0x00280010, "US", 65535)), "bad_size");
  EXPECT_EQ(one(slice(0).u16(0x00280010, "US", 0)), "bad_size");
  EXPECT_EQ(one(slice(0).text(0x00281053, "DS", "0")), "bad_rescale");
  EXPECT_EQ(one(slice(0).raw(0x00283000, "SQ", "")), "bad_rescale");
}

TEST_F(DicomRefused, GeometryThatIsMissingOrUnsound) {
  const auto one = [&](const TestDicom& file) { return refusal(write("PLANTED", file.bytes())); };
  EXPECT_EQ(one(slice(0).remove(0x00200032)), "no_geometry");
  EXPECT_EQ(one(slice(0).remove(0x00200037)), "no_geometry");
  EXPECT_EQ(one(slice(0).remove(0x00280030)), "no_geometry");
  EXPECT_EQ(one(slice(0).text(0x00200032, "DS", "1\\2")), "no_geometry");
  EXPECT_EQ(one(slice(0).text(0x00200032, "DS", "1\\2\\nan")), "no_geometry");
  EXPECT_EQ(one(slice(0).text(0x00200032, "DS", "1\\2\\PLANTED")), "no_geometry");
  EXPECT_EQ(one(slice(0).text(0x00200032, "DS", "1\\2\\1e400")), "no_geometry");
  EXPECT_EQ(one(slice(0).text(0x00280030, "DS", "0\\0.5")), "no_geometry");
  EXPECT_EQ(one(slice(0).text(0x00280030, "DS", "-0.5\\0.5")), "no_geometry");
  EXPECT_EQ(one(slice(0).lying({1, 0, 0}, {0.2, 0.97, 0})), "no_geometry");
  EXPECT_EQ(one(slice(0).lying({1, 0, 0}, {1, 0, 0})), "no_geometry");
  EXPECT_EQ(one(slice(0).lying({0, 0, 0}, {0, 0, 0})), "no_geometry");
  EXPECT_EQ(one(slice(0).lying({2, 0, 0}, {0, 2, 0})), "no_geometry");
}

TEST_F(DicomRefused, SlicesThatAreNoStack) {
  write_stack(6);
  ASSERT_EQ(refusal(folder_), "");
  write_slice(3, slice(3).lying({1, 0, 0}, {0, std::cos(0.1), std::sin(0.1)}));
  EXPECT_EQ(refusal(folder_), "mixed_orientation");
  write_slice(3, TestDicom::ct_slice({3, 4}).at({0, 0, 6}));
  EXPECT_EQ(refusal(folder_), "mixed_size");
  write_slice(3, slice(3).text(0x00280030, "DS", "0.5\\0.26"));
  EXPECT_EQ(refusal(folder_), "mixed_size");
}

TEST_F(DicomRefused, AllProblemsAreSaidAtOnce) {
  write_stack(3);
  write_slice(1, slice(1).remove(0x00200032).u16(0x00280100, "US", 32));
  write_slice(2, slice(2).text(0x00281053, "DS", "0"));
  const auto result = read(folder_);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, "no_geometry");
  EXPECT_TRUE(has_code(result.error().findings, "unknown_pixels"));
  EXPECT_TRUE(has_code(result.error().findings, "bad_rescale"));
}

TEST_F(DicomRefused, FilesThatEndTooEarly) {
  write_stack(3);
  const std::string whole = slice(1).bytes();
  for (std::size_t size = whole.size() - 1; size > 140; size -= 7) {
    write("PLANTED1", whole.substr(0, size));
    const std::string code = refusal(folder_);
    // Cut between two elements before its modality or pixels, it reads as an object without a picture; a gap is
    // left.
    EXPECT_TRUE(code == "truncated" || code == "uneven_slices" || code == "no_geometry" || code == "")
        << size << code;
    if (size + 24 >= whole.size()) {
      EXPECT_EQ(code, "truncated") << size;
    }
  }
  const std::string deflated = slice(1).bytes(TestSyntax::deflated);
  for (const std::size_t cut : {std::size_t{1}, std::size_t{5}, std::size_t{100}})
    EXPECT_EQ(refusal(write("PLANTED1", deflated.substr(0, deflated.size() - cut))), "truncated") << cut;
}

TEST_F(DicomRefused, CompressedFilesThatEndTooEarly) {
  SELDINGER_NEEDS_SHARED_DATA();
  for (const char* name : {"chest_deflated", "chest_j2k_lossless", "chest_jpegls_lossless",
                           "chest_jpeg_lossless_sv1", "chest_rle", "chest_jpeg12_lossy", "chest_explicit_le"}) {
    const std::string whole = fixtures::whole_file(shared_data(std::string("dicom-samples/") + name + ".dcm"));
    for (const double share : {0.02, 0.3, 0.5, 0.9, 0.999}) {
      const auto size = static_cast<std::size_t>(share * static_cast<double>(whole.size()));
      EXPECT_EQ(refusal(write("PLANTED.dcm", whole.substr(0, size))), "truncated") << name << " " << share;
    }
  }
}

TEST_F(DicomRefused, DestroyedPixelsAreReadOrRefusedWithoutTalk) {
  SELDINGER_NEEDS_SHARED_DATA();
  std::mt19937 random(7);
  fixtures::Outcomes outcomes;
  for (const char* name : {"chest_deflated", "chest_j2k_lossless", "chest_jpegls_lossless",
                           "chest_jpeg_lossless_sv1", "chest_rle", "chest_jpeg12_lossy"}) {
    const std::string whole = fixtures::whole_file(shared_data(std::string("dicom-samples/") + name + ".dcm"));
    for (int round = 0; round < 4; ++round) {
      std::string bytes = whole;
      for (int i = 0; i < 40; ++i) bytes[1500 + random() % (bytes.size() - 1500)] = static_cast<char>(random());
      outcomes.add(read(write("PLANTED.dcm", bytes)));  // read() fails the test when anything is printed
    }
  }
  outcomes.expect_both();
}

TEST_F(DicomRefused, RandomHeadersAreReadOrRefused) {
  std::mt19937 random(11);
  fixtures::Outcomes outcomes;
  const std::string whole = slice(0).bytes();
  for (int round = 0; round < 400; ++round) {
    std::string bytes = whole;
    for (int i = 0; i < 6; ++i) bytes[132 + random() % (bytes.size() - 132)] = static_cast<char>(random());
    outcomes.add(read(write("PLANTED.dcm", bytes)));
  }
  outcomes.expect_both();
  for (int round = 0; round < 100; ++round) {
    std::string bytes = std::string(128, '\0') + "DICM";
    for (int i = 0; i < 500; ++i) bytes.push_back(static_cast<char>(random()));
    EXPECT_NE(refusal(write("PLANTED.dcm", bytes)), "");
  }
}

}  // namespace
}  // namespace seldinger::casedb
