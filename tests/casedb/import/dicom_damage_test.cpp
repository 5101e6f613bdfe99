// Each kind of damage that DICOM comes with, by its name. What lies where (gaps, tilt, duplicates, directions) is
// in dicom_geometry_test, frames are in dicom_enhanced_test, size and time in dicom_bounds_test.
#include <cmath>

#include "tests/casedb/import/dicom_writer.h"
#include "tests/casedb/import/import_case.h"
#include "tests/casedb/import/packed_frame.h"
#include "tests/fixtures/shared_data.h"

namespace seldinger::casedb {
namespace {

constexpr glm::ivec2 kSize{4, 3};

class DicomDamage : public ImportCase {
 protected:
  static TestDicom slice(int k, int first_value = 0) {
    return TestDicom::ct_slice(kSize, first_value).at({0.0, 0.0, 2.0 * k});
  }
  std::string one(const TestDicom& file, TestSyntax syntax = TestSyntax::explicit_le) {
    return refusal(write("PLANTED.dcm", file.bytes(syntax)));
  }
  void write_stack(int count) {
    for (int k = 0; k < count; ++k) write(numbered("PLANTED", k) + ".dcm", slice(k, 100 * k).bytes());
  }
  // The slice's 12 values as they were put in.
  void expect_slice(const base::Result<Source>& source, int first_value = 0) {
    ASSERT_TRUE(source) << source.error().code << ' ' << source.error().text;
    ASSERT_EQ(source->volume.size_voxels, glm::ivec3(4, 3, 1));
    for (int i = 0; i < 12; ++i) EXPECT_EQ(source->volume.hu[static_cast<std::size_t>(i)], first_value + i);
  }
  base::Result<Source> one_read(const std::string& bytes) { return read(write("PLANTED.dcm", bytes)); }
};

TEST_F(DicomDamage, DuplicateInstanceNumbers) {
  for (int k = 0; k < 4; ++k)
    write(numbered("PLANTED", k), slice(3 - k, 100 * (3 - k)).text(0x00200013, "IS", "1").bytes());
  const auto source = read(folder_);
  ASSERT_TRUE(source) << source.error().text;
  for (int k = 0; k < 4; ++k) EXPECT_EQ(source->volume.at(0, 0, k), 100 * k);  // by place, never by number
}

TEST_F(DicomDamage, MixedSeries) {
  write_stack(3);
  for (int k = 0; k < 3; ++k)
    write(numbered("PLANTED_other", k), slice(k, 500).text(0x0020000E, "UI", "1.2.3.9").bytes());
  EXPECT_EQ(refusal(folder_), "several_series");
  const auto second = read(folder_, "2");
  ASSERT_TRUE(second);
  EXPECT_EQ(second->volume.at(0, 0, 2), 500);
}

TEST_F(DicomDamage, ASeriesThatCannotBeReadIsNoChoice) {
  write_stack(3);
  for (int k = 0; k < 2; ++k)
    write(numbered("PLANTED_dose", k),
          slice(k).text(0x0020000E, "UI", "1.2.3.9").text(0x00280301, "CS", "YES").bytes());
  const auto source = read(folder_);
  ASSERT_TRUE(source) << source.error().text;
  EXPECT_EQ(source->slices_used, 3);
  EXPECT_TRUE(has_code(source->warnings, "series_left_out"));
  EXPECT_EQ(refusal(folder_, "2"), "burned_in");
}

TEST_F(DicomDamage, Monochrome1KeepsItsHu) {
  const auto source = one_read(slice(0, -5).text(0x00280004, "CS", "MONOCHROME1").bytes());
  expect_slice(source, -5);
  EXPECT_TRUE(has_code(source->warnings, "monochrome1"));
}

TEST_F(DicomDamage, Rgb) {
  EXPECT_EQ(one(slice(0).u16(0x00280002, "US", 3).text(0x00280004, "CS", "RGB")), "rgb");
}

TEST_F(DicomDamage, UnknownAndUnsupportedSyntaxes) {
  for (const char* uid :
       {"1.2.840.10008.1.2.4.100", "1.2.840.10008.1.2.4.201", "1.2.840.10008.1.2.4.55", "1.2.3.4.5"})
    EXPECT_EQ(one(slice(0).fragments(uid, {std::string("\xFF\xD8\xFF\xD9", 4)})), "unknown_syntax") << uid;
}

TEST_F(DicomDamage, RescaleOfEachSliceItsOwn) {
  write("PLANTED0", slice(0).text(0x00281053, "DS", "1").text(0x00281052, "DS", "-1000").bytes());
  write("PLANTED1", slice(1).text(0x00281053, "DS", "2.5").text(0x00281052, "DS", "-1024").bytes());
  write("PLANTED2", slice(2).text(0x00281053, "DS", "-1").text(0x00281052, "DS", "10").bytes());
  const auto source = read(folder_);
  ASSERT_TRUE(source) << source.error().text;
  EXPECT_EQ(source->volume.at(2, 1, 0), 6 - 1000);
  EXPECT_EQ(source->volume.at(2, 1, 1), 15 - 1024);
  EXPECT_EQ(source->volume.at(2, 1, 2), 4);
}

TEST_F(DicomDamage, CoarseStepsAreSaid) {
  const auto source = one_read(slice(0).text(0x00281053, "DS", "16").bytes());
  ASSERT_TRUE(source);
  EXPECT_TRUE(has_code(source->warnings, "coarse_hu"));
}

TEST_F(DicomDamage, OtherQuantitiesThanHu) {
  for (const char* type : {"MGML", "Z_EFF", "ED", "EDW", "PCT", "OD"})
    EXPECT_EQ(one(slice(0).text(0x00281054, "LO", type)), "not_hu") << type;
  for (const char* type : {"US", "HU_MOD", "PLANTED"}) {
    const auto source = one_read(slice(0).text(0x00281054, "LO", type).bytes());
    ASSERT_TRUE(source) << type;
    EXPECT_TRUE(has_code(source->warnings, "not_hu"));
  }
}

TEST_F(DicomDamage, WrongVrsThatHoldTheSameThing) {
  const std::string u32("\x04\0\0\0", 4);
  expect_slice(one_read(slice(0).text(0x00280010, "IS", "3").bytes()));
  expect_slice(one_read(slice(0).raw(0x00280011, "UL", u32).bytes()));
  expect_slice(one_read(slice(0).text(0x00280030, "LO", "0.5\\0.25").text(0x00200032, "ST", "0\\0\\0").bytes()));
  expect_slice(one_read(slice(0).u16(0x00281053, "US", 1).u16(0x00281052, "SS", 0).bytes()));
  const double one_and_a_half = 1.5;
  const std::string fd(reinterpret_cast<const char*>(&one_and_a_half), 8);
  const auto source = one_read(slice(0).raw(0x00281053, "FD", fd).bytes());
  ASSERT_TRUE(source);
  EXPECT_EQ(source->volume.hu[4], 6);
  // Unknown (UN) means: as the dictionary says.
  expect_slice(one_read(slice(0).raw(0x00280010, "UN", std::string("\3\0", 2)).bytes()));
  expect_slice(one_read(slice(0).raw(0x00281053, "UN", "1 ").bytes()));
}

TEST_F(DicomDamage, WrongVrsThatHoldSomethingElse) {
  EXPECT_EQ(one(slice(0).text(0x00280010, "IS", "PLANTED ")), "bad_size");
  EXPECT_EQ(one(slice(0).text(0x00280010, "IS", "3.5 ")), "bad_size");
  EXPECT_EQ(one(slice(0).raw(0x00280010, "FD", std::string(8, '\xFF'))), "bad_size");  // NaN
  EXPECT_EQ(one(slice(0).raw(0x00281053, "FD", std::string(8, '\xFF'))), "bad_rescale");
  EXPECT_EQ(one(slice(0).raw(0x00280030, "OB", std::string(4, '\1'))), "no_geometry");
}

TEST_F(DicomDamage, AVrThatIsMissingInOneElement) {
  // Implicit among explicit elements, as some writers leave private or nested ones.
  const std::string implicit(
      "\x28\0\x51\x10\x04\0\0\0"
      "40\\5",
      12);
  expect_slice(one_read(slice(0).bytes(TestSyntax::explicit_le, implicit)));
  const std::string lying(
      "\x28\0\x51\x10\x04\0\0\x7F"
      "40\\5",
      12);
  EXPECT_EQ(refusal(write("PLANTED.dcm", slice(0).bytes(TestSyntax::explicit_le, lying))), "truncated");
}

TEST_F(DicomDamage, ASyntaxThatIsNotTheOneItNames) {
  auto source = one_read(dicom_head("1.2.840.10008.1.2.1") + slice(0).data_set(false, false));
  expect_slice(source);
  EXPECT_TRUE(has_code(source->warnings, "wrong_syntax"));
  source = one_read(dicom_head("1.2.840.10008.1.2") + slice(0).data_set(true, false));
  expect_slice(source);
  EXPECT_TRUE(has_code(source->warnings, "wrong_syntax"));
  EXPECT_FALSE(has_code(one_read(slice(0).bytes(TestSyntax::implicit_le))->warnings, "wrong_syntax"));
}

TEST_F(DicomDamage, AMetaGroupWithoutItsLength) {
  expect_slice(one_read(dicom_head("1.2.840.10008.1.2.1", false) + slice(0).data_set(true, false)));
  expect_slice(one_read(dicom_head("1.2.840.10008.1.2", false) + slice(0).data_set(false, false)));
}

TEST_F(DicomDamage, AMetaGroupWhoseLengthLies) {
  std::string head = dicom_head("1.2.840.10008.1.2.1");
  head[140] = '\x7F';
  expect_slice(one_read(head + slice(0).data_set(true, false)));
}

TEST_F(DicomDamage, OddLengths) {
  expect_slice(one_read(slice(0).raw(0x00281053, "DS", "1").raw(0x00081090, "LO", "odd").bytes()));
  expect_slice(one_read(slice(0).raw(0x00281053, "DS", "1").bytes(TestSyntax::implicit_le)));
  // 8-bit pixels of an odd count, without the byte that should fill them up.
  TestDicom file = TestDicom::ct_slice({3, 1});
  file.u16(0x00280100, "US", 8).u16(0x00280101, "US", 8).u16(0x00280102, "US", 7).u16(0x00280103, "US", 0);
  const auto source = one_read(file.raw(0x7FE00010, "OB", std::string("\1\2\xFF", 3)).bytes());
  ASSERT_TRUE(source) << source.error().text;
  EXPECT_EQ(source->volume.hu, (std::vector<std::int16_t>{1, 2, 255}));
  EXPECT_EQ(one(TestDicom(file).raw(0x7FE00010, "OB", std::string("\1\2", 2))), "truncated");
}

TEST_F(DicomDamage, PrivateCreatorsThatCollide) {
  TestDicom file = slice(0);
  file.text(0x00290010, "LO", "PLANTED A").text(0x00290011, "LO", "PLANTED A").text(0x00290012, "LO", "PLANTED B");
  file.raw(0x00291010, "UN", "x ")
      .raw(0x00291110, "OB", "y ")
      .text(0x00291210, "LO", "z")
      .raw(0x00293310, "UN", "n ");
  file.u16(0x00290028, "US", 99).raw(0x00291130, "SQ", "");
  expect_slice(one_read(file.bytes()));
  expect_slice(one_read(file.bytes(TestSyntax::implicit_le)));
}

TEST_F(DicomDamage, UndefinedLengthNesting100Deep) {
  TestDicom nested = TestDicom().u16(0x00280010, "US", 99);
  for (int i = 0; i < 100; ++i) nested = TestDicom().sequence(0x00081140, {nested}, true);
  TestDicom file = slice(0);
  file.sequence(0x00081115, {nested}, true);
  expect_slice(one_read(file.bytes()));
  expect_slice(one_read(file.bytes(TestSyntax::implicit_le)));
  expect_slice(one_read(file.bytes(TestSyntax::explicit_be)));
}

TEST_F(DicomDamage, LengthsWithinSequencesThatLie) {
  const std::string item("\xFE\xFF\x00\xE0\xF0\x00\x00\x00", 8);
  TestDicom file = slice(0);
  file.raw(0x52009230, "SQ", item);  // an item longer than its sequence
  EXPECT_EQ(one(file), "damaged");
  file.raw(0x52009230, "SQ", std::string("\x20\0\x13\x91SQ\0\0\x08\0\0\0", 12));  // no item
  EXPECT_EQ(one(file), "damaged");
}

TEST_F(DicomDamage, TruncatedPixelData) {
  write_stack(3);
  const std::string whole = slice(1).bytes();
  write("PLANTED1.dcm", whole.substr(0, whole.size() - 1));
  EXPECT_EQ(refusal(folder_), "truncated");
  EXPECT_EQ(one(slice(1).pixels(std::vector<int>(11, 0))), "truncated");
}

TEST_F(DicomDamage, Rows65535) {
  EXPECT_EQ(one(slice(0).u16(0x00280010, "US", 65535)), "bad_size");
  EXPECT_EQ(one(slice(0).u16(0x00280010, "US", 65535).u16(0x00280011, "US", 65535)), "bad_size");
}

TEST_F(DicomDamage, ZeroSlices) {
  EXPECT_EQ(refusal(folder_), "empty_folder");
  write("PLANTED.dcm", slice(0).text(0x00080008, "CS", "ORIGINAL\\PRIMARY\\LOCALIZER").bytes());
  EXPECT_EQ(refusal(folder_), "localizer");
}

TEST_F(DicomDamage, BurnedInAnnotation) {
  EXPECT_EQ(one(slice(0).text(0x00280301, "CS", "YES")), "burned_in");
  EXPECT_EQ(one(slice(0).text(0x00280301, "CS", "NO")), "");
}

TEST_F(DicomDamage, ObjectsThatSayTheyAreCtAndAreNot) {
  const std::string storage = "1.2.840.10008.5.1.4.1.1.";
  const auto as = [&](const char* number) { return slice(0).text(0x00080016, "UI", storage + number); };
  EXPECT_EQ(one(as("7")), "secondary_capture");
  EXPECT_EQ(one(as("7.3")), "secondary_capture");
  EXPECT_EQ(one(as("30").remove(0x7FE00010).raw(0x7FE00008, "OF", std::string(48, '\0'))), "parametric_map");
  EXPECT_EQ(one(as("104.1").remove(0x7FE00010).raw(0x00420011, "OB", "%PDF-1.4 PLANTED")), "encapsulated_document");
  EXPECT_EQ(one(as("66.4")), "not_ct");
  EXPECT_EQ(one(as("2.2").remove(0x00280008)), "multi_frame");
}

TEST_F(DicomDamage, DerivedPicturesThatAreNoCtVolume) {
  for (const char* type :
       {"DERIVED\\SECONDARY\\MIP", "DERIVED\\PRIMARY\\AXIAL\\CT_SOM5 MIP", "DERIVED\\SECONDARY\\OTHER\\VRT",
        "DERIVED\\SECONDARY\\AXIAL\\SSD", "DERIVED\\SECONDARY\\AXIAL\\CBF"})
    EXPECT_EQ(one(slice(0).text(0x00080008, "CS", type)), "derived") << type;
  for (const char* type : {"DERIVED\\SECONDARY\\REFORMATTED\\AVERAGE", "DERIVED\\SECONDARY\\MPR",
                           "ORIGINAL\\PRIMARY\\AXIAL\\CT_SOM5 SPI"})
    EXPECT_EQ(one(slice(0).text(0x00080008, "CS", type)), "") << type;
}

TEST_F(DicomDamage, LossAboveEightToOneIsRefused) {
  SELDINGER_NEEDS_SHARED_DATA();
  const auto declared = [&](const char* ratio) {
    return one(slice(0).text(0x00282110, "CS", "01").text(0x00282112, "DS", ratio));
  };
  EXPECT_EQ(declared("8"), "");
  EXPECT_EQ(declared("2\\8.5"), "lossy");
  EXPECT_EQ(declared(""), "");
  const auto source = one_read(slice(0).text(0x00282110, "CS", "01").bytes());
  ASSERT_TRUE(source);
  EXPECT_TRUE(has_code(source->warnings, "lossy"));
  // What is packed smaller than it says counts by its size.
  std::string sample = fixtures::whole_file(shared_data("dicom-samples/chest_jpeg12_lossy.dcm"));
  const std::size_t begin = sample.find("\xFF\xD8\xFF"), end = sample.rfind("\xFF\xD9") + 2;
  const std::string frame = sample.substr(begin, end - begin);
  EXPECT_EQ(one(TestDicom::ct_slice({512, 512}).fragments("1.2.840.10008.1.2.4.51", {frame})), "");
  TestDicom wide = TestDicom::ct_slice({512, 800});
  EXPECT_EQ(one(wide.fragments("1.2.840.10008.1.2.4.51", {frame})), "lossy");
}

TEST_F(DicomDamage, LossUnderTheNameOfNoLossIsRefused) {
  SELDINGER_NEEDS_SHARED_DATA();
  const std::string sample = fixtures::whole_file(shared_data("dicom-samples/chest_jpeg12_lossy.dcm"));
  const std::size_t begin = sample.find("\xFF\xD8\xFF"), end = sample.rfind("\xFF\xD9") + 2;
  TestDicom file = TestDicom::ct_slice({512, 512});
  EXPECT_EQ(one(file.fragments("1.2.840.10008.1.2.4.70", {sample.substr(begin, end - begin)})), "lossy");
  constexpr glm::ivec2 kPacked{16, 12};
  std::string frame = packed_frame("1.2.840.10008.1.2.4.80", kPacked, std::vector<int>(16 * 12, 7));
  file = TestDicom::ct_slice(kPacked);
  EXPECT_EQ(one(file.fragments("1.2.840.10008.1.2.4.80", {frame})), "");
  frame[frame.find("\xFF\xDA") + 7] = 2;  // NEAR
  EXPECT_EQ(one(file.fragments("1.2.840.10008.1.2.4.80", {frame})), "lossy");
  frame = packed_frame("1.2.840.10008.1.2.4.90", kPacked, std::vector<int>(16 * 12, 7));
  frame[frame.find("\xFF\x52") + 13] = 0;  // the 9-7 wavelet
  EXPECT_EQ(one(file.fragments("1.2.840.10008.1.2.4.90", {frame})), "lossy");
}

TEST_F(DicomDamage, NotDicomWithADcmName) {
  EXPECT_EQ(refusal(write("PLANTED.dcm", "a letter")), "damaged");
  write_stack(3);
  const auto source = read(folder_);
  ASSERT_TRUE(source) << source.error().text;
  EXPECT_EQ(source->slices_used, 3);
  EXPECT_TRUE(has_code(source->warnings, "not_dicom"));
  // Empty or zeros: more likely a slice that was not copied.
  write("PLANTED.dcm", "");
  EXPECT_EQ(refusal(folder_), "damaged");
  write("PLANTED.dcm", std::string(100, '\0'));
  EXPECT_EQ(refusal(folder_), "damaged");
}

TEST_F(DicomDamage, AFolderWithAnythingInIt) {
  for (int k = 0; k < 4; ++k) write(numbered("series/deep/PLANTED", k), slice(k, 100 * k).bytes());
  write("PLANTED.txt", "notes");
  write("PLANTED.pdf", "%PDF-1.4 PLANTED");
  write("PLANTED.zip", std::string("PK\3\4", 4) + "PLANTED");
  write("viewer/run.exe", std::string("MZ\0\0", 4));
  write("series/deep/thumbs.dcm", "PLANTED");
  write("sr.dcm", slice(0).text(0x00080060, "CS", "SR").remove(0x7FE00010).bytes());
  write("scout.dcm", slice(0).text(0x00080008, "CS", "ORIGINAL\\PRIMARY\\LOCALIZER").bytes());
  TestDicom directory;
  directory.text(0x00041130, "CS", "PLANTED");
  directory.sequence(0x00041220,
                     {TestDicom().text(0x00041500, "CS", "..\\..\\PLANTED").text(0x00100010, "PN", "PLANTED")});
  write("DICOMDIR", dicom_head("1.2.840.10008.1.2.1") + directory.data_set(true, false));
  std::filesystem::create_symlink("series/deep/PLANTED0", folder_ / "link");
  std::filesystem::create_symlink("/etc/hostname", folder_ / "elsewhere.dcm");
  std::filesystem::create_directory_symlink("..", folder_ / "series/up");
  std::filesystem::create_directories(folder_ / "empty");
  const auto source = read(folder_);
  ASSERT_TRUE(source) << source.error().text;
  EXPECT_EQ(source->slices_used, 4);
  for (int k = 0; k < 4; ++k) EXPECT_EQ(source->volume.at(0, 0, k), 100 * k);
  EXPECT_TRUE(has_code(source->warnings, "left_out"));
}

TEST_F(DicomDamage, ADicomdirIsNotFollowed) {
  // It names a file outside the folder, which is a slice.
  const auto outside = write("PLANTED_outside/slice", slice(0).bytes());
  TestDicom directory;
  directory.text(0x00041130, "CS", "PLANTED");
  directory.sequence(0x00041220, {TestDicom().text(0x00041500, "CS", "..\\PLANTED_outside\\slice")});
  std::string head = dicom_head("1.2.840.10008.1.2.1", false);
  const std::string uid(
      "\2\0\2\0UI\x14\0"
      "1.2.840.10008.1.3.10",
      28);
  head.insert(132, uid);
  write("inside/DICOMDIR", head + directory.data_set(true, false));
  EXPECT_EQ(refusal(folder_ / "inside"), "dicomdir");
  EXPECT_EQ(refusal(folder_ / "inside/DICOMDIR"), "dicomdir");
  EXPECT_EQ(refusal(folder_ / "inside/../PLANTED_outside"), "");  // a path with ..
  EXPECT_EQ(refusal(outside.parent_path() / ".." / "inside"), "dicomdir");
}

TEST_F(DicomDamage, NamesThatAreNoPaths) {
  // Series, frames and files are found by what they hold; a name in it is never opened.
  TestDicom file = slice(0);
  file.text(0x00081155, "UI", "../../etc/passwd").text(0x00041500, "CS", "/etc/passwd");
  expect_slice(one_read(file.bytes()));
  EXPECT_EQ(refusal(folder_, "../1"), "no_series");
}

}  // namespace
}  // namespace seldinger::casedb
