// DICOM series written by hand are read with the geometry and values put in, whatever their order, names and
// syntax.
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "tests/casedb/import/dicom_writer.h"
#include "tests/casedb/import/import_case.h"

namespace seldinger::casedb {
namespace {

class DicomSeries : public ImportCase {};

constexpr glm::ivec2 kSize{4, 3};

TEST_F(DicomSeries, VoxelsStandWhereThePositionsSay) {
  // Written in a shuffled order under names that say another one.
  const int order[] = {3, 0, 4, 1, 2};
  for (const int k : order)
    write(numbered("f", 9 - k), TestDicom::ct_slice(kSize, 100 * k).at({-10.0, 20.0, -7.5 + 2.5 * k}).bytes());
  const auto source = read(folder_);
  ASSERT_TRUE(source);
  EXPECT_EQ(source->volume.size_voxels, glm::ivec3(4, 3, 5));
  EXPECT_EQ(source->slices_used, 5);
  // Pixel spacing is stored as down, across: 0.5 from row to row, 0.25 from column to column.
  const glm::dmat4 expected({0.25, 0, 0, 0}, {0, 0.5, 0, 0}, {0, 0, 2.5, 0}, {-10.0, 20.0, -7.5, 1.0});
  EXPECT_LT(largest_difference(source->volume.lps_from_voxel, expected), 1e-12);
  for (int k = 0; k < 5; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 4; ++i) EXPECT_EQ(source->volume.at(i, j, k), 100 * k + 4 * j + i);
}

TEST_F(DicomSeries, AnObliqueSeriesKeepsItsAxes) {
  const glm::dvec3 row = glm::normalize(glm::dvec3(0.8, 0.6, 0.1));
  const glm::dvec3 column = glm::normalize(glm::cross(glm::normalize(glm::dvec3(-0.2, 0.1, 0.97)), row));
  const glm::dvec3 normal = glm::cross(row, column), origin(5.0, -6.0, 7.0);
  for (int k = 0; k < 4; ++k)
    write(numbered("s", k),
          TestDicom::ct_slice(kSize, 10 * k).lying(row, column).at(origin + 3.0 * k * normal).bytes());
  const auto source = read(folder_);
  ASSERT_TRUE(source) << source.error().text;
  const glm::dmat4 expected(glm::dvec4(0.25 * row, 0), glm::dvec4(0.5 * column, 0), glm::dvec4(3.0 * normal, 0),
                            glm::dvec4(origin, 1));
  EXPECT_LT(largest_difference(source->volume.lps_from_voxel, expected), 1e-7);  // 10 digits are written
  EXPECT_GT(glm::determinant(glm::dmat3(source->volume.lps_from_voxel)), 0.0);
  EXPECT_EQ(source->volume.at(1, 0, 3), 31);
}

TEST_F(DicomSeries, AMirroredRowOrderComesOutRightHanded) {
  // Rows run to the patient's right: the normal, and with it the order of slices, points to the feet.
  for (int k = 0; k < 3; ++k)
    write(numbered("s", k),
          TestDicom::ct_slice(kSize, 10 * k).lying({-1, 0, 0}, {0, 1, 0}).at({0.0, 0.0, 2.0 * k}).bytes());
  const auto source = read(folder_);
  ASSERT_TRUE(source);
  EXPECT_GT(glm::determinant(glm::dmat3(source->volume.lps_from_voxel)), 0.0);
  EXPECT_EQ(source->volume.at(0, 0, 0), 20);  // the uppermost slice is first
  EXPECT_NEAR(source->volume.lps_from_voxel[3].z, 4.0, 1e-12);
}

TEST_F(DicomSeries, EverySyntaxGivesTheSameValues) {
  for (const TestSyntax syntax :
       {TestSyntax::implicit_le, TestSyntax::explicit_le, TestSyntax::explicit_be, TestSyntax::deflated}) {
    const auto file = write("slice", TestDicom::ct_slice(kSize, -5).bytes(syntax));
    const auto source = read(file);
    ASSERT_TRUE(source) << static_cast<int>(syntax) << source.error().code;
    for (int i = 0; i < 12; ++i) EXPECT_EQ(source->volume.hu[static_cast<std::size_t>(i)], i - 5);
  }
}

TEST_F(DicomSeries, ABareDataSetWithoutPreambleIsRead) {
  const std::string whole = TestDicom::ct_slice(kSize).bytes(TestSyntax::implicit_le);
  const std::size_t data = whole.find(std::string("\x08\0\x08\0", 4));
  const auto source = read(write("bare", whole.substr(data)));
  ASSERT_TRUE(source);
  EXPECT_EQ(source->volume.at(3, 2, 0), 11);
  const auto with_meta = read(write("meta", whole.substr(132)));
  ASSERT_TRUE(with_meta);
  EXPECT_EQ(with_meta->volume.hu, source->volume.hu);
}

TEST_F(DicomSeries, ValuesAreRescaledRoundedAndClamped) {
  const auto file = write("s", TestDicom::ct_slice(kSize)
                                   .pixels({0, 1, 2, 3, -2000, 32767, 7, 8, 9, 10, 11, 12})
                                   .text(0x00281053, "DS", "1.3")
                                   .text(0x00281052, "DS", "-0.25")
                                   .bytes());
  const auto source = read(file);
  ASSERT_TRUE(source);
  const auto& hu = source->volume.hu;
  EXPECT_EQ(hu[0], 0);      // −0.25
  EXPECT_EQ(hu[1], 1);      // 1.05
  EXPECT_EQ(hu[2], 2);      // 2.35
  EXPECT_EQ(hu[3], 4);      // 3.65
  EXPECT_EQ(hu[4], -1024);  // −2600.25
  EXPECT_EQ(hu[5], 32767);  // 42596.85
}

TEST_F(DicomSeries, BitsAboveTheStoredOnesAreNoPartOfTheValue) {
  const auto file = write("s", TestDicom::ct_slice(kSize)
                                   .u16(0x00280101, "US", 12)
                                   .u16(0x00280102, "US", 11)
                                   .pixels({0xF001, 0x0FFF, 0x0800, 0x07FF, 4, 5, 6, 7, 8, 9, 10, 11})
                                   .bytes());
  const auto source = read(file);
  ASSERT_TRUE(source);
  EXPECT_EQ(source->volume.hu[0], 1);
  EXPECT_EQ(source->volume.hu[1], -1);
  EXPECT_EQ(source->volume.hu[2], -1024);  // −2048
  EXPECT_EQ(source->volume.hu[3], 2047);
}

TEST_F(DicomSeries, UnsignedPixelsKeepTheirUpperHalf) {
  const auto file = write("s", TestDicom::ct_slice(kSize)
                                   .u16(0x00280103, "US", 0)
                                   .text(0x00281052, "DS", "-32768")
                                   .pixels({0x8000, 0x8001, 0xFFFF, 0, 4, 5, 6, 7, 8, 9, 10, 11})
                                   .bytes());
  const auto source = read(file);
  ASSERT_TRUE(source);
  EXPECT_EQ(source->volume.hu[0], 0);
  EXPECT_EQ(source->volume.hu[1], 1);
  EXPECT_EQ(source->volume.hu[2], 32767);
  EXPECT_EQ(source->volume.hu[3], -1024);
}

TEST_F(DicomSeries, PaddingBecomesAirOnStoredValues) {
  // The intercept would make the padding value 100 an ordinary 1100 HU.
  TestDicom file = TestDicom::ct_slice(kSize, 95).text(0x00281052, "DS", "1000").u16(0x00280120, "SS", 100);
  auto source = read(write("one", file.bytes()));
  ASSERT_TRUE(source);
  EXPECT_EQ(source->volume.hu[4], 1099);
  EXPECT_EQ(source->volume.hu[5], -1024);
  EXPECT_EQ(source->volume.hu[6], 1101);
  source = read(write("range", file.u16(0x00280121, "SS", 102).bytes(TestSyntax::explicit_be)));
  ASSERT_TRUE(source);
  EXPECT_EQ(source->volume.hu[4], 1099);
  for (std::size_t i = 5; i <= 7; ++i) EXPECT_EQ(source->volume.hu[i], -1024);
  EXPECT_EQ(source->volume.hu[8], 1103);
}

TEST_F(DicomSeries, OneSliceIsACaseWithAWarning) {
  const auto source = read(write("s", TestDicom::ct_slice(kSize).bytes()));
  ASSERT_TRUE(source);
  EXPECT_TRUE(has_code(source->warnings, "single_slice"));
  EXPECT_NEAR(source->volume.spacing_mm.z, 2.5, 1e-12);  // the slice's thickness
}

TEST_F(DicomSeries, AttributesAreOfTheAllowListOnly) {
  auto source = read(write("s", TestDicom::ct_slice(kSize).bytes()));
  ASSERT_TRUE(source);
  const std::vector<std::pair<std::string, std::string>> expected = {{"modality", "CT"},
                                                                     {"image_type", "ORIGINAL PRIMARY AXIAL"},
                                                                     {"slice_thickness_mm", "2.5"},
                                                                     {"tube_voltage_kv", "120"},
                                                                     {"patient_position", "HFS"}};
  EXPECT_EQ(source->attributes, expected);  // the body part is free text here
  source = read(write("s", TestDicom::ct_slice(kSize)
                               .text(0x00180015, "CS", "ABDOMEN")
                               .text(0x00180060, "DS", "PLANTED")
                               .text(0x00185100, "CS", "PLANTED")
                               .bytes()));
  ASSERT_TRUE(source);
  const std::vector<std::pair<std::string, std::string>> fewer = {{"modality", "CT"},
                                                                  {"image_type", "ORIGINAL PRIMARY AXIAL"},
                                                                  {"body_part_examined", "ABDOMEN"},
                                                                  {"slice_thickness_mm", "2.5"}};
  EXPECT_EQ(source->attributes, fewer);
}

TEST_F(DicomSeries, OneOfSeveralSeriesIsChosenByNumberOrUid) {
  for (int k = 0; k < 3; ++k) write(numbered("a", k), TestDicom::ct_slice(kSize, 100).at({0, 0, 2.0 * k}).bytes());
  for (int k = 0; k < 2; ++k)
    write(numbered("b", k), TestDicom::ct_slice(kSize, 200)
                                .at({0, 0, 2.0 * k})
                                .text(0x0020000E, "UI", "1.2.3.5")
                                .text(0x00200011, "IS", "2")
                                .bytes());
  const auto several = read(folder_);
  ASSERT_FALSE(several);
  EXPECT_EQ(several.error().code, "several_series");
  ASSERT_EQ(several.error().findings.size(), 2U);
  EXPECT_EQ(several.error().findings[0].text,
            "1: CT, 2 slices of 4 x 3, 2.5 mm thick");  // series number 2 before 7
  EXPECT_EQ(several.error().findings[1].text, "2: CT, 3 slices of 4 x 3, 2.5 mm thick");
  const auto first = read(folder_, "1"), second = read(folder_, "2"), by_uid = read(folder_, "1.2.3.5");
  ASSERT_TRUE(first && second && by_uid);
  EXPECT_EQ(first->volume.at(0, 0, 0), 200);
  EXPECT_EQ(second->volume.at(0, 0, 0), 100);
  EXPECT_EQ(by_uid->volume.hu, first->volume.hu);
  for (const char* wrong : {"0", "3", "-1", "1.2.3.6", "", "PLANTED"})
    EXPECT_EQ(refusal(folder_, wrong), "no_series");
}

TEST_F(DicomSeries, OtherFilesBesideASeriesAreLeftOut) {
  for (int k = 0; k < 3; ++k)
    write(numbered("deep/er/s", k), TestDicom::ct_slice(kSize).at({0, 0, 2.0 * k}).bytes());
  write("README.txt", "PLANTED notes");
  write("report", TestDicom::ct_slice(kSize).text(0x00080060, "CS", "SR").remove(0x7FE00010).bytes());
  write("scout", TestDicom::ct_slice(kSize).text(0x00080008, "CS", "ORIGINAL\\PRIMARY\\LOCALIZER").bytes());
  std::filesystem::create_symlink("deep/er/s0", folder_ / "link.dcm");  // would be a duplicate
  std::filesystem::create_directory_symlink("deep", folder_ / "loop");
  const auto source = read(folder_);
  ASSERT_TRUE(source) << source.error().text;
  EXPECT_EQ(source->slices_used, 3);
  EXPECT_TRUE(has_code(source->warnings, "left_out"));
}

TEST_F(DicomSeries, NestedSequencesBeforeThePixelsArePassedOver) {
  const std::string item("\xFE\xFF\x00\xE0\xFF\xFF\xFF\xFF", 8), item_end("\xFE\xFF\x0D\xE0\0\0\0\0", 8),
      end("\xFE\xFF\xDD\xE0\0\0\0\0", 8), open("\x40\0\x60\xA1SQ\0\0\xFF\xFF\xFF\xFF", 12);
  const auto nested = [&](int depth) {
    std::string all;
    for (int i = 0; i < depth; ++i) all += open + item;
    all += std::string("\x28\0\x10\0US\x02\0\x63\0", 10);  // a Rows of 99 that is not the picture's
    for (int i = 0; i < depth; ++i) all += item_end + end;
    return all;
  };
  const TestDicom file = TestDicom::ct_slice(kSize);
  const auto source = read(write("s", file.bytes(TestSyntax::explicit_le, nested(100))));
  ASSERT_TRUE(source) << source.error().code;
  EXPECT_EQ(source->volume.size_voxels, glm::ivec3(4, 3, 1));
  EXPECT_EQ(refusal(write("s", file.bytes(TestSyntax::explicit_le, nested(100000)))), "damaged");
}

TEST_F(DicomSeries, PositionsWrittenWithTwoDecimalsAreEven) {
  const double written_mm[] = {0.0, 0.63, 1.25, 1.88, 2.5, 3.13};  // 0.625 apart
  for (int k = 0; k < 6; ++k) write(numbered("s", k), TestDicom::ct_slice(kSize).at({0, 0, written_mm[k]}).bytes());
  const auto source = read(folder_);
  ASSERT_TRUE(source);
  EXPECT_NEAR(source->volume.spacing_mm.z, 3.13 / 5, 1e-12);
}

}  // namespace
}  // namespace seldinger::casedb
