// Slices of several patients or studies under one series are refused, with where they lie and without who they are.
#include "tests/casedb/import/dicom_writer.h"
#include "tests/casedb/import/import_case.h"

namespace seldinger::casedb {
namespace {

constexpr std::uint32_t kName = 0x00100010, kPatientId = 0x00100020, kBirthDate = 0x00100030, kSex = 0x00100040,
                        kStudy = 0x0020000D, kSeries = 0x0020000E;

class DicomIdentity : public ImportCase {
 protected:
  static TestDicom slice(int k) {
    return TestDicom::ct_slice({4, 3})
        .at({0.0, 0.0, 2.0 * k})
        .text(kBirthDate, "DA", "19500102")
        .text(kSex, "CS", "F")
        .text(kStudy, "UI", "1.2.3.77");
  }
  void write_slice(int k, const TestDicom& file) { write(numbered("s", k), file.bytes()); }
  void write_stack(int count) {
    for (int k = 0; k < count; ++k) write_slice(k, slice(k));
  }
  base::Error refused() {
    const auto source = read(folder_);
    EXPECT_FALSE(source);
    return source ? base::Error{} : source.error();
  }
};

TEST_F(DicomIdentity, OnePatientOfOneStudyIsRead) {
  write_stack(6);
  EXPECT_EQ(refusal(folder_), "");
  // Names as PS3.5 lets them be written: in other case, with empty components, padded; a date as ACR-NEMA had it.
  write_slice(2, slice(2).text(kName, "PN", "planted^name^^^ ").text(kBirthDate, "DA", "1950.01.02"));
  EXPECT_EQ(refusal(folder_), "");
}

TEST_F(DicomIdentity, OfTwoPatientIdsOneSeriesIsRefusedWithThePositions) {
  write_stack(6);
  write_slice(3, slice(3).text(kPatientId, "LO", "PLANTED2"));
  write_slice(4, slice(4).text(kPatientId, "LO", "PLANTED2"));
  const auto error = refused();
  EXPECT_EQ(error.code, "mixed_patients");
  EXPECT_EQ(error.text,
            "the slices of the series are not all of one patient (patient ID): "
            "4 at 0 to 4, 10 mm; 2 at 6 to 8 mm, along the stack");
  EXPECT_TRUE(error.findings.empty());
}

TEST_F(DicomIdentity, EachOfTheIdentifiersIsCompared) {
  const std::tuple<std::uint32_t, const char*, const char*, const char*> others[] = {
      {kPatientId, "LO", "PLANTED2", "mixed_patients"},
      {kName, "PN", "PLANTED^OTHER", "mixed_patients"},
      {kBirthDate, "DA", "19500103", "mixed_patients"},
      {kSex, "CS", "M", "mixed_patients"},
      {kStudy, "UI", "1.2.3.78", "mixed_studies"}};
  for (const auto& [tag, vr, value, code] : others) {
    write_stack(4);
    write_slice(2, slice(2).text(tag, vr, value));
    EXPECT_EQ(refused().code, code) << tag;
    write_slice(2, slice(2).text(tag, vr, ""));  // nobody knows whether it is hers
    EXPECT_EQ(refused().code, code) << tag;
    write_slice(2, slice(2).remove(tag));
    EXPECT_EQ(refused().code, code) << tag;
  }
}

TEST_F(DicomIdentity, PatientsAreToldApartAlsoWhereTheSeriesHasNoUid) {
  for (int k = 0; k < 6; ++k) {
    TestDicom file = slice(k).text(kStudy, "UI", "").text(kSeries, "UI", "");
    if (k % 2 == 1) file.text(kPatientId, "LO", "PLANTED2").text(kName, "PN", "PLANTED^OTHER");
    write_slice(k, file);
  }
  const auto error = refused();
  EXPECT_EQ(error.code, "mixed_patients");
  EXPECT_EQ(error.text,
            "the slices of the series are not all of one patient (patient ID, name): "
            "3 at 0, 4, 8 mm; 3 at 2, 6, 10 mm, along the stack");
}

// A folder of two patients whose slices interleave had been one volume without a word.
TEST_F(DicomIdentity, PatientAndStudyAreBothSaidBesideOtherProblems) {
  write_stack(4);
  write_slice(1, slice(1).text(kPatientId, "LO", "PLANTED2").text(kStudy, "UI", "1.2.3.78").remove(0x00200032));
  const auto error = refused();
  EXPECT_EQ(error.code, "mixed_patients");
  EXPECT_NE(error.text.find("(patient ID): 3 at 0 to 6 mm; 1 without a sound place"), std::string::npos)
      << error.text;
  EXPECT_TRUE(has_code(error.findings, "mixed_studies"));
  EXPECT_TRUE(has_code(error.findings, "no_geometry"));
}

TEST_F(DicomIdentity, ASeriesOfNobodyIsRead) {
  for (int k = 0; k < 3; ++k) {
    TestDicom file = slice(k);
    for (const std::uint32_t tag : {kPatientId, kName, kBirthDate, kSex, kStudy}) file.remove(tag);
    write_slice(k, file);
  }
  EXPECT_EQ(refusal(folder_), "");
}

// Two series of two patients stay two: one of them is chosen, as before.
TEST_F(DicomIdentity, TwoSeriesOfTwoPatientsAreChosenBetween) {
  write_stack(3);
  for (int k = 3; k < 6; ++k)
    write_slice(k, slice(k).text(kPatientId, "LO", "PLANTED2").text(kSeries, "UI", "1.2.3.5"));
  EXPECT_EQ(refusal(folder_), "several_series");
  EXPECT_EQ(refusal(folder_, "2"), "");
}

}  // namespace
}  // namespace seldinger::casedb
