// Attempts that a crash interrupted: what is left of them is replayed, and they go on.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <glm/geometric.hpp>

#include "app/attempts/this_program.h"
#include "session/attempt/interrupted_attempt.h"
#include "session/attempt/replayed_attempt.h"
#include "session/attempt/simulated_attempt.h"
#include "session/attempt/simulated_people.h"
#include "session/attempt/simulation.h"
#include "sim/engine/step.h"
#include "sim/volume/analytic.h"
#include "tests/fixtures/meshes.h"
#include "tests/fixtures/places.h"
#include "tests/fixtures/until.h"

namespace seldinger::session {
namespace {

class ResumeTest : public testing::Test {
 protected:
  std::filesystem::path folder_ = [] {
    const auto folder =
        fixtures::test_out_dir() / "resume" / testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::remove_all(folder);
    return folder;
  }();
  std::string case_id_;

  void SetUp() override {
    casedb::Library library = std::move(casedb::Library::open_or_create(folder_).value());
    volume::AnalyticVolume analytic;
    analytic.size_voxels = {60, 60, 60};
    analytic.spacing_mm = {2, 2, 2};
    analytic.origin_mm = {-59, -59, -59};
    analytic.shapes.push_back({volume::Sphere{{0, 0, 0}, 50.0}, 50.0, ""});
    casedb::NewCase made;
    made.title = "Ball";
    made.origin = "import";
    made.no_burned_in_text = true;
    made.volume = volume::rasterize(analytic);
    made.skin = fixtures::sphere_mesh({0, 0, 0}, 50.0, 4);
    case_id_ = casedb::add_case(library, made);
    cases::Lesion lesion;
    lesion.center_lps_mm = {0.0, -25.0, 0.0};
    lesion.radius_mm = 6.0;
    lesion.hu = 20.0;
    ASSERT_TRUE(casedb::add_lesion(library, case_id_, lesion));
  }
  casedb::Library open() const { return std::move(casedb::Library::open(folder_).value()); }

  // Another process makes an attempt in real time and is killed once so much of it is stored.
  void die_in_the_middle(const std::string& profile, std::uint64_t seed, int chunks) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      auto library = casedb::Library::open(folder_);
      auto simulation = Simulation::prepare(*library, app::this_program(), case_id_, "");
      static_cast<void>(simulation->live_attempt(*assessment::named_profile(profile), seed));
      ::_exit(0);
    }
    casedb::Library library = open();
    const auto stored = [&] {
      const auto attempts = casedb::list_open_attempts(library);
      return attempts.empty() ? 0 : attempts[0].chunks;
    };
    EXPECT_TRUE(fixtures::until([&] { return stored() >= chunks; }, 2 * fixtures::kPatienceS, 0.02));
    ASSERT_EQ(::kill(child, SIGKILL), 0);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status)) << "it has ended by itself";
    ASSERT_GE(stored(), chunks);
  }
  // One that nobody is at, with that recording.
  std::string leave_behind(casedb::Library& library, const cases::Recording& recording) {
    auto task = prepare_task(library, case_id_, "");
    EXPECT_TRUE(task);
    const auto id = casedb::open_attempt(library, head_of(*task, app::this_program(), "novice", 3, std::nullopt));
    EXPECT_TRUE(id);
    for (const cases::RecordingChunk& chunk : cases::chunks_from_recording(recording))
      EXPECT_TRUE(casedb::add_chunk(library, *id, chunk));
    return *id;
  }
  cases::Recording recording_of(const Task& task, std::size_t ticks) const {
    cases::Recording whole =
        run_attempt(task.scene, task.plan, *assessment::named_profile("novice"), stream_of_operator("novice", 3));
    EXPECT_GT(whole.inputs.size(), ticks);
    const double end_s = static_cast<double>(ticks) * whole.dt_s;
    whole.inputs.resize(ticks);
    whole.hashes.resize(ticks);
    const auto cut = [&](auto& rows) {
      std::erase_if(rows, [&](const auto& row) { return row.t_s > end_s + 0.5 * whole.dt_s; });
    };
    cut(whole.poses);
    cut(whole.forces);
    cut(whole.frames);
    cut(*whole.events);
    whole.endpoint.reset();
    return whole;
  }
};

TEST_F(ResumeTest, AfterAKillTheAttemptGoesOnAndIsOneRecording) {
  ASSERT_NO_FATAL_FAILURE(die_in_the_middle("novice", 3, 2));
  casedb::Library library = open();
  const std::string id = casedb::list_open_attempts(library).at(0).attempt_id;
  const cases::Recording before = casedb::load_open_recording(library, id).value();
  fixtures::let_pass(0.3);  // as long as nobody is at it: the gap is recorded

  auto interrupted = InterruptedAttempt::take(library, id);
  ASSERT_TRUE(interrupted) << interrupted.error().text;
  EXPECT_EQ(interrupted->ticks(), before.inputs.size());
  EXPECT_TRUE(close_interrupted_attempts(library).empty()) << "who goes on with it holds it";
  EXPECT_EQ(InterruptedAttempt::take(library, id).error().code, "attempt_runs");
  auto simulation = Simulation::prepare(library, app::this_program(), case_id_, "");
  ASSERT_TRUE(simulation);
  const auto made = simulation->resume(std::move(*interrupted), *assessment::named_profile("novice"));
  ASSERT_TRUE(made) << made.error().text;
  EXPECT_EQ(made->attempt_id, id);
  EXPECT_EQ(made->operator_name, "novice");
  EXPECT_EQ(made->seed, 3U);
  EXPECT_TRUE(casedb::list_open_attempts(library).empty());

  const auto row = casedb::find_attempt(library, id);
  ASSERT_TRUE(row);
  EXPECT_NE(row->end, casedb::AttemptEnd::interrupted);
  EXPECT_FALSE(row->metrics.empty());
  ASSERT_TRUE(row->away_s);
  EXPECT_GE(*row->away_s, 0.3);
  EXPECT_LT(*row->away_s, 60.0);
  const cases::Recording whole = casedb::load_recording(library, id).value();
  ASSERT_GT(whole.inputs.size(), before.inputs.size());
  EXPECT_TRUE(std::equal(before.hashes.begin(), before.hashes.end(), whole.hashes.begin()));
  EXPECT_EQ(whole.poses.size(), (whole.inputs.size() + cases::kPoseTicks - 1) / cases::kPoseTicks);
  EXPECT_TRUE(std::is_sorted(whole.frames.begin(), whole.frames.end(),
                             [](const auto& a, const auto& b) { return a.t_s < b.t_s; }));
  // The place is marked once: in the first tick that nobody had known of.
  std::vector<cases::Event> marks;
  for (const cases::Event& event : *whole.events)
    if (event.kind == cases::EventKind::resumed) marks.push_back(event);
  ASSERT_EQ(marks.size(), 1U);
  EXPECT_NEAR(marks[0].t_s, static_cast<double>(before.inputs.size() + 1) * before.dt_s, 0.02);
  // No tool leaps: a hand goes on from where it was.
  const auto& a = whole.inputs[before.inputs.size() - 1];
  const auto& b = whole.inputs[before.inputs.size()];
  EXPECT_LT(glm::length(a.needle.position_lps_mm - b.needle.position_lps_mm), 0.5);
  EXPECT_LT(glm::length(a.probe.position_lps_mm - b.probe.position_lps_mm), 0.5);
  const auto task = prepare_task(library, case_id_, "");
  ASSERT_TRUE(task);
  EXPECT_TRUE(replay(task->scene, whole).same) << "over the gap, too";
}

TEST_F(ResumeTest, WhatIsReplayedIsTheStateThatWasLeft) {
  casedb::Library library = open();
  const auto task = prepare_task(library, case_id_, "");
  ASSERT_TRUE(task);
  const cases::Recording recording = recording_of(*task, 5000);
  const std::string id = leave_behind(library, recording);
  auto interrupted = InterruptedAttempt::take(library, id);
  ASSERT_TRUE(interrupted);
  std::uint64_t told = 0;
  ASSERT_TRUE(interrupted->replay(
      task->scene, [&](const cases::State& before, const cases::Inputs&) { EXPECT_EQ(before.tick, told++); }));
  EXPECT_EQ(told, 5000U);
  // The same, tick by tick, but for the arms: of them a recording keeps what they read.
  const engine::Tick tick(task->scene);
  engine::TickState now;
  for (const cases::Inputs& inputs : recording.inputs) tick.advance(inputs, recording.dt_s, now);
  now.arms = {{recording.inputs.back().needle, true}, {recording.inputs.back().probe, true}};
  EXPECT_EQ(engine::tick_state_hash(interrupted->now()), engine::tick_state_hash(now));
}

TEST_F(ResumeTest, WhatCannotGoOnIsRefusedAndStaysOpen) {
  casedb::Library library = open();
  const auto task = prepare_task(library, case_id_, "");
  ASSERT_TRUE(task);
  EXPECT_EQ(InterruptedAttempt::take(library, std::string(36, 'x')).error().code, "no_attempt");
  const cases::Recording recording = recording_of(*task, 4000);
  {
    const auto id = casedb::open_attempt(library, head_of(*task, app::this_program(), "novice", 3, std::nullopt));
    ASSERT_TRUE(id);
    EXPECT_FALSE(is_interrupted(library, casedb::list_open_attempts(library).at(0)));
    EXPECT_EQ(InterruptedAttempt::take(library, *id).error().code, "nothing_recorded");
  }
  const auto refusal = [&](const cases::Recording& wrong) {
    const std::string id = leave_behind(library, wrong);
    auto interrupted = InterruptedAttempt::take(library, id);
    EXPECT_TRUE(interrupted);
    const auto replayed = interrupted->replay(task->scene);
    return replayed ? std::string() : replayed.error().code;
  };
  EXPECT_EQ(refusal(recording), "");
  cases::Recording wrong = recording;
  wrong.step_version = engine::kStepVersion + 1;
  EXPECT_EQ(refusal(wrong), "step_version");
  wrong = recording;
  wrong.hashes[3999] ^= 1U;
  EXPECT_EQ(refusal(wrong), "not_the_same");
  wrong = recording;
  wrong.poses[200].tip_lps_mm.x += 1e-9;
  EXPECT_EQ(refusal(wrong), "not_the_same");
  ASSERT_FALSE(recording.forces.empty());
  wrong = recording;
  wrong.forces[300].probe_n += 1e-9;
  EXPECT_EQ(refusal(wrong), "not_the_same") << "what hands felt is no part of the chained hash";
  EXPECT_EQ(casedb::list_open_attempts(library).size(), 6U) << "they are there to be closed";
  EXPECT_EQ(close_interrupted_attempts(library).size(), 6U);
}

TEST_F(ResumeTest, AnAttemptAtAnotherTaskIsNotGoneOnWith) {
  casedb::Library library = open();
  const auto task = prepare_task(library, case_id_, "");
  ASSERT_TRUE(task);
  const std::string id = leave_behind(library, recording_of(*task, 2000));
  auto interrupted = InterruptedAttempt::take(library, id);
  ASSERT_TRUE(interrupted);
  auto other = Simulation::prepare(library, app::this_program(), case_id_, "", cases::InstrumentKind::core);
  ASSERT_TRUE(other);
  EXPECT_EQ(other->resume(std::move(*interrupted), *assessment::named_profile("novice")).error().code,
            "other_case");
}

// Two programs look what is there, and then both make it.
TEST_F(ResumeTest, OfTwoRunsOfTheSamePeopleOneStoresAnAttempt) {
  const PeopleWish wish{*assessment::population::named_group("novice"), 5, 2};
  casedb::Library one = open(), other = open();
  auto first = Simulation::prepare(one, app::this_program(), case_id_, "");
  auto second = Simulation::prepare(other, app::this_program(), case_id_, "");
  ASSERT_TRUE(first && second);
  const StoredPeople asked = people_trials(one, wish, first->task()),
                     again = people_trials(other, wish, second->task());
  ASSERT_EQ(asked.trials.size(), 2U);
  ASSERT_EQ(again.trials.size(), 2U) << "none was there yet";
  std::vector<SimulatedAttempt> made, told;
  ASSERT_TRUE(first->attempts(asked.trials, 1, false, [&](SimulatedAttempt a) { made.push_back(std::move(a)); }));
  ASSERT_TRUE(second->attempts(again.trials, 1, false, [&](SimulatedAttempt a) { told.push_back(std::move(a)); }));
  EXPECT_EQ(casedb::count_attempts(one), 2U);
  ASSERT_EQ(told.size(), 2U);
  for (std::size_t i = 0; i < told.size(); ++i) EXPECT_EQ(told[i].attempt_id, made[i].attempt_id);
  EXPECT_EQ(people_trials(one, wish, first->task()).there.size(), 2U);
}

}  // namespace
}  // namespace seldinger::session
