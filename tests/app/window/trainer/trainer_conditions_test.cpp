// Under which conditions an attempt at the workstation was made is kept with it.
#include <gtest/gtest.h>

#include <functional>

#include "session/attempt/replayed_attempt.h"
#include "tests/app/window/trainer/trainer_case.h"
#include "tests/fixtures/until.h"

namespace seldinger::app {
namespace {

// What led the tools, the guide, pauses and what was watched before are kept with an attempt, and its recording
// replays as if nothing of it had been noted.
TEST_F(TrainerTest, TheConditionsOfAnAttemptAreKept) {
  publish();
  Trainer trainer(open());
  ASSERT_NO_FATAL_FAILURE(begin(trainer, "mona", true));
  PersonAttempt& attempt = *trainer.attempt();
  attempt.know([](casedb::Conditions& conditions) {
    conditions.window_rate_hz = 59.5;
    conditions.stereo = false;
  });
  HandsTold told;
  Seen seen;
  const auto until_seen = [&](const std::function<bool()>& holds) {
    return until([&] {
      if (const auto newest = attempt.seen()) seen = *newest;
      return holds();
    });
  };
  const auto tell = [&] {
    told.between_s = kTellingS;
    attempt.tell(told);
  };
  told.sum.guides = 1;
  tell();
  ASSERT_TRUE(until_seen([&] { return seen.in_guide; }));
  attempt.pause(true);
  fixtures::let_pass(0.4);  // how long it was paused is kept
  attempt.pause(false);
  const double paused_at_s = seen.moment.state.t_s;
  ASSERT_TRUE(until_seen([&] { return seen.moment.state.t_s > paused_at_s + 0.1; }));
  told.sum.guides = 2;
  told.by = cases::HandKind::gamepad;
  told.sum.turn_lps_rad.x += 0.01;
  tell();
  ASSERT_TRUE(until_seen([&] { return !seen.guided; }));
  const double turned_s = seen.moment.state.t_s;  // a hand that still turns ends the way back
  ASSERT_TRUE(until_seen([&] { return seen.moment.state.t_s > turned_s + 0.2; }));
  told.sum.resets = 1;
  tell();
  const double back_s = seen.moment.state.t_s;
  ASSERT_TRUE(until_seen([&] { return !seen.returning && seen.moment.state.t_s > back_s + 0.5; }));
  attempt.end();
  ASSERT_TRUE(looks_until(trainer, TrainerScreen::debrief)) << trainer.refusal();

  const casedb::AttemptRow& row = trainer.debrief()->attempt;
  const casedb::Conditions& kept = row.conditions;
  EXPECT_EQ(kept.needle_hand, cases::HandKind::mouse);
  EXPECT_EQ(kept.probe_hand, cases::HandKind::mouse);
  EXPECT_EQ(kept.hand_changes, 1);
  EXPECT_FALSE(kept.needle_arm);
  EXPECT_EQ(kept.handedness, casedb::Handedness::left);
  EXPECT_EQ(kept.guide_used, true);
  ASSERT_TRUE(kept.guide_share && kept.paused_s);
  EXPECT_GT(*kept.guide_share, 0.0);
  EXPECT_LT(*kept.guide_share, 1.0);
  EXPECT_EQ(kept.pauses, 1);
  EXPECT_GT(*kept.paused_s, 0.3);
  EXPECT_LT(*kept.paused_s, 30.0);
  EXPECT_EQ(kept.help_level, 2) << "an easy case, not passed yet";
  EXPECT_EQ(kept.expert_replays, 0);
  EXPECT_EQ(kept.own_replays, 0);
  EXPECT_EQ(kept.begun_again, false);
  EXPECT_EQ(kept.station, "this computer") << "nobody named it";
  EXPECT_EQ(kept.window_rate_hz, 59.5);
  EXPECT_EQ(kept.stereo, false);
  EXPECT_FALSE(kept.sound) << "nobody said";

  auto library = open();
  const auto recording = casedb::load_recording(library, row.attempt_id);
  ASSERT_TRUE(recording && recording->events);
  std::vector<cases::EventKind> noted;
  for (const cases::Event& event : *recording->events) {
    if (cases::find_event(event.kind)->noted) noted.push_back(event.kind);
    EXPECT_EQ(event.wall_s, event.kind == cases::EventKind::paused ? *kept.paused_s : 0.0);
  }
  using enum cases::EventKind;
  EXPECT_EQ(noted, (std::vector{needle_by_mouse, probe_by_mouse, guide_on, guide_reached, paused, needle_by_gamepad,
                                guide_off, return_begun, return_ended}));
  EXPECT_LT(row.duration_s, recording->events->back().t_s + 5.0);
  EXPECT_TRUE(session::replay(attempt.task()->scene, *recording).same) << "what is noted is no input";
}

// F5 in the middle, and replays that were watched before the next one.
TEST_F(TrainerTest, ThatOneBeganAgainAndWhatOneWatchedIsKept) {
  publish();
  Trainer trainer(open());
  trainer.log_in("mona", kPassword);
  trainer.choose(case_id_);
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(ready(trainer)) << trainer.refusal();
    ASSERT_TRUE(trainer.begin(false));
    ASSERT_TRUE(until([&] { return trainer.attempt()->seen().has_value(); }));
    if (i == 0) trainer.again();
  }
  trainer.attempt()->end();
  ASSERT_TRUE(looks_until(trainer, TrainerScreen::debrief)) << trainer.refusal();
  EXPECT_EQ(trainer.debrief()->attempt.conditions.begun_again, false);
  trainer.watch(trainer.debrief()->attempt.attempt_id);
  trainer.stop_watching();  // before there was anything to see
  trainer.look();
  trainer.watch(trainer.debrief()->attempt.attempt_id);
  ASSERT_TRUE(until([&] {
    trainer.look();
    return trainer.watched()->phase() != session::WatchedAttempt::Phase::preparing;
  }));
  trainer.look();
  trainer.stop_watching();
  trainer.again();
  ASSERT_TRUE(ready(trainer)) << trainer.refusal();
  ASSERT_TRUE(trainer.begin(false));
  trainer.attempt()->end();
  ASSERT_TRUE(looks_until(trainer, TrainerScreen::debrief)) << trainer.refusal();
  EXPECT_EQ(trainer.debrief()->attempt.conditions.own_replays, 1);
  EXPECT_EQ(trainer.debrief()->attempt.conditions.expert_replays, 0);
  auto library = open();
  const auto attempts = casedb::list_attempts(library);  // newest first
  ASSERT_EQ(attempts.size(), 3U);
  EXPECT_EQ(casedb::find_conditions(library, attempts[2].attempt_id).begun_again, true);
  EXPECT_EQ(casedb::find_conditions(library, attempts[2].attempt_id).own_replays, 0);
}

}  // namespace
}  // namespace seldinger::app
