// Tissue classes of the real CT volumes, at the landmarks of their READMEs and at places that a reader of the
// slices names without doubt.
#include <algorithm>
#include <array>
#include <string>

#include "sim/volume/classes.h"
#include "sim/volume/organs/find_organs.h"
#include "sim/volume/organs/organ_grid.h"
#include "sim/volume/organs/solid_organs.h"
#include "sim/volume/organs/spine.h"
#include "sim/volume/tissue/find_tissue.h"
#include "tests/casedb/import/import_case.h"
#include "tests/fixtures/shared_data.h"

namespace seldinger::casedb {
namespace {

using volume::TissueClass;

class RealClasses : public ImportCase {
 protected:
  void take(const std::filesystem::path& path) {
    auto source = read(path);
    ASSERT_TRUE(source);
    volume_ = std::move(source->volume);
    classes_ = volume::tissue_classes(volume_);
    const auto count = volume::count_classes(classes_);
    for (std::size_t at = 0; at < count.size(); ++at)
      ml_[at] = static_cast<double>(count[at]) * volume_.spacing_mm.x * volume_.spacing_mm.y *
                volume_.spacing_mm.z / 1000.0;
  }
  double ml(TissueClass tissue) const { return ml_[static_cast<std::size_t>(tissue)]; }
  // Share of 7 x 7 voxels in plane.
  double share(TissueClass tissue, const glm::ivec3& voxel) const {
    int are = 0;
    for (int j = -3; j <= 3; ++j)
      for (int i = -3; i <= 3; ++i)
        are += classes_[volume_.index(voxel.x + i, voxel.y + j, voxel.z)] == tissue ? 1 : 0;
    return are / 49.0;
  }
  void expect_at(const glm::dvec3& p_lps_mm, TissueClass tissue) const {
    const glm::dvec3 index(volume::voxel_from_lps(volume_) * glm::dvec4(p_lps_mm, 1.0));
    expect_at(glm::ivec3(glm::round(index)), tissue);
  }
  void expect_at(const glm::ivec3& voxel, TissueClass tissue) const {
    EXPECT_GE(share(tissue, voxel), 0.9)
        << volume::about(tissue).name << " at voxel " << voxel.x << " " << voxel.y << " " << voxel.z;
  }

  volume::Volume volume_;
  std::vector<TissueClass> classes_;
  std::array<double, volume::kTissueClasses> ml_{};
};

TEST_F(RealClasses, InTheContrastAbdomenNothingEnhancedIsBone) {
  SELDINGER_NEEDS_SHARED_DATA();
  take(shared_data("ct-abdomen-contrast-dicom"));
  for (const glm::dvec3& p : {glm::dvec3{-107, 51, -153},
                              {52, 66, -153},
                              {-14, 25, -153},
                              {-42, 16, -153},
                              {-115, -5, -98},
                              {89, 55, -98}})  // kidneys, aorta, vena cava, liver, spleen
    expect_at(p, TissueClass::soft_tissue);
  expect_at(glm::dvec3{-167, 21, -153}, TissueClass::fat);
  expect_at(glm::ivec3{245, 325, 6}, TissueClass::bone);  // vertebral bodies
  expect_at(glm::ivec3{248, 360, 24}, TissueClass::bone);
  expect_at(glm::ivec3{160, 370, 30}, TissueClass::lung);
  expect_at(glm::ivec3{350, 370, 30}, TissueClass::lung);
  expect_at(glm::ivec3{20, 20, 10}, TissueClass::air);
  EXPECT_GT(ml(TissueClass::metal), 0.1);  // a biliary stent
  EXPECT_LT(ml(TissueClass::metal), 3.0);
  EXPECT_GT(ml(TissueClass::bone), 400.0);
  EXPECT_LT(ml(TissueClass::bone), 700.0);
}

// Looked at slice by slice; the kidneys are cut by the field's end, the liver lies on the stomach's wall (what is
// found of it is liver, and hardly not sure enough), and the vena cava is not even in this noise.
TEST_F(RealClasses, OrgansAreNamedRightlyOrNotAtAll) {
  SELDINGER_NEEDS_SHARED_DATA();
  using volume::FoundOrgan;
  for (const char* name : {"ct-abdomen-contrast-dicom", "ct-abdomen-pelvis/abdomen_pelvis_2x.mha",
                           "ct-neck/neck.nrrd", "ct-thorax-inlet/thorax_inlet_1mm.mha"}) {
    take(shared_data(name));
    const volume::Organs organs = volume::find_organs(volume_, classes_);
    const auto organ_at = [&](const glm::dvec3& p_lps_mm) {
      const glm::ivec3 at(glm::round(glm::dvec3(volume::voxel_from_lps(organs.grid) * glm::dvec4(p_lps_mm, 1.0))));
      return organs.at[organs.grid.index(at.x, at.y, at.z)];
    };
    const auto ml_of = [&](FoundOrgan organ) {
      return static_cast<double>(std::count(organs.at.begin(), organs.at.end(), organ)) * 0.027;
    };
    for (const FoundOrgan organ :
         {FoundOrgan::right_lung, FoundOrgan::left_lung, FoundOrgan::vertebrae, FoundOrgan::ribs})
      EXPECT_GT(ml_of(organ), 5.0) << name;
    for (const FoundOrgan organ :
         {FoundOrgan::gallbladder, FoundOrgan::right_kidney, FoundOrgan::left_kidney, FoundOrgan::vena_cava})
      EXPECT_EQ(ml_of(organ), 0.0) << name;
    if (std::string(name) != "ct-abdomen-contrast-dicom") {
      for (const FoundOrgan organ : {FoundOrgan::liver, FoundOrgan::spleen, FoundOrgan::aorta})
        EXPECT_EQ(ml_of(organ), 0.0) << name;
      continue;
    }
    EXPECT_EQ(organ_at({89, 55, -98}), FoundOrgan::spleen);
    EXPECT_EQ(organ_at({-14, 25, -153}), FoundOrgan::aorta);
    EXPECT_NEAR(ml_of(FoundOrgan::spleen), 300.0, 45.0);
    for (const glm::dvec3& p : {glm::dvec3{-107, 51, -153}, {52, 66, -153}})
      EXPECT_EQ(organ_at(p), FoundOrgan::none);
  }
}

// A gallbladder is asked for beside a liver that is named only, so here one is taken for sure. Its bed holds a
// stent and gas, and no gallbladder; a cyst of the right kidney lies on the liver, at (-74, 59, -117).
TEST_F(RealClasses, TheGallbladderIsNoCystOfAKidneyThatIsNotNamed) {
  SELDINGER_NEEDS_SHARED_DATA();
  take(shared_data("ct-abdomen-contrast-dicom"));
  const volume::OrganGrid grid = volume::organ_grid(volume_, classes_);
  const std::vector<glm::dvec2> middle_mm = volume::middle_of_back(grid);
  std::vector<volume::Part> solid = volume::find_solid_organs(grid, middle_mm);
  const auto liver = std::find_if(solid.begin(), solid.end(), [](const volume::Part& one) {
    return one.found.organ == volume::FoundOrgan::liver;
  });
  ASSERT_NE(liver, solid.end());
  EXPECT_NEAR(liver->found.ml, 1550.0, 150.0);
  liver->found.confidence = 1.0;
  const auto gallbladder = volume::find_gallbladder(grid, middle_mm, solid);
  EXPECT_LT(gallbladder ? gallbladder->found.confidence : 0.0, volume::kOrganConfidence);
}

TEST_F(RealClasses, InThePlainAbdomenTheSpineIsBoneAndTheBladderFluid) {
  SELDINGER_NEEDS_SHARED_DATA();
  take(shared_data("ct-abdomen-pelvis/abdomen_pelvis.nii.gz"));
  for (const glm::dvec3& p : {glm::dvec3{-89, 58, -583},
                              {63, 77, -583},
                              {-104, 33, -506},
                              {-4, 27, -583},
                              {-40, 106, -583}})  // kidneys, liver, aorta, muscle
    expect_at(p, TissueClass::soft_tissue);
  expect_at(glm::dvec3{-16, 48, -583}, TissueClass::bone);
  expect_at(glm::dvec3{-11, 28, -838}, TissueClass::fluid);
  expect_at(glm::dvec3{-16, -79, -583}, TissueClass::fat);
  expect_at(glm::ivec3{240, 215, 30}, TissueClass::bone);  // a body whose rim is below the core's HU
  expect_at(glm::ivec3{155, 192, 5}, TissueClass::bone);   // femoral head
  expect_at(glm::ivec3{325, 222, 95}, TissueClass::lung);
  expect_at(glm::ivec3{180, 92, 95}, TissueClass::lung);
  expect_at(glm::ivec3{315, 130, 62}, TissueClass::gas);  // colon
  EXPECT_EQ(ml(TissueClass::metal), 0.0);
  EXPECT_LT(ml(TissueClass::vessel), 20.0) << "there is no contrast";
  EXPECT_GT(ml(TissueClass::lung), 300.0);
}

TEST_F(RealClasses, InTheNeckTheTracheaIsGasBetweenTwoLungs) {
  SELDINGER_NEEDS_SHARED_DATA();
  take(shared_data("ct-neck/neck.nrrd"));
  expect_at(glm::ivec3{145, 130, 3}, TissueClass::lung);
  expect_at(glm::ivec3{250, 130, 3}, TissueClass::lung);
  expect_at(glm::ivec3{188, 138, 3}, TissueClass::gas);
  expect_at(glm::ivec3{190, 165, 3}, TissueClass::bone);
  EXPECT_GT(ml(TissueClass::metal), 0.1);  // probably a port
  EXPECT_LT(ml(TissueClass::vessel), 10.0) << "there is no contrast";
}

TEST_F(RealClasses, InTheThoraxInletTheTracheaIsGasBetweenTwoLungs) {
  SELDINGER_NEEDS_SHARED_DATA();
  take(shared_data("ct-thorax-inlet/thorax_inlet_1mm.mha"));
  expect_at(glm::ivec3{165, 180, 2}, TissueClass::lung);
  expect_at(glm::ivec3{310, 180, 2}, TissueClass::lung);
  expect_at(glm::ivec3{241, 150, 2}, TissueClass::gas);
  expect_at(glm::ivec3{240, 235, 2}, TissueClass::bone);
  EXPECT_LT(ml(TissueClass::vessel), 5.0) << "there is no contrast";
  EXPECT_EQ(volume::tissue_classes(volume_), classes_);
}

TEST_F(RealClasses, ClassesAreStoredInATenthOfAByteAVoxel) {
  SELDINGER_NEEDS_SHARED_DATA();
  take(shared_data("ct-abdomen-pelvis/abdomen_pelvis_2x.mha"));
  const auto bytes = volume::bytes_from_classes(classes_);
  EXPECT_LT(bytes.size(), classes_.size() / 10);
  EXPECT_EQ(volume::classes_from_bytes(bytes, classes_.size()).value(), classes_);
}

}  // namespace
}  // namespace seldinger::casedb
