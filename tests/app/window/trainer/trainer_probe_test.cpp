// Where a case leaves the probe to whoever attempts it: nobody begins without one, and the attempt keeps it.
#include <gtest/gtest.h>

#include "session/attempt/replayed_attempt.h"
#include "session/case/case_build.h"
#include "tests/app/window/trainer/trainer_case.h"

namespace seldinger::app {
namespace {

class TrainerProbeTest : public TrainerTest {
 protected:
  void publish_by_ultrasound(bool chosen) {
    {
      casedb::Library library = open();
      casedb::CaseSetting setting = casedb::find_case(library, case_id_).value();
      setting.modality = cases::Modality::ultrasound;
      setting.probe_is_chosen = chosen;
      ASSERT_TRUE(casedb::set_setting(library, case_id_, setting));
    }
    publish();
  }
  void prepare(Trainer& trainer) {
    trainer.log_in("mona", kPassword);
    trainer.choose(case_id_);
    EXPECT_TRUE(trainer.probes().empty()) << "it is not prepared yet";
    ASSERT_TRUE(ready(trainer)) << trainer.refusal();
  }
  casedb::AttemptRow attempt_of(Trainer& trainer) {
    EXPECT_TRUE(until([&] { return trainer.attempt()->seen().has_value(); }));
    trainer.attempt()->end();
    EXPECT_TRUE(looks_until(trainer, TrainerScreen::debrief)) << trainer.refusal();
    return trainer.debrief()->attempt;
  }
};

TEST_F(TrainerProbeTest, IsChosenBeforeTheRoomAndKeptWithTheAttempt) {
  ASSERT_NO_FATAL_FAILURE(publish_by_ultrasound(true));
  Trainer trainer(open());
  ASSERT_NO_FATAL_FAILURE(prepare(trainer));
  EXPECT_EQ(trainer.probes(), (std::vector<std::string>{"C5-2v", "L11-5v"}));
  EXPECT_FALSE(trainer.begin(false)) << "none is chosen";
  trainer.choose_probe("thesis-linear");  // not offered
  EXPECT_FALSE(trainer.begin(false));
  trainer.choose_probe("L11-5v");
  trainer.choose_probe("C5-2v");  // who thinks again
  EXPECT_EQ(trainer.chosen_probe(), "C5-2v");
  ASSERT_TRUE(trainer.begin(false));
  trainer.choose_probe("L11-5v");
  EXPECT_EQ(trainer.chosen_probe(), "C5-2v") << "too late";
  const casedb::AttemptRow first = attempt_of(trainer);
  EXPECT_EQ(first.picture.probe, "C5-2v");
  // Once more: the last one lies ready, and another may be taken.
  trainer.again();
  ASSERT_TRUE(ready(trainer)) << trainer.refusal();
  EXPECT_EQ(trainer.chosen_probe(), "C5-2v");
  trainer.choose_probe("L11-5v");
  ASSERT_TRUE(trainer.begin(false));
  const casedb::AttemptRow second = attempt_of(trainer);
  EXPECT_EQ(second.picture.probe, "L11-5v");
  // What is replayed looks through the probe of then.
  casedb::Library library = open();
  for (const casedb::AttemptRow& row : {first, second}) {
    const auto scene = session::build_case_of(library, row, session::Needs::ultrasound);
    const auto recording = casedb::load_recording(library, row.attempt_id);
    ASSERT_TRUE(scene && recording);
    EXPECT_EQ(scene->picture.probe, row.picture.probe);
    EXPECT_TRUE(session::replay(*scene, *recording).same);
  }
}

TEST_F(TrainerProbeTest, IsTheCasesWhereTheCaseGivesIt) {
  ASSERT_NO_FATAL_FAILURE(publish_by_ultrasound(false));
  Trainer trainer(open());
  ASSERT_NO_FATAL_FAILURE(prepare(trainer));
  EXPECT_TRUE(trainer.probes().empty());
  ASSERT_TRUE(trainer.begin(false));
  EXPECT_EQ(attempt_of(trainer).picture.probe, "L11-5v") << "25 mm below the skin";
}

}  // namespace
}  // namespace seldinger::app
