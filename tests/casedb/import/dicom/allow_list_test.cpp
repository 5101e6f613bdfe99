// What of a source enters a case: the table, and each of its checks against values that must not pass.
#include "casedb/import/dicom/allow_list.h"

#include <fstream>
#include <sstream>

#include "tests/casedb/import/dicom_writer.h"
#include "tests/casedb/import/import_case.h"

namespace seldinger::casedb {
namespace {

class AllowList : public ImportCase {
 protected:
  // The attribute that a file with this one value gets; "" when it does not enter.
  std::string kept(const char* name, std::uint32_t tag, const char* vr, const std::string& value) {
    const auto source = read(write("s", TestDicom::ct_slice({4, 3}).text(tag, vr, value).bytes()));
    EXPECT_TRUE(source);
    if (!source) return "refused";
    for (const auto& [one, text] : source->attributes)
      if (one == name) return text;
    return "";
  }
};

TEST_F(AllowList, HasAtMostTwentyFiveDifferentAttributes) {
  EXPECT_LE(allow_list().size(), kMostAttributes);
  EXPECT_GE(allow_list().size(), 15U);
  for (const AllowedAttribute& one : allow_list()) {
    EXPECT_TRUE(is_on_allow_list(one.tag));
    for (const AllowedAttribute& other : allow_list()) {
      EXPECT_TRUE(&one == &other || std::string(one.name) != other.name) << one.name;
      EXPECT_TRUE(&one == &other || one.tag != other.tag) << one.name;
    }
  }
  for (const std::uint32_t tag : {0x00100010U, 0x00100020U, 0x00081030U, 0x0020000DU, 0x00080080U, 0x00091001U})
    EXPECT_FALSE(is_on_allow_list(tag));
}

TEST_F(AllowList, EveryTextIsRefusedThatIsNotOfTheVocabulary) {
  for (const AllowedAttribute& one : allow_list()) {
    const bool told = std::string(one.name) == "modality" || std::string(one.name) == "contrast_agent" ||
                      std::string(one.name) == "slice_thickness_mm";
    if (told) continue;  // needed to be read at all, and told below
    for (const char* text : {"PLANTED", "Planted^Name", "19500102 PLANTED", "1950-PLANTED", "M PLANTED",
                             "B31f PLANTED", "12345678", "4.0e99", "nan", "-99", "SIEMENS PLANTED", "ORIGINA"})
      EXPECT_EQ(kept(one.name, one.tag, "LO", text), "") << one.name << " " << text;
  }
}

TEST_F(AllowList, AgesAndDatesAreCoarse) {
  const auto age = [&](const char* text) { return kept("patient_age_years", 0x00101010, "AS", text); };
  EXPECT_EQ(age("045Y"), "45");
  EXPECT_EQ(age("089Y"), "89");
  EXPECT_EQ(age("090Y"), "90+");
  EXPECT_EQ(age("107Y"), "90+");
  EXPECT_EQ(age("999Y"), "90+");
  EXPECT_EQ(age("018M"), "1");
  EXPECT_EQ(age("003W"), "0");
  EXPECT_EQ(age("020D"), "0");
  EXPECT_EQ(age("45Y"), "");
  EXPECT_EQ(age("045Z"), "");
  EXPECT_EQ(age("0x5Y"), "");
  const auto years = [&](const char* text) { return kept("study_years", 0x00080020, "DA", text); };
  EXPECT_EQ(years("20120331"), "2010-2014");
  EXPECT_EQ(years("20150101"), "2015-2019");
  EXPECT_EQ(years("20141231"), "2010-2014");
  EXPECT_EQ(years("18991231"), "");
  EXPECT_EQ(years("20121301"), "");
  EXPECT_EQ(years("2012"), "");
}

TEST_F(AllowList, KernelsAreWordsOrCodes) {
  const auto kernel = [&](const char* text) { return kept("kernel", 0x00181210, "SH", text); };
  for (const char* good :
       {"STANDARD", "BONEPLUS", "B31f", "B", "Br40d\\3", "I30f\\2", "FC08", "FC08-H", "H60s", "Qr40"})
    EXPECT_EQ(kernel(good), good);
  for (const char* bad : {"SMITH", "Bob", "B3", "B311", "Br40dx", "FC0", "FC123", "B31f B31f", "br40", "Br40d\\9",
                          "Br40d\\", "B31f\\PLANTED", "STANDARD2", "LEE", "FC08-HANS"})
    EXPECT_EQ(kernel(bad), "") << bad;
}

TEST_F(AllowList, TextBecomesTheFactThatItIsThere) {
  const auto agent = [&](const char* text) { return kept("contrast_agent", 0x00180010, "LO", text); };
  EXPECT_EQ(agent("Omnipaque 350 PLANTED"), "given");
  EXPECT_EQ(agent("NONE"), "");
  EXPECT_EQ(agent(""), "");
  EXPECT_EQ(kept("image_type", 0x00080008, "CS", "DERIVED\\SECONDARY\\AXIAL\\PLANTED"), "DERIVED SECONDARY AXIAL");
  EXPECT_EQ(kept("image_type", 0x00080008, "CS", "ORIGINAL\\PLANTED\\AXIAL"), "ORIGINAL");
  EXPECT_EQ(kept("manufacturer", 0x00080070, "LO", "SIEMENS"), "SIEMENS");
  EXPECT_EQ(kept("patient_sex", 0x00100040, "CS", "F"), "F");
  EXPECT_EQ(kept("tube_current_ma", 0x00181151, "IS", "0000250"), "250");
  EXPECT_EQ(kept("gantry_tilt_deg", 0x00181120, "DS", "-12.50"), "-12.5");
}

TEST_F(AllowList, WhatStaysOutsideIsCountedByTagAndReason) {
  for (int k = 0; k < 3; ++k)
    write(numbered("s", k), TestDicom::ct_slice({4, 3})
                                .at({0, 0, 2.0 * k})
                                .text(0x00091001, "LO", "PLANTED")
                                .text(0x00091002, "LO", "PLANTED")
                                .text(0x00181210, "SH", k == 1 ? "PLANTED" : "B31f")
                                .bytes());
  const auto source = read(folder_);
  ASSERT_TRUE(source);
  const auto count = [&](const char* tag, const char* keyword, const char* reason) {
    for (const Dropped& one : source->dropped)
      if (one.tag == tag && one.keyword == keyword && one.reason == reason) return one.count;
    return std::int64_t{0};
  };
  EXPECT_EQ(count("0010,0010", "PatientName", "not_on_the_list"), 3);
  EXPECT_EQ(count("0008,0080", "InstitutionName", "not_on_the_list"), 3);
  EXPECT_EQ(count("0009,xxxx", "", "private"), 6);
  EXPECT_EQ(count("0018,1210", "", "value_not_accepted"), 1);
  EXPECT_EQ(count("0018,0015", "", "value_not_accepted"), 3);
  EXPECT_EQ(count("0028,0010", "", "not_on_the_list"), 0) << "used";
  EXPECT_EQ(source->dropped.size(), 7U);
}

TEST_F(AllowList, FieldsOfOtherHeadersAreCountedToo) {
  const std::string voxels = little_endian(std::vector<std::int16_t>(8, 40));
  const Nifti nifti({2, 2, 2}, glm::dmat4(1.0));
  auto source = read(write("PLANTED.nii", nifti.bytes(voxels)));
  ASSERT_TRUE(source) << source.error().code;
  ASSERT_EQ(source->dropped.size(), 1U);
  EXPECT_EQ(source->dropped[0].keyword, "descrip");
  source = read(write("PLANTED.nii.gz", gzip(nifti.bytes(voxels))));
  ASSERT_TRUE(source);
  EXPECT_EQ(source->dropped.size(), 1U);
  source = read(
      write("PLANTED.nrrd",
            "NRRD0005\n# PLANTED comment\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 2 2 2\n"
            "space directions: (1,0,0) (0,1,0) (0,0,1)\nkinds: domain domain domain\nendian: little\n"
            "encoding: raw\nspace origin: (0,0,0)\ncontent: PLANTED\nPLANTED key:=PLANTED value\n\n" +
                voxels));
  ASSERT_TRUE(source) << source.error().code;
  ASSERT_EQ(source->dropped.size(), 1U);
  EXPECT_EQ(source->dropped[0].tag, "nrrd");
  EXPECT_EQ(source->dropped[0].count, 3);
  source =
      read(write("PLANTED.mha",
                 "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
                 "Comment = PLANTED\nPLANTED = 1\nTransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 0 0 0\n"
                 "ElementSpacing = 1 1 1\nDimSize = 2 2 2\nElementType = MET_SHORT\nElementDataFile = LOCAL\n" +
                     voxels));
  ASSERT_TRUE(source) << source.error().code;
  ASSERT_EQ(source->dropped.size(), 1U);
  EXPECT_EQ(source->dropped[0].tag, "metaimage");
  EXPECT_EQ(source->dropped[0].count, 2);
}

TEST_F(AllowList, TheSourcesHintOfAHeadIsPassedOn) {
  for (const auto& [part, head] :
       {std::pair("HEAD", true), {"SKULL", true}, {"ABDOMEN", false}, {"PLANTED", false}}) {
    const auto source = read(write("s", TestDicom::ct_slice({4, 3}).text(0x00180015, "CS", part).bytes()));
    ASSERT_TRUE(source);
    EXPECT_EQ(source->says_head, head) << part;
  }
}

}  // namespace
}  // namespace seldinger::casedb
