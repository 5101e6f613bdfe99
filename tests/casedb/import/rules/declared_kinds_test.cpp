// What files say of themselves in words: dual-energy pictures in DICOM, mirrored places in NIfTI.
#include <glm/geometric.hpp>

#include "tests/casedb/import/dicom_writer.h"
#include "tests/casedb/import/import_case.h"

namespace seldinger::casedb {
namespace {

class DeclaredKinds : public ImportCase {
 protected:
  std::string outcome(const TestDicom& file) {
    const auto source = read(write("PLANTED.dcm", file.bytes()));
    if (!source) return source.error().code;
    return has_code(source->warnings, "virtual_image") ? "virtual_image" : "";
  }
  std::string of_type(const std::string& image_type) {
    return outcome(TestDicom::ct_slice({4, 3}).text(0x00080008, "CS", image_type));
  }
};

TEST_F(DeclaredKinds, MapsOfAMaterialAreRefused) {
  // PS3.3 §C.8.15.2.1.1.5, and vendors' words.
  for (const char* type : {"DERIVED\\PRIMARY\\AXIAL\\MAT_SPECIFIC", "DERIVED\\PRIMARY\\AXIAL\\MAT_FRACTIONAL",
                           "DERIVED\\PRIMARY\\AXIAL\\EFF_ATOMIC_NUM", "DERIVED\\PRIMARY\\AXIAL\\ELECTRON_DENSITY",
                           "DERIVED\\PRIMARY\\AXIAL\\MAT_VALUE_BASED", "DERIVED\\SECONDARY\\AXIAL\\IODINE",
                           "DERIVED\\SECONDARY\\AXIAL\\IODINE_NO_WATER_2", "DERIVED\\PRIMARY\\AXIAL\\ZEFF"})
    EXPECT_EQ(of_type(type), "derived") << type;
  EXPECT_EQ(outcome(TestDicom::ct_slice({4, 3}).text(0x00281054, "LO", "MGML")), "not_hu");
}

TEST_F(DeclaredKinds, VirtualPicturesAreTold) {
  for (const char* type : {"DERIVED\\PRIMARY\\AXIAL\\VMI", "DERIVED\\PRIMARY\\AXIAL\\MAT_REMOVED",
                           "DERIVED\\PRIMARY\\AXIAL\\MAT_MODIFIED", "DERIVED\\SECONDARY\\AXIAL\\CT_SOM5 SPI\\VNC",
                           "DERIVED\\PRIMARY\\AXIAL\\MONOE_70KEV", "DERIVED\\PRIMARY\\AXIAL\\IODINE_REMOVED",
                           "DERIVED\\PRIMARY\\AXIAL\\NO_IODINE", "DERIVED\\PRIMARY\\AXIAL\\MONOENERGETIC PLUS"})
    EXPECT_EQ(of_type(type), "virtual_image") << type;
  for (const char* type :
       {"ORIGINAL\\PRIMARY\\AXIAL", "DERIVED\\PRIMARY\\AXIAL\\STANDARD", "DERIVED\\SECONDARY\\MPR"})
    EXPECT_EQ(of_type(type), "") << type;
}

TEST_F(DeclaredKinds, ADescriptionIsSearchedForWordsAndNeverTold) {
  const auto described = [&](const std::string& text) {
    return outcome(TestDicom::ct_slice({4, 3}).text(0x0008103E, "LO", text));
  };
  EXPECT_EQ(described("PLANTED Iodine 1.0"), "virtual_image");
  EXPECT_EQ(described("PLANTED MonoE 40keV"), "virtual_image");
  EXPECT_EQ(described("PLANTED liver venous"), "");
}

glm::dmat4 ras_axes(double x, double y, double z) {
  glm::dmat4 axes(1.0);
  axes[0].x = x;
  axes[1].y = y;
  axes[2].z = z;
  return axes;
}

class MirroredForms : public ImportCase {
 protected:
  // A NIfTI of two forms: the sform's axes, against a qform whose axes are RAS.
  base::Result<Source> two_forms(const glm::dmat4& sform, int qform_code, int sform_code) {
    Nifti nifti({4, 3, 3}, sform);
    nifti.put<std::int16_t>(252, static_cast<std::int16_t>(qform_code));
    nifti.put<std::int16_t>(254, static_cast<std::int16_t>(sform_code));
    std::vector<std::int16_t> hu;
    for (int i = 0; i < 36; ++i) hu.push_back(static_cast<std::int16_t>(i * 10 - 300));
    return read(write("PLANTED.nii", nifti.bytes(little_endian(hu))));
  }
};

TEST_F(MirroredForms, AnSformThatMirrorsTheQformIsRefusedAsThat) {
  const std::pair<glm::dmat4, const char*> mirrored[] = {{ras_axes(-1, 1, 1), "right and left change places"},
                                                         {ras_axes(1, -1, 1), "front and back change places"},
                                                         {ras_axes(1, 1, -1), "head and feet change places"}};
  for (const auto& [sform, sides] : mirrored) {
    const auto source = two_forms(sform, 1, 1);
    ASSERT_FALSE(source) << sides;
    EXPECT_EQ(source.error().code, "mirrored_geometry");
    EXPECT_NE(source.error().text.find(sides), std::string::npos) << source.error().text;
  }
}

TEST_F(MirroredForms, InAnotherFrameItIsToldAndTheScannersIsTaken) {
  const auto source = two_forms(ras_axes(-1, 1, 1), 1, 4);
  ASSERT_TRUE(source);
  EXPECT_TRUE(has_code(source->warnings, "mirrored_geometry"));
  EXPECT_FALSE(has_code(source->warnings, "two_geometries"));
  EXPECT_EQ(source->volume.lps_from_voxel[0].x, -1.0);  // the qform's RAS in LPS
}

TEST_F(MirroredForms, ATurnIsNoMirror) {
  const auto source = two_forms(ras_axes(-1, -1, 1), 1, 1);  // half a turn
  ASSERT_FALSE(source);
  EXPECT_EQ(source.error().code, "no_geometry");
  EXPECT_TRUE(has_code(two_forms(ras_axes(-1, -1, 1), 1, 4)->warnings, "two_geometries"));
  // One form alone may be left-handed, as most tools store volumes.
  const auto alone = two_forms(ras_axes(-1, 1, 1), 0, 1);
  ASSERT_TRUE(alone);
  EXPECT_FALSE(has_code(alone->warnings, "mirrored_geometry"));
}

}  // namespace
}  // namespace seldinger::casedb
