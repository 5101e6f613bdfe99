// An attempt in real time: pauses are noted with their length, and what is known of its conditions is stored while
// it runs.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "app/attempts/this_program.h"
#include "casedb/attempts/attempt_columns.h"
#include "casedb/database/question.h"
#include "session/attempt/live_attempt.h"
#include "session/attempt/replayed_attempt.h"
#include "session/case/task.h"
#include "tests/fixtures/folders.h"
#include "tests/fixtures/new_ball.h"
#include "tests/fixtures/until.h"

namespace seldinger::session {
namespace {

class LiveConditions : public testing::Test {
 protected:
  std::filesystem::path folder_ = fixtures::fresh_test_folder("session") / "library";
  casedb::Library library_ = std::move(casedb::Library::open_or_create(folder_).value());
  std::optional<Task> task_;

  void SetUp() override {
    const std::string case_id = casedb::add_case(library_, fixtures::new_ball());
    ASSERT_TRUE(casedb::add_lesion(library_, case_id, fixtures::ball_target(25.0)));
    auto task = prepare_task(library_, case_id, "");
    ASSERT_TRUE(task);
    task_ = std::move(*task);
  }
  LiveAttempt attempt() {
    return {library_, app::this_program(),
            head_of(*task_, app::this_program(), std::string(casedb::kPersonOperator), 0, std::nullopt),
            task_->scene};
  }
  // Hands that stand still beside the ball.
  static cases::Inputs still() {
    cases::Inputs inputs;
    inputs.needle = {{0.0, -80.0, 0.0}, {0, 1, 0}, {1, 0, 0}};
    inputs.probe = {{-30.0, -60.0, 0.0}, {0, 1, 0}, {1, 0, 0}};
    return inputs;
  }
  std::vector<cases::Event> events_of(const std::string& attempt_id) {
    const auto recording = casedb::load_recording(library_, attempt_id);
    EXPECT_TRUE(recording && recording->events);
    EXPECT_TRUE(replay(task_->scene, *recording).same) << "what is noted is no input";
    return *recording->events;
  }
};

// The attempt's clock stands still, and 0 s of it were known before: a second of the wall's is told now.
TEST_F(LiveConditions, APauseIsAnEventWithItsLength) {
  std::atomic<std::uint64_t> ticks{0}, turns{0};
  const auto stored =
      attempt().run({.hands = [](const cases::State&, const cases::FrameTruth*) { return still(); },
                     .note =
                         [&](const cases::State&) {
                           return ++ticks == 1 ? cases::EventKind::needle_by_mouse : cases::EventKind::none;
                         },
                     .done = [&] { return ticks >= 600; },
                     .paused = [&] { return ticks >= 300 && turns++ < 1000; }});
  ASSERT_TRUE(stored) << stored.error().text;
  const std::vector<cases::Event> events = events_of(stored->attempt_id);
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].kind, cases::EventKind::needle_by_mouse);
  EXPECT_EQ(events[1].kind, cases::EventKind::paused);
  EXPECT_NEAR(events[1].t_s, 0.3, 0.05);
  EXPECT_GT(events[1].wall_s, 0.5);
  EXPECT_LT(events[1].wall_s, 60.0);
  const casedb::AttemptRow row = casedb::find_attempt(library_, stored->attempt_id).value();
  EXPECT_LT(row.duration_s, 0.7) << "without the pause";
  EXPECT_EQ(row.conditions.pauses, 1);
  EXPECT_EQ(row.conditions.paused_s, events[1].wall_s);
  EXPECT_EQ(stored->conditions.paused_s, events[1].wall_s);
}

// What a machine that stood still for long does not make up for is told to the hands. Up to 20 ticks may be made up
// for in one turn: those of the turn that stands still come before.
TEST_F(LiveConditions, AStallThatIsNotMadeUpForIsTold) {
  int ticks = 0, told = 0, told_after_it = 0;
  const auto stored = attempt().run({.hands =
                                         [&](const cases::State&, const cases::FrameTruth*) {
                                           ++ticks;
                                           if (ticks == 100) {
                                             told = 0;
                                             std::this_thread::sleep_for(std::chrono::milliseconds(60));
                                           }
                                           if (ticks == 121) told_after_it = told;
                                           return still();
                                         },
                                     .done = [&] { return ticks >= 200; },
                                     .stalled = [&] { ++told; }});
  ASSERT_TRUE(stored) << stored.error().text;
  EXPECT_GE(told_after_it, 1);
}

TEST_F(LiveConditions, APauseInWhichItIsStoppedIsKeptToo) {
  std::atomic<std::uint64_t> ticks{0}, turns{0};
  const auto stored = attempt().run({.hands = [](const cases::State&, const cases::FrameTruth*) { return still(); },
                                     .note =
                                         [&](const cases::State&) {
                                           ++ticks;
                                           return cases::EventKind::none;
                                         },
                                     .done = [&] { return turns > 200; },
                                     .paused = [&] { return ticks >= 100 && ++turns > 0; }});
  ASSERT_TRUE(stored) << stored.error().text;
  const std::vector<cases::Event> events = events_of(stored->attempt_id);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].kind, cases::EventKind::paused);
  EXPECT_GT(events[0].wall_s, 0.1);
}

TEST_F(LiveConditions, WhatIsKnownIsInTheLibraryWhileItRuns) {
  std::atomic<bool> over{false};
  std::atomic<int> rate{10};
  std::string id;
  std::atomic<bool> opened{false};
  std::thread runs([&] {
    const auto stored =
        attempt().run({.hands = [](const cases::State&, const cases::FrameTruth*) { return still(); },
                       .opened =
                           [&](const std::string& attempt_id) {
                             id = attempt_id;
                             opened = true;
                           },
                       .done = [&] { return over.load(); },
                       .conditions =
                           [&] {
                             casedb::Conditions conditions;
                             conditions.help_level = 1;
                             conditions.window_rate_hz = rate.load();
                             return conditions;
                           }});
    EXPECT_TRUE(stored);
  });
  EXPECT_TRUE(fixtures::until([&] { return opened.load(); }));
  casedb::Library another = std::move(casedb::Library::open(folder_).value());
  const auto known = [&] {
    return casedb::read_conditions(casedb::question(another.database(), "conditions_of_open_attempt"), id);
  };
  EXPECT_TRUE(fixtures::until([&] { return known().help_level == 1 && known().window_rate_hz == 10.0; }));
  rate = 20;
  EXPECT_TRUE(fixtures::until([&] { return known().window_rate_hz == 20.0; })) << "with the next piece";
  rate = 30;
  over = true;
  runs.join();
  const casedb::Conditions kept = casedb::find_conditions(library_, id);
  EXPECT_EQ(kept.window_rate_hz, 30.0);
  EXPECT_EQ(kept.help_level, 1);
}

}  // namespace
}  // namespace seldinger::session
