// The trainee's own plan: set in the briefing, kept with each attempt, held against what was done; and one's own
// attempts as they follow on each other.
#include "app/window/trainer/plan_words.h"
#include "tests/app/window/trainer/trainer_case.h"

namespace seldinger::app {
namespace {

TEST_F(TrainerTest, AWayThatIsPlannedIsKeptAndComparedWithWhatWasDone) {
  publish();
  Trainer trainer(open());
  trainer.log_in("tina", kPassword);
  trainer.choose(case_id_);
  trainer.plan_entry({0.0, 0.0, 0.0});
  EXPECT_FALSE(trainer.plan()) << "nothing can be planned before the case is there";
  ASSERT_TRUE(ready(trainer)) << trainer.refusal();
  const cases::Case& scene = trainer.attempt()->task()->scene;
  const glm::dvec3 target = scene.lesions.front().center_lps_mm;
  EXPECT_TRUE(trainer.proposes_path());
  trainer.plan_as_proposed();
  EXPECT_TRUE(trainer.plan());
  trainer.drop_plan();
  trainer.plan_entry(target);
  ASSERT_TRUE(trainer.plan());
  EXPECT_NEAR(std::abs(scene.skin_index.closest(trainer.plan()->entry_lps_mm).distance_mm), 0.0, 0.01)
      << "on the skin, wherever was clicked";
  EXPECT_EQ(trainer.plan()->tip_lps_mm, target) << "until that is planned otherwise";
  EXPECT_NEAR(trainer.plan()->depth_mm(), kDepthMm, 0.5);
  const auto planned = *trainer.plan();
  trainer.plan_tip(planned.entry_lps_mm);
  EXPECT_EQ(trainer.plan(), planned) << "a way without a length is none";
  trainer.plan_tip(target + glm::dvec3(0.0, 0.0, 5.0));
  EXPECT_NEAR(glm::distance(trainer.plan()->tip_lps_mm, target), 5.0, 1e-9);
  const auto own = *trainer.plan();

  ASSERT_TRUE(trainer.begin(false));
  trainer.plan_entry(target + glm::dvec3(0.0, 0.0, 40.0));
  trainer.drop_plan();  // too late for this attempt, which has been told
  PersonAttempt& attempt = *trainer.attempt();
  ASSERT_NO_FATAL_FAILURE(fire_at_the_target(attempt));
  attempt.end();
  ASSERT_TRUE(looks_until(trainer, TrainerScreen::debrief)) << trainer.refusal();
  const Debrief& debrief = *trainer.debrief();
  EXPECT_EQ(casedb::planned_path(debrief.attempt.conditions), own) << "as the library has kept it";
  ASSERT_TRUE(debrief.path);
  // The hand is still within 1 mm on its way when it fires, and tissue gives way before the needle.
  EXPECT_NEAR(debrief.path->path.depth_mm(), kDepthMm, 3.0);
  const auto told = compared_words(own, &debrief.path->path);
  ASSERT_EQ(told.size(), 4U);
  EXPECT_TRUE(told[2].starts_with("Depth: ")) << told[2];
  ASSERT_EQ(debrief.own.size(), 1U);
  EXPECT_EQ(debrief.own[0].attempt_id, debrief.attempt.attempt_id);

  trainer.again();
  ASSERT_TRUE(ready(trainer));
  ASSERT_TRUE(trainer.begin(false));
  trainer.attempt()->end();
  ASSERT_TRUE(looks_until(trainer, TrainerScreen::debrief)) << trainer.refusal();
  EXPECT_FALSE(casedb::planned_path(trainer.debrief()->attempt.conditions)) << "it was dropped";
  EXPECT_FALSE(trainer.debrief()->path) << "the needle was never in";
  ASSERT_EQ(trainer.debrief()->own.size(), 2U);
  EXPECT_EQ(trainer.debrief()->own[1].attempt_id, trainer.debrief()->attempt.attempt_id) << "oldest first";
  trainer.back();
  trainer.choose(case_id_);
  ASSERT_TRUE(ready(trainer));
  trainer.plan_tip(target);
  EXPECT_TRUE(trainer.plan());
  trainer.log_out();
  EXPECT_FALSE(trainer.plan()) << "the next to log in has planned nothing";
}

TEST_F(TrainerTest, ACaseWithoutAPlannedEntryProposesNoPath) {
  {
    casedb::Library library = open();
    casedb::NewCase made = fixtures::new_ball();
    made.planned_entry_lps_mm.reset();
    case_id_ = casedb::add_case(library, made);
    ASSERT_TRUE(casedb::add_lesion(library, case_id_, fixtures::ball_target(kDepthMm)));
  }
  publish();
  Trainer trainer(open());
  trainer.log_in("tina", kPassword);
  trainer.choose(case_id_);
  ASSERT_TRUE(ready(trainer)) << trainer.refusal();
  EXPECT_FALSE(trainer.proposes_path());
  trainer.plan_as_proposed();
  EXPECT_FALSE(trainer.plan());
}

TEST(PlanWords, TellTheWayAndWhatSpeaksAgainstIt) {
  session::PlannedWay way;
  way.length_mm = 62.4;
  EXPECT_EQ(way_words(way), "62 mm from the skin, straight in");
  way.skin_angle_deg = 11.6;
  way.head_deg = -4.7;
  EXPECT_EQ(way_words(way), "62 mm from the skin, 12° off perpendicular, 5° towards the feet");
  EXPECT_TRUE(warnings_of(way).empty());
  way.parts = {{"liver", 20.0, 42.0, {}, false}, {"bone", 21.2, 2.6, {}, true}};
  way.not_crossed = {"renal cortex"};
  way.too_long = true;
  EXPECT_EQ(warnings_of(way),
            (std::vector<std::string>{"longer than the needle", "through bone, 3 mm of it, 21 mm below the skin",
                                      "misses renal cortex, which must be crossed"}));
}

TEST(PlanWords, TellWhatWasDoneAgainstWhatWasPlanned) {
  const assessment::PlannedPath planned{{0.0, 0.0, 0.0}, {0.0, 0.0, 58.0}}, done{{3.0, 0.0, 0.0}, {3.0, 0.0, 61.0}};
  EXPECT_EQ(compared_words(planned, &done),
            (std::vector<std::string>{"Entry: 3 mm from where you planned it", "Direction: 0° off your line",
                                      "Depth: 61 mm; planned 58 mm", "Tip: 4 mm from where you planned it"}));
  EXPECT_EQ(compared_words(planned, nullptr).size(), 1U);
}

}  // namespace
}  // namespace seldinger::app
