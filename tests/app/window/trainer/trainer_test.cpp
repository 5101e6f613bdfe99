// The workstation without its window: from logging in to the debrief.
#include <gtest/gtest.h>

#include <filesystem>

#include "casedb/database/audit.h"
#include "casedb/database/sqlite.h"
#include "casedb/grading/curriculum.h"
#include "casedb/people/noted_tries.h"
#include "tests/app/window/trainer/trainer_case.h"

namespace seldinger::app {
namespace {

// Whether five wrong passwords let even the right one wait; again where a busy machine took longer than the wait.
bool waits_after_five(Trainer& trainer) {
  return until([&] {
    if (trainer.screen() != TrainerScreen::log_in) trainer.log_out();
    for (int i = 0; i < 5; ++i) trainer.log_in("mona", "another password");
    EXPECT_EQ(trainer.screen(), TrainerScreen::log_in);
    EXPECT_EQ(trainer.refusal(), "The name or password is wrong.");
    trainer.log_in("mona", kPassword);
    return trainer.screen() == TrainerScreen::log_in && trainer.refusal() == "Too many tries. Try again in 1 s.";
  });
}

// Was: as many passwords as one likes, at once.
TEST_F(TrainerTest, PasswordsAreTriedNoFasterThanOnTheDashboard) {
  Trainer trainer(open());
  ASSERT_TRUE(waits_after_five(trainer)) << trainer.refusal();
  trainer.log_in("tina", kPassword);
  EXPECT_EQ(trainer.screen(), TrainerScreen::choose) << "another name does not wait";
  trainer.log_out();
  EXPECT_TRUE(until([&] {
    trainer.log_in("mona", kPassword);
    return trainer.screen() == TrainerScreen::choose;
  }));
}

TEST_F(TrainerTest, WhomACommandLetsInAgainIsIn) {
  Trainer trainer(open());
  ASSERT_TRUE(waits_after_five(trainer)) << trainer.refusal();
  {
    casedb::Library library = open();
    ASSERT_TRUE(casedb::let_in_again(library, "mona"));
  }
  trainer.log_in("mona", kPassword);
  EXPECT_EQ(trainer.screen(), TrainerScreen::choose);
}

TEST_F(TrainerTest, OnlyAnAccountGetsInAndATraineeSeesNoDraft) {
  Trainer trainer(open());
  trainer.log_in("mona", "another password");
  EXPECT_EQ(trainer.screen(), TrainerScreen::log_in);
  EXPECT_FALSE(trainer.refusal().empty());
  trainer.log_in("tina", kPassword);
  EXPECT_EQ(trainer.screen(), TrainerScreen::choose);
  EXPECT_TRUE(trainer.choices().empty()) << "the case is a draft";
  trainer.choose(case_id_);
  EXPECT_EQ(trainer.screen(), TrainerScreen::choose) << "what cannot be chosen is not";
  trainer.log_out();
  EXPECT_TRUE(trainer.drafts().empty());
  trainer.log_in("mona", kPassword);
  EXPECT_TRUE(trainer.choices().empty()) << "a draft is for the case editor";
  ASSERT_EQ(trainer.drafts().size(), 1U);
  EXPECT_EQ(trainer.drafts()[0].title, "Ball");
}

// Was: thrown with the account still logged in.
TEST_F(TrainerTest, WhoLogsOutIsOutThoughTheLibraryCannotKeepIt) {
  Trainer trainer(open());
  trainer.log_in("mona", kPassword);
  ASSERT_EQ(trainer.screen(), TrainerScreen::choose);
  casedb::Library library = open();
  library.database().run("BEGIN IMMEDIATE");
  EXPECT_NO_THROW(trainer.log_out());
  EXPECT_EQ(trainer.screen(), TrainerScreen::log_in);
  EXPECT_TRUE(trainer.account().person_id.empty());
  EXPECT_NE(trainer.refusal().find("could not record it"), std::string::npos) << trainer.refusal();
  library.database().run("ROLLBACK");
}

// Before, no log-in at a workstation left a trace, and a new version was nobody's but by its name.
TEST_F(TrainerTest, WhoLogsInAndDecidesIsInTheAuditLog) {
  Trainer trainer(open());
  casedb::Library library = open();
  const std::size_t before = casedb::list_audit(library).size();
  trainer.log_in("mona", "another password");
  trainer.log_in("mona", kPassword);
  trainer.new_version(case_id_);
  trainer.log_out();
  std::vector<std::string> told;
  for (const casedb::AuditRow& row : casedb::list_audit(library))
    if (row.sequence > static_cast<std::int64_t>(before))
      told.push_back(row.act + " " + row.actor + " " + row.result);
  EXPECT_EQ(told, (std::vector<std::string>{"log_in nobody refused", "log_in person done",
                                            "make_case_version person done", "log_out person done"}));
  const auto decisions = casedb::list_decisions(library, casedb::list_cases(library).back().case_id);
  ASSERT_FALSE(decisions.empty());
  EXPECT_EQ(decisions.back().by_operator, false);
}

// A mentor tries what is in the case editor: graded, and no attempt is kept, so that it can be changed afterwards.
TEST_F(TrainerTest, ADraftIsTriedAndStaysADraft) {
  Trainer trainer(open());
  trainer.log_in("tina", kPassword);
  trainer.open_editor(case_id_);
  trainer.new_version(case_id_);
  EXPECT_EQ(trainer.screen(), TrainerScreen::choose) << "no case editor for a trainee";
  EXPECT_EQ(trainer.editor(), nullptr);
  trainer.log_out();
  trainer.log_in("mona", kPassword);
  trainer.open_editor(case_id_);
  ASSERT_EQ(trainer.screen(), TrainerScreen::editor);
  trainer.try_draft();
  EXPECT_TRUE(trainer.trying());
  ASSERT_TRUE(ready(trainer)) << trainer.refusal();
  ASSERT_TRUE(trainer.begin(false));
  PersonAttempt& attempt = *trainer.attempt();
  ASSERT_NO_FATAL_FAILURE(fire_at_the_target(attempt));
  attempt.end();
  ASSERT_TRUE(looks_until(trainer, TrainerScreen::debrief)) << trainer.refusal();
  EXPECT_EQ(trainer.debrief()->grade.grade.verdict, assessment::Verdict::passed);
  EXPECT_FALSE(trainer.debrief()->steps.empty());
  trainer.back();
  ASSERT_EQ(trainer.screen(), TrainerScreen::editor);
  auto library = open();
  EXPECT_TRUE(casedb::list_attempts(library).empty());
  EXPECT_TRUE(casedb::list_open_attempts(library).empty());
  CaseEditor& editor = *trainer.editor();
  cases::LesionForm form = editor.lesions().at(0).form;
  form.radii_mm = glm::dvec3(7.0);
  EXPECT_TRUE(editor.put_lesion(0, form)) << editor.refusal();
  trainer.leave_editor();
  EXPECT_EQ(trainer.screen(), TrainerScreen::choose);
}

TEST_F(TrainerTest, AnAttemptIsMadeGradedAndWatchedAgain) {
  publish();
  Trainer trainer(open());
  trainer.log_in("mona", kPassword);
  trainer.choose(case_id_);
  ASSERT_EQ(trainer.screen(), TrainerScreen::briefing);
  EXPECT_FALSE(trainer.begin(false)) << "not prepared yet";
  EXPECT_LT(trainer.prepared(), 1.0);
  EXPECT_EQ(trainer.help(), 2) << "an easy case that was not passed yet";
  ASSERT_TRUE(ready(trainer)) << trainer.refusal();
  EXPECT_EQ(trainer.prepared(), 1.0);
  ASSERT_TRUE(trainer.begin(false));
  PersonAttempt& attempt = *trainer.attempt();
  for (const cases::EventKind kind :
       {cases::EventKind::proceed, cases::EventKind::aspirate, cases::EventKind::anaesthetic})
    EXPECT_TRUE(attempt.say(kind));
  ASSERT_NO_FATAL_FAILURE(fire_at_the_target(attempt));
  session::ShownPicture shown;
  EXPECT_TRUE(until([&] { return attempt.monitor().take(shown) && shown.picture.width_px > 0; })) << "a picture";
  attempt.say(cases::EventKind::sign_out);
  attempt.end();
  ASSERT_TRUE(looks_until(trainer, TrainerScreen::debrief)) << trainer.refusal();
  const Debrief& debrief = *trainer.debrief();
  EXPECT_EQ(debrief.grade.grade.verdict, assessment::Verdict::passed);
  EXPECT_FALSE(debrief.attempt.synthetic());
  EXPECT_EQ(debrief.attempt.person_id, trainer.account().person_id);
  EXPECT_EQ(debrief.attempt.end, casedb::AttemptEnd::fired);
  EXPECT_FALSE(debrief.grade.debrief.empty());
  for (const assessment::StepResult& step : debrief.steps) {
    const bool said =
        step.id == "sign_in" || step.id == "decide" || step.id == "anaesthetise" || step.id == "sign_out";
    EXPECT_TRUE(!said || step.state == assessment::StepState::done) << step.id;
  }

  trainer.watch(debrief.attempt.attempt_id);
  ASSERT_EQ(trainer.screen(), TrainerScreen::watch);
  session::WatchedAttempt& watched = *trainer.watched();
  watched.set_speed(50.0);
  ASSERT_TRUE(until([&] { return watched.phase() == session::WatchedAttempt::Phase::over; }));
  std::optional<engine::Moment> last;
  while (const auto moment = watched.moment()) last = moment;
  ASSERT_TRUE(last);
  const std::uint64_t all_ticks = last->state.tick;
  // Back and forth by time, standing still there; the same at the end however one came there.
  watched.set_speed(0.0);
  const auto stands_at = [&](double t_s) {
    return until([&] {
      while (const auto moment = watched.moment()) last = moment;
      return std::abs(last->state.t_s - t_s) < 0.002;
    });
  };
  watched.go_to(0.5 * watched.duration_s());
  EXPECT_TRUE(stands_at(0.5 * watched.duration_s())) << last->state.t_s;
  EXPECT_TRUE(until([&] { return watched.phase() == session::WatchedAttempt::Phase::playing; }));
  watched.go_to(0.25 * watched.duration_s());
  EXPECT_TRUE(stands_at(0.25 * watched.duration_s())) << last->state.t_s;
  watched.go_to(10.0 * watched.duration_s());
  ASSERT_TRUE(until([&] { return watched.phase() == session::WatchedAttempt::Phase::over; }));
  while (const auto moment = watched.moment()) last = moment;
  EXPECT_EQ(last->state.tick, all_ticks);
  EXPECT_TRUE(last->state.fire.fired);
  EXPECT_EQ(last->state.fire.tip_lps_mm, watched.recording()->endpoint->tip_lps_mm) << "the very same";
  trainer.stop_watching();
  EXPECT_EQ(trainer.screen(), TrainerScreen::debrief);
  trainer.again();
  EXPECT_EQ(trainer.help(), 1) << "help fades at once";
  trainer.back();
  ASSERT_EQ(trainer.choices().size(), 1U);
  EXPECT_EQ(trainer.choices()[0].attempts, 1);
  EXPECT_EQ(trainer.choices()[0].passes, 1);
  trainer.choose(case_id_);
  EXPECT_EQ(trainer.help(), 1) << "help fades";
}

// What the console was turned to is in the recording, and what is told of the pictures is of them as they stood.
TEST_F(TrainerTest, TheConsoleThatWasTurnedIsRecordedToldAndWatched) {
  publish();
  Trainer trainer(open());
  ASSERT_NO_FATAL_FAILURE(begin(trainer, "mona", false));
  PersonAttempt& attempt = *trainer.attempt();
  HandsTold told;
  session::ShownPicture shown;
  const auto stands_at = [&](double slice_mm) {
    told.console.slice_mm = slice_mm;
    attempt.tell(told);
    return until([&] { return attempt.monitor().take(shown) && shown.console.slice_mm == slice_mm; });
  };
  const auto wait_s = [&](double seconds) {
    double from_s = -1.0;
    return until([&] {
      const auto seen = attempt.seen();
      if (seen && from_s < 0.0) from_s = seen->moment.state.t_s;
      return seen && seen->moment.state.t_s > from_s + seconds;
    });
  };
  ASSERT_TRUE(stands_at(0.0) && wait_s(0.3));
  const session::GreyPicture plane = shown.picture;
  ASSERT_TRUE(stands_at(30.0) && wait_s(0.3));
  EXPECT_NE(shown.picture.grey, plane.grey);
  attempt.monitor().set_window(session::kHuWindows[3]);
  const session::GreyPicture soft = shown.picture;
  EXPECT_TRUE(until([&] { return attempt.monitor().take(shown) && shown.picture.grey != soft.grey; }));
  attempt.end();
  ASSERT_TRUE(looks_until(trainer, TrainerScreen::debrief)) << trainer.refusal();
  trainer.watch(trainer.debrief()->attempt.attempt_id);
  session::WatchedAttempt& watched = *trainer.watched();
  watched.set_speed(50.0);
  ASSERT_TRUE(until([&] { return watched.phase() == session::WatchedAttempt::Phase::over; }));
  std::optional<engine::Moment> last;
  while (const auto moment = watched.moment()) last = moment;
  ASSERT_TRUE(last);
  EXPECT_EQ(last->state.probe.console.slice_mm, 30.0);
  const std::shared_ptr<const cases::Recording> kept = watched.recording();
  const cases::Recording& recording = *kept;
  double turned_s = 0.0;
  for (std::size_t i = 0; i < recording.inputs.size() && turned_s == 0.0; ++i)
    if (recording.inputs[i].console.slice_mm != 0.0) turned_s = static_cast<double>(i + 1) * recording.dt_s;
  ASSERT_GT(turned_s, 0.3);
  int seen = 0, passed = 0;
  for (const cases::FrameTruth& frame : recording.frames) {
    EXPECT_EQ(frame.target, frame.t_s < turned_s) << frame.t_s << ": the target lies in the probe's plane";
    (frame.t_s < turned_s ? seen : passed) += 1;
  }
  EXPECT_GT(seen, 3);
  EXPECT_GT(passed, 3);
}

TEST_F(TrainerTest, ACaseOfTheWorkstationIsOpenAtLogInOrItIsSaidWhyNot) {
  Trainer trainer(open());
  const auto unknown = trainer.open_at_log_in("no such case");
  ASSERT_TRUE(unknown);
  EXPECT_EQ(unknown->code, "no_case");
  EXPECT_FALSE(trainer.open_at_log_in(case_id_));
  trainer.log_in("mona", kPassword);
  EXPECT_EQ(trainer.screen(), TrainerScreen::editor) << "a mentor's draft";
  trainer.log_out();
  trainer.log_in("tina", kPassword);
  EXPECT_EQ(trainer.screen(), TrainerScreen::choose) << "a draft is not hers";
  EXPECT_NE(trainer.refusal().find("tina"), std::string::npos) << trainer.refusal();
  trainer.log_out();
  publish();
  trainer.log_in("tina", kPassword);
  EXPECT_EQ(trainer.screen(), TrainerScreen::briefing);
  EXPECT_EQ(trainer.chosen().case_id, case_id_);
  EXPECT_TRUE(trainer.refusal().empty());
}

TEST_F(TrainerTest, WhatIsDueComesNextAndAttemptsAreUsedUp) {
  {
    casedb::Library library = open();
    ASSERT_TRUE(casedb::add_user(library, "dora", casedb::Role::director, kPassword));
    ASSERT_TRUE(
        casedb::publish_case(library, case_id_, session::check_case(library, case_id_).value(), "mona", true));
    const std::string id = casedb::add_curriculum(library, "First", "mona").value();
    ASSERT_TRUE(casedb::add_curriculum_item(library, id, case_id_, 1, {}, "mona"));
    ASSERT_TRUE(casedb::publish_curriculum(library, id, "dora"));
  }
  Trainer trainer(open());
  trainer.log_in("tina", kPassword);
  ASSERT_NE(trainer.next(), nullptr);
  EXPECT_EQ(trainer.next()->case_id, case_id_);
  trainer.choose(std::string(trainer.next()->case_id));
  ASSERT_TRUE(ready(trainer)) << trainer.refusal();
  EXPECT_TRUE(trainer.once_more());
  ASSERT_TRUE(trainer.begin(false));
  ASSERT_TRUE(until([&] { return trainer.attempt()->seen().has_value(); }));
  trainer.attempt()->end();
  ASSERT_TRUE(looks_until(trainer, TrainerScreen::debrief)) << trainer.refusal();
  EXPECT_FALSE(trainer.once_more()) << "one was all";
  EXPECT_EQ(trainer.next(), nullptr);
  trainer.again();
  EXPECT_EQ(trainer.screen(), TrainerScreen::debrief);
}

TEST_F(TrainerTest, BeginningAgainKeepsWhatWasDoneAndIsReadyAtOnce) {
  publish();
  {
    Trainer trainer(open());
    ASSERT_NO_FATAL_FAILURE(begin(trainer, "mona", true));
    ASSERT_TRUE(until([&] { return trainer.attempt()->seen().has_value(); }));
    const auto task = trainer.attempt()->task();
    trainer.again();
    EXPECT_TRUE(trainer.restarting());
    ASSERT_TRUE(ready(trainer));
    EXPECT_EQ(trainer.attempt()->task(), task) << "nothing is loaded twice";
    ASSERT_TRUE(trainer.begin(true));
    ASSERT_TRUE(until([&] { return trainer.attempt()->seen().has_value(); }));
  }  // and a workstation that goes away in the middle
  auto library = open();
  const auto attempts = casedb::list_attempts(library);
  ASSERT_EQ(attempts.size(), 2U);
  for (const casedb::AttemptRow& attempt : attempts) {
    EXPECT_EQ(attempt.end, casedb::AttemptEnd::stopped);
    EXPECT_GT(attempt.duration_s, 0.0);
  }
  EXPECT_TRUE(casedb::list_open_attempts(library).empty());
}

}  // namespace
}  // namespace seldinger::app
