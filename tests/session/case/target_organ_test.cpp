// The organ that a target lies in, of a stored CT without labels.
#include "session/case/target_organ.h"

#include <gtest/gtest.h>

#include "sim/volume/phantom.h"
#include "tests/fixtures/folders.h"
#include "tests/fixtures/new_ball.h"

namespace seldinger::session {
namespace {

TEST(TargetOrgan, IsToldOfACtWithoutLabels) {
  casedb::Library library =
      std::move(casedb::Library::open_or_create(fixtures::fresh_test_folder("app") / "library").value());
  volume::Phantom groin = volume::make_phantom({.spacing_mm = glm::dvec3(3.0), .region = volume::Region::groin});
  glm::dvec3 bladder_mm(0.0);
  double voxels = 0.0;
  for (int k = 0; k < groin.volume.size_voxels.z; ++k)
    for (int j = 0; j < groin.volume.size_voxels.y; ++j)
      for (int i = 0; i < groin.volume.size_voxels.x; ++i)
        if (groin.labels.names[groin.labels.label[groin.volume.index(i, j, k)]] == "bladder") {
          bladder_mm += glm::dvec3(groin.volume.lps_from_voxel * glm::dvec4(i, j, k, 1.0));
          voxels += 1.0;
        }
  ASSERT_GT(voxels, 0.0);
  bladder_mm /= voxels;
  casedb::NewCase made = fixtures::new_ball();
  made.volume = groin.volume;
  const auto plain = casedb::find_case(library, casedb::add_case(library, made)).value();
  made.labels = groin.labels;
  const auto labelled = casedb::find_case(library, casedb::add_case(library, made)).value();

  const auto organ = organ_of_target(library, plain, bladder_mm);
  ASSERT_TRUE(organ);
  EXPECT_EQ(organ->organ, volume::FoundOrgan::bladder);
  EXPECT_GE(organ->confidence, volume::kOrganConfidence);
  EXPECT_FALSE(organ_of_target(library, plain, bladder_mm + glm::dvec3(0.0, 0.0, 1000.0))) << "beyond the CT";
  EXPECT_FALSE(organ_of_target(library, plain, bladder_mm - glm::dvec3(0.0, 90.0, 0.0))) << "before the bladder";
  EXPECT_FALSE(organ_of_target(library, labelled, bladder_mm)) << "its labels say what it holds";
}

}  // namespace
}  // namespace seldinger::session
