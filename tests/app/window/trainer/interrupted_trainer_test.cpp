// An attempt at the workstation that was interrupted: offered to whoever made it, resumed, closed or refused.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "app/attempts/this_program.h"
#include "casedb/database/sqlite.h"
#include "session/attempt/replayed_attempt.h"
#include "sim/engine/step.h"
#include "tests/app/window/trainer/trainer_case.h"

namespace seldinger::app {
namespace {

// A program died while mona was at it: the needle 12 mm above the skin, the probe beside.
class InterruptedTrainerTest : public TrainerTest {
 protected:
  static constexpr std::size_t kTicks = 4000;
  std::string attempt_id_, person_id_;
  cases::Inputs left_;

  virtual void set_up_case() {}
  virtual void change(session::Task&) {}  // before it is begun
  void SetUp() override {
    TrainerTest::SetUp();
    set_up_case();
    publish();
    casedb::Library library = open();
    person_id_ = casedb::log_in(library, "mona", kPassword)->person_id;
    auto task = session::prepare_task(library, case_id_, "");
    ASSERT_TRUE(task);
    change(*task);
    const auto id =
        casedb::open_attempt(library, session::head_of(*task, this_program(), std::string(casedb::kPersonOperator),
                                                       0, std::optional(person_id_)));
    ASSERT_TRUE(id);
    attempt_id_ = *id;
    const engine::Tick tick(task->scene);
    engine::TickState now;
    cases::Recording recording;
    recording.step_version = engine::kStepVersion;
    recording.events.emplace();
    for (std::size_t i = 0; i < kTicks; ++i) {
      left_.needle = {{0.005 * static_cast<double>(i), -62.0, 0.0}, {0, 1, 0}, {1, 0, 0}};
      left_.probe = {{-30.0, -42.0, 0.0}, {0.6, 0.8, 0.0}, {0.8, -0.6, 0.0}};
      left_.event = i == 100   ? cases::EventKind::proceed
                    : i == 200 ? cases::EventKind::anaesthetic
                               : cases::EventKind::none;
      const cases::RecordedTick made = tick.advance_hands(left_, {}, now);
      cases::add_events(now.state.t_s, made, *recording.events);
      recording.inputs.push_back(made.inputs);
      recording.hashes.push_back(made.hash);
      if (made.pose) recording.poses.push_back(*made.pose);
      if (made.force) recording.forces.push_back(*made.force);
    }
    left_ = recording.inputs.back();
    for (const cases::RecordingChunk& chunk : cases::chunks_from_recording(recording))
      ASSERT_TRUE(casedb::add_chunk(library, attempt_id_, chunk));
  }
};

TEST_F(InterruptedTrainerTest, IsOfferedToWhoMadeItAndGoesOnWhereItWas) {
  Trainer trainer(open());
  auto library = open();
  ASSERT_EQ(casedb::list_open_attempts(library).size(), 1U) << "nobody closes it before she was asked";
  trainer.log_in("tina", kPassword);
  if (!trainer.choices().empty()) {
    trainer.choose(case_id_);
    EXPECT_FALSE(trainer.interrupted()) << "it is not hers";
  }
  trainer.log_out();
  trainer.log_in("mona", kPassword);
  trainer.choose(case_id_);
  ASSERT_TRUE(trainer.interrupted());
  EXPECT_EQ(trainer.interrupted()->attempt_id, attempt_id_);
  EXPECT_FALSE(trainer.resume(false)) << "not prepared yet";
  ASSERT_TRUE(ready(trainer)) << trainer.refusal();
  ASSERT_TRUE(trainer.resume(false));
  EXPECT_TRUE(trainer.resuming());
  trainer.back();
  EXPECT_EQ(trainer.screen(), TrainerScreen::briefing) << "it is on its way";
  ASSERT_TRUE(looks_until(trainer, TrainerScreen::attempt)) << trainer.refusal();
  PersonAttempt& attempt = *trainer.attempt();
  std::optional<Seen> seen;
  ASSERT_TRUE(until([&] {
    if (const auto newest = attempt.seen()) seen = newest;
    return seen && seen->moment.state.tick > kTicks + 200;
  }));
  EXPECT_LT(glm::distance(seen->moment.state.needle.tip_lps_mm, left_.needle.position_lps_mm), 0.1)
      << "the tool is where it was left";
  EXPECT_LT(glm::distance(seen->moment.state.probe.origin_lps_mm, left_.probe.position_lps_mm), 0.1);
  EXPECT_EQ(seen->moment.event, cases::EventKind::resumed) << "and no sign-in is said again";
  EXPECT_EQ(attempt.said_before(),
            (std::vector{cases::EventKind::proceed, cases::EventKind::anaesthetic}));  // the room shows it as done
  attempt.end();
  ASSERT_TRUE(looks_until(trainer, TrainerScreen::debrief)) << trainer.refusal();
  EXPECT_EQ(trainer.debrief()->attempt.attempt_id, attempt_id_);
  EXPECT_EQ(trainer.debrief()->attempt.end, casedb::AttemptEnd::stopped);
  EXPECT_TRUE(trainer.debrief()->attempt.away_s);
  EXPECT_EQ(trainer.debrief()->attempt.conditions.handedness, casedb::Handedness::right);
  EXPECT_FALSE(trainer.debrief()->attempt.conditions.guide_used) << "what died noted nothing of it";
  EXPECT_TRUE(casedb::list_open_attempts(library).empty());
  const auto recording = casedb::load_recording(library, attempt_id_);
  ASSERT_TRUE(recording);
  EXPECT_GT(recording->inputs.size(), kTicks + 200);
  EXPECT_TRUE(session::replay(attempt.task()->scene, *recording).same);
  trainer.back();
  trainer.choose(case_id_);
  EXPECT_FALSE(trainer.interrupted());
}

// Of a case that leaves the probe to whoever attempts it, begun with the curved one.
class InterruptedWithAProbeTest : public InterruptedTrainerTest {
 protected:
  void set_up_case() override {
    casedb::Library library = open();
    casedb::CaseSetting setting = casedb::find_case(library, case_id_).value();
    setting.modality = cases::Modality::ultrasound;
    setting.probe_is_chosen = true;
    ASSERT_TRUE(casedb::set_setting(library, case_id_, setting));
  }
  void change(session::Task& task) override { session::choose_probe(task, "C5-2v"); }
};

TEST_F(InterruptedWithAProbeTest, GoesOnByThatProbeWhateverWasClicked) {
  Trainer trainer(open());
  trainer.log_in("mona", kPassword);
  trainer.choose(case_id_);
  ASSERT_TRUE(ready(trainer)) << trainer.refusal();
  trainer.choose_probe("L11-5v");
  ASSERT_TRUE(trainer.resume(false));
  ASSERT_TRUE(looks_until(trainer, TrainerScreen::attempt)) << trainer.refusal();
  trainer.attempt()->end();
  ASSERT_TRUE(looks_until(trainer, TrainerScreen::debrief)) << trainer.refusal();
  EXPECT_EQ(trainer.debrief()->attempt.picture.probe, "C5-2v");
  trainer.again();
  ASSERT_TRUE(ready(trainer)) << trainer.refusal();
  EXPECT_EQ(trainer.chosen_probe(), "C5-2v") << "what lies ready is what the attempt would be made with";
}

TEST_F(InterruptedTrainerTest, ANewOneClosesItAsItIs) {
  Trainer trainer(open());
  trainer.log_in("mona", kPassword);
  trainer.choose(case_id_);
  ASSERT_TRUE(trainer.interrupted());
  ASSERT_TRUE(ready(trainer)) << trainer.refusal();
  ASSERT_TRUE(trainer.begin(false));
  EXPECT_FALSE(trainer.interrupted());
  trainer.attempt()->end();
  ASSERT_TRUE(looks_until(trainer, TrainerScreen::debrief)) << trainer.refusal();
  auto library = open();
  const auto row = casedb::find_attempt(library, attempt_id_);
  ASSERT_TRUE(row);
  EXPECT_EQ(row->end, casedb::AttemptEnd::interrupted);
  EXPECT_EQ(row->duration_s, 0.001 * kTicks);
  EXPECT_NE(trainer.debrief()->attempt.attempt_id, attempt_id_);
}

TEST_F(InterruptedTrainerTest, OneThatDoesNotReplayIsRefusedWithWordsAndKept) {
  { open().database().run("UPDATE open_attempt SET instrument_length_mm = instrument_length_mm + 1"); }
  Trainer trainer(open());
  trainer.log_in("mona", kPassword);
  trainer.choose(case_id_);
  ASSERT_TRUE(ready(trainer)) << trainer.refusal();
  ASSERT_TRUE(trainer.resume(true));
  ASSERT_TRUE(looks_until(trainer, TrainerScreen::choose));
  EXPECT_NE(trainer.refusal().find("a different task"), std::string::npos) << trainer.refusal();
  auto library = open();
  EXPECT_EQ(casedb::list_open_attempts(library).size(), 1U);
}

}  // namespace
}  // namespace seldinger::app
