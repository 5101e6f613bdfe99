// What `import` makes of sources that are no CT to practise on: the stated rules hold on files, and what explains a
// refusal comes first.
#include "app/cases/import_case.h"

#include "tests/casedb/import/dicom_writer.h"
#include "tests/casedb/import/head_phantom.h"
#include "tests/casedb/import/import_case.h"

namespace seldinger::app {
namespace {

using casedb::TestDicom;

class ImportRefusals : public casedb::ImportCase {
 protected:
  base::Result<casedb::NewCase> import(const std::filesystem::path& source) {
    return import_case(source, {}, "Case", "import");
  }
  std::string code(const std::filesystem::path& source) {
    const auto made = import(source);
    return made ? "" : made.error().code;
  }
  // Slices of a volume whose stored values are HU + 1024, as scanners write them.
  void write_slices(const volume::Volume& volume, const std::function<bool(int slice)>& with_rescale) const {
    const glm::ivec3 size = volume.size_voxels;
    for (int k = 0; k < size.z; ++k) {
      std::vector<int> stored;
      for (int j = 0; j < size.y; ++j)
        for (int i = 0; i < size.x; ++i) stored.push_back(volume.at(i, j, k) + 1024);
      TestDicom file = TestDicom::ct_slice({size.x, size.y});
      file.pixels(stored)
          .at(glm::dvec3(volume.lps_from_voxel * glm::dvec4(0, 0, k, 1)))
          .text(0x00280030, "DS", "2.5\\2.5")
          .text(0x00180050, "DS", "3")
          .text(0x00281052, "DS", "-1024");
      if (!with_rescale(k)) file.remove(0x00281052).remove(0x00281053);
      write(casedb::numbered("series/s", k), file.bytes());
    }
  }
};

// A ball of tissue in air, so large that it has a skin, of any voxel.
template <typename T>
std::string ball_of(const std::function<T(bool inside, int i)>& value) {
  std::string bytes;
  for (int k = 0; k < 20; ++k)
    for (int j = 0; j < 20; ++j)
      for (int i = 0; i < 20; ++i) {
        const bool inside = (i - 10) * (i - 10) + (j - 10) * (j - 10) + (k - 10) * (k - 10) < 49;
        const T one = value(inside, i);
        bytes.append(reinterpret_cast<const char*>(&one), sizeof one);
      }
  return bytes;
}

std::string ball_header(const char* type, const char* spacing) {
  return std::string("ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n") +
         "TransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 0 0 0\nElementSpacing = " + spacing +
         "\nDimSize = 20 20 20\nElementType = " + type + "\nElementDataFile = LOCAL\n";
}

TEST_F(ImportRefusals, FloatsFromZeroToOneAndVolumesOfOneValueAreRefused) {
  const std::string header = ball_header("MET_FLOAT", "5 5 5");
  const auto floats = [&](float inside, float outside, float step) {
    return code(write("f.mha", header + ball_of<float>([&](bool in, int i) {
                                 return (in ? inside : outside) + step * static_cast<float>(i);
                               })));
  };
  EXPECT_EQ(floats(40.0F, -1000.0F, 0.0F), "");
  EXPECT_EQ(floats(0.7F, 0.0F, 0.01F), "normalised");
  EXPECT_EQ(floats(0.4F, 0.0F, 0.001F), "one_value");  // rounded
  EXPECT_EQ(floats(-1000.0F, -1000.0F, 0.0F), "one_value");
}

TEST_F(ImportRefusals, SlicesOf30MmAreRefusedAndThickOnesTold) {
  const auto made = [&](const char* spacing) {
    return import(write("t.mha", ball_header("MET_SHORT", spacing) + ball_of<std::int16_t>([](bool in, int i) {
                                   return static_cast<std::int16_t>(in ? 40 + i : -1000);
                                 })));
  };
  EXPECT_EQ(made("5 5 30").error().code, "thick_slices");
  const auto thick = made("5 5 12");
  ASSERT_TRUE(thick);
  EXPECT_TRUE(casedb::has_code(thick->warnings, "thick_slices"));
  EXPECT_TRUE(made("5 5 10")->warnings.empty());
}

TEST_F(ImportRefusals, ARescaleThatOnlySomeSlicesLackIsRefused) {
  volume::Volume block =
      volume::make_volume({20, 20, 12}, glm::dvec3(2.5, 2.5, 3.0), glm::dmat3(1.0), glm::dvec3(0.0));
  for (std::size_t i = 0; i < block.hu.size(); ++i) block.hu[i] = i % 20 > 4 && i % 20 < 15 ? 40 : -1000;
  write_slices(block, [](int slice) { return slice != 7; });
  const auto refused = import(folder_ / "series");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "no_rescale");
  EXPECT_NE(refused.error().text.find("in 1 of 12 slices"), std::string::npos) << refused.error().text;
}

// Stored values without their rescale are 1024 too high: soft tissue looked like bone, and the refusal spoke of a
// face.
TEST_F(ImportRefusals, AMissingRescaleIsNamedBeforeAFaceIs) {
  const auto all = [](int) { return true; };
  const auto none = [](int) { return false; };
  casedb::HeadView view;
  view.from_z_mm = -260.0;
  volume::Volume head = casedb::head_volume(view);
  write_slices(head, all);
  EXPECT_EQ(code(folder_ / "series"), "face");
  write_slices(head, none);  // nothing below 0: surely not HU
  EXPECT_EQ(code(folder_ / "series"), "no_rescale");
  // Values that pass for HU, because they are some: the face is found, and the doubt comes first.
  for (std::int16_t& hu : head.hu) hu = static_cast<std::int16_t>(hu - 1024);
  write_slices(head, none);
  const auto refused = import(folder_ / "series");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "no_rescale");
  ASSERT_FALSE(refused.error().findings.empty());
  EXPECT_EQ(refused.error().findings.front().code, "face");
}

}  // namespace
}  // namespace seldinger::app
