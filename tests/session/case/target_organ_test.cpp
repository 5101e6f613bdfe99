// A stored CT without labels: the organ that a target lies in, and what ultrasound and touch make of it.
#include "session/case/target_organ.h"

#include <gtest/gtest.h>

#include "session/case/case_build.h"
#include "sim/haptics/needle/needle_tissue.h"
#include "sim/imaging/ultrasound/view/organs.h"
#include "sim/volume/phantom.h"
#include "sim/volume/tissue/find_tissue.h"
#include "tests/fixtures/folders.h"
#include "tests/fixtures/new_ball.h"

namespace seldinger::session {
namespace {

using volume::TissueClass;

TEST(FoundOrgans, OfACtWithoutLabelsAreTargetsSeenAndFelt) {
  casedb::Library library =
      std::move(casedb::Library::open_or_create(fixtures::fresh_test_folder("app") / "library").value());
  const volume::Phantom torso = volume::make_phantom({.spacing_mm = glm::dvec3(4.0)});
  const auto is = [&](std::size_t at, const char* name) {
    return torso.labels.names[torso.labels.label[at]] == name;
  };
  const glm::ivec3 n = torso.volume.size_voxels;
  glm::dvec3 spleen_mm(0.0);
  double voxels = 0.0;
  for (int k = 0; k < n.z; ++k)
    for (int j = 0; j < n.y; ++j)
      for (int i = 0; i < n.x; ++i)
        if (is(torso.volume.index(i, j, k), "spleen")) {
          spleen_mm += glm::dvec3(torso.volume.lps_from_voxel * glm::dvec4(i, j, k, 1.0));
          voxels += 1.0;
        }
  ASSERT_GT(voxels, 0.0);
  spleen_mm /= voxels;
  casedb::NewCase made = fixtures::new_ball();
  made.volume = torso.volume;
  const auto plain = casedb::find_case(library, casedb::add_case(library, made)).value();
  made.labels = torso.labels;
  const auto labelled = casedb::find_case(library, casedb::add_case(library, made)).value();

  const auto organ = organ_of_target(library, plain, spleen_mm);
  ASSERT_TRUE(organ);
  EXPECT_EQ(organ->organ, volume::FoundOrgan::spleen);
  EXPECT_GE(organ->confidence, volume::kOrganConfidence);
  EXPECT_FALSE(organ_of_target(library, plain, spleen_mm + glm::dvec3(0.0, 0.0, 1000.0))) << "beyond the CT";
  EXPECT_FALSE(organ_of_target(library, labelled, spleen_mm)) << "its labels say what it holds";

  const auto scene = build_case(library, plain, {}, {}, Needs::ultrasound);
  ASSERT_TRUE(scene);
  const auto shown = imaging::organs_of(scene->volume, scene->classes);
  std::size_t spleen = 0, cortex = 0, kidney = 0, of_spleen = 0, of_kidney = 0;
  for (std::size_t at = 0; at < shown.size(); ++at) {
    of_spleen += is(at, "spleen") ? 1 : 0, of_kidney += is(at, "kidney") ? 1 : 0;
    spleen += is(at, "spleen") && shown[at] == imaging::Organ::spleen ? 1 : 0;
    cortex += is(at, "kidney") && shown[at] == imaging::Organ::kidney_cortex ? 1 : 0;
    kidney += is(at, "kidney") && scene->classes[at] == TissueClass::kidney ? 1 : 0;
  }
  EXPECT_GE(spleen * 10, of_spleen * 9) << "as ultrasound shows a spleen";
  EXPECT_GE(kidney * 10, of_kidney * 9);
  EXPECT_GE(cortex * 2, of_kidney) << "pyramids lie within";
  const glm::dvec4 at(glm::round(glm::dvec3(volume::voxel_from_lps(scene->volume) * glm::dvec4(spleen_mm, 1.0))),
                      1.0);
  const TissueClass felt =
      scene->classes[scene->volume.index(static_cast<int>(at.x), static_cast<int>(at.y), static_cast<int>(at.z))];
  EXPECT_LT(haptics::needle_tissue(felt).intercept_n, haptics::needle_tissue(TissueClass::soft_tissue).intercept_n);

  // What was stored before organs were asked stays: a case's classes are its asset.
  casedb::NewCase before = made;
  for (std::string& name : before.labels->names) name = "unknown " + name;
  before.labels->names.front() = "none";
  library.database().run("DROP TRIGGER training_case_keeps_its_classes");
  const std::string before_id = casedb::add_case(library, before);
  library.database().run(
      "UPDATE training_case SET classes_sha256 = (SELECT classes_sha256 FROM training_case WHERE case_id = '" +
      before_id + "') WHERE case_id = '" + plain.case_id + "'");
  const auto old = casedb::find_case(library, plain.case_id).value();
  ASSERT_TRUE(old.labels_sha256.empty()) << "to a loader it is a CT in which organs would be found";
  EXPECT_EQ(casedb::load_classes(library, old).value(), volume::tissue_classes(torso.volume));
  EXPECT_FALSE(organ_of_target(library, old, spleen_mm)) << "it shows soft tissue there";
}

}  // namespace
}  // namespace seldinger::session
