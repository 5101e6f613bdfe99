// What a workstation lists beside the words: a small picture of each case, and a draft that is duplicated.
#include <gtest/gtest.h>

#include <algorithm>

#include "casedb/cases/authoring.h"
#include "tests/app/window/trainer/trainer_case.h"

namespace seldinger::app {
namespace {

using TrainerListTest = TrainerTest;

TEST_F(TrainerListTest, ShowsEachCaseThroughItsTarget) {
  publish();
  Trainer trainer(open());
  trainer.log_in("tina", kPassword);
  EXPECT_EQ(trainer.thumbnail(case_id_), nullptr) << "it is made while the list is up";
  std::shared_ptr<const CaseThumbnail> seen;
  ASSERT_TRUE(until([&] {
    trainer.look();
    seen = trainer.thumbnail(case_id_);
    return seen != nullptr;
  }));
  constexpr int kSide = CaseThumbnail::kSidePx;
  ASSERT_EQ(seen->grey.size(), static_cast<std::size_t>(kSide * kSide));
  // A ball in air: grey about its middle, black in the corner.
  EXPECT_EQ(seen->grey.front(), 0);
  EXPECT_GT(seen->grey[static_cast<std::size_t>(kSide / 2 * kSide + kSide / 2)], 80);
  // The target's place is a share of the side: the way from the middle is what it is in the CT.
  ASSERT_TRUE(seen->target);
  casedb::Library library = open();
  const auto row = casedb::find_case(library, case_id_).value();
  const glm::dvec3 target = casedb::list_lesions(library, case_id_).front().lesion.center_lps_mm;
  const glm::dvec3 middle(row.lps_from_voxel * glm::dvec4(0.5 * glm::dvec3(row.size_voxels - 1), 1.0));
  const glm::dvec3 size_mm = row.spacing_mm * glm::dvec3(row.size_voxels - 1);
  const double side_mm = std::max(size_mm.x, size_mm.y);
  EXPECT_NEAR((seen->target->x - 0.5) * side_mm, target.x - middle.x, 1e-6);
  EXPECT_NEAR((seen->target->y - 0.5) * side_mm, target.y - middle.y, 1e-6);
}

TEST_F(TrainerListTest, OfNoCaseThatIsNotListedThereIsAPicture) {
  Trainer trainer(open());
  trainer.log_in("tina", kPassword);  // the case is a draft
  for (int i = 0; i < 5; ++i) trainer.look();
  EXPECT_EQ(trainer.thumbnail(case_id_), nullptr);
  casedb::Library library = open();
  EXPECT_FALSE(make_thumbnail(library, "no such case"));
}

TEST_F(TrainerListTest, ADuplicateIsADraftOfItsOwn) {
  Trainer trainer(open());
  trainer.log_in("tina", kPassword);
  trainer.duplicate_draft(case_id_);
  trainer.log_out();
  trainer.log_in("mona", kPassword);
  ASSERT_EQ(trainer.drafts().size(), 1U) << "a trainee duplicates nothing";
  trainer.duplicate_draft(case_id_);
  EXPECT_EQ(trainer.refusal(), "");
  EXPECT_NE(trainer.imported().find("“Ball” now has a duplicate"), std::string::npos) << trainer.imported();
  ASSERT_EQ(trainer.drafts().size(), 2U);
  const auto copy =
      std::ranges::find_if(trainer.drafts(), [&](const CaseDraft& one) { return one.case_id != case_id_; });
  ASSERT_NE(copy, trainer.drafts().end());
  EXPECT_EQ(copy->title, "Copy of Ball");
  EXPECT_EQ(copy->version, 1) << "no next version of the other";
  casedb::Library library = open();
  const auto of = [&](const std::string& id) { return casedb::find_case(library, id).value(); };
  const auto ours = of(copy->case_id), other = of(case_id_);
  EXPECT_NE(ours.family_id, other.family_id);
  EXPECT_EQ(ours.volume_sha256, other.volume_sha256);
  EXPECT_EQ(ours.state, casedb::CaseState::draft);
  const auto lesions = casedb::list_lesions(library, copy->case_id);
  ASSERT_EQ(lesions.size(), 1U);
  const std::string lesion_id = lesions.front().lesion_id;
  EXPECT_TRUE(casedb::remove_lesion(library, copy->case_id, lesion_id));
  EXPECT_EQ(casedb::list_lesions(library, case_id_).size(), 1U) << "what is done to one is not done to the other";
  trainer.delete_draft(copy->case_id);
  EXPECT_EQ(trainer.drafts().size(), 1U);
}

}  // namespace
}  // namespace seldinger::app
