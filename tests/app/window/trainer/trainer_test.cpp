// The workstation without its window: from logging in to the debrief, with hands that are told what to want.
#include "app/window/trainer/trainer.h"

#include <gtest/gtest.h>

#include <filesystem>

#include <functional>
#include <glm/geometric.hpp>
#include <thread>
#include "casedb/cases/versions.h"
#include "casedb/grading/curriculum.h"
#include "session/case/case_check.h"
#include "tests/fixtures/cohort.h"
#include "tests/fixtures/folders.h"
#include "tests/fixtures/new_ball.h"
#include "tests/fixtures/until.h"

#include "app/attempts/this_program.h"
#include "casedb/cases/versions.h"
#include "casedb/database/sqlite.h"
#include "session/attempt/replayed_attempt.h"
#include "sim/engine/step.h"
#include "sim/volume/analytic.h"
#include "tests/fixtures/meshes.h"

namespace seldinger::app {
namespace {

using fixtures::until;
using Phase = PersonAttempt::Phase;
constexpr const char* kPassword = "a long password";

class TrainerTest : public testing::Test {
 protected:
  // A ball of soft tissue, practised by slices; its target 25 mm below the skin.
  static constexpr double kDepthMm = 25.0;
  std::filesystem::path folder_ = fixtures::fresh_test_folder("app") / "library";
  std::string case_id_;

  void SetUp() override {
    casedb::Library library = std::move(casedb::Library::open_or_create(folder_).value());
    case_id_ = casedb::add_case(library, fixtures::new_ball());
    ASSERT_TRUE(casedb::add_lesion(library, case_id_, fixtures::ball_target(kDepthMm)));
    ASSERT_TRUE(casedb::add_user(library, "mona", casedb::Role::mentor, kPassword));
    ASSERT_TRUE(casedb::add_user(library, "tina", casedb::Role::trainee, kPassword));
    fixtures::make_cohort(library, "mona", {"tina"});
  }
  void publish() {
    casedb::Library library = open();
    ASSERT_TRUE(
        casedb::publish_case(library, case_id_, session::check_case(library, case_id_).value(), "mona", true));
  }
  casedb::Library open() { return std::move(casedb::Library::open(folder_).value()); }
  bool looks_until(Trainer& trainer, TrainerScreen screen) {
    return until([&] {
      trainer.look();
      return trainer.screen() == screen;
    });
  }
  bool ready(Trainer& trainer) {
    return until([&] {
      trainer.look();
      return trainer.attempt() != nullptr && trainer.attempt()->phase() == Phase::ready;
    });
  }
  static constexpr double kTellingS = 0.02;  // from one telling of the hands to the next, as a window's frames
  // Tells the hands of one wish, and waits until they have done it.
  void advance(PersonAttempt& attempt, HandsTold& told, double to_mm) {
    Seen seen;
    const auto there = [&] {
      if (const auto newest = attempt.seen()) seen = *newest;
      const double left_mm = to_mm - seen.inserted_mm;
      if (std::abs(left_mm) < 1.0) return true;
      told.sum.advance_mm += seen.inserted ? 0.1 * left_mm : 0.5;
      told.between_s = kTellingS;
      attempt.tell(told);
      return false;
    };
    EXPECT_TRUE(until(there, fixtures::kPatienceS, kTellingS)) << seen.inserted_mm;
  }
  void fire_at_the_target(PersonAttempt& attempt) {
    HandsTold told;
    advance(attempt, told, kDepthMm);
    told.sum.fire = true;
    attempt.tell(told);
    ASSERT_TRUE(until([&] {
      const auto seen = attempt.seen();
      return seen && seen->moment.state.fire.fired;
    }));
  }
};

// Was: as many passwords as one likes, at once.
TEST_F(TrainerTest, PasswordsAreTriedNoFasterThanOnTheDashboard) {
  Trainer trainer(open());
  for (int i = 0; i < 5; ++i) trainer.log_in("mona", "another password");
  EXPECT_EQ(trainer.refusal(), "Name or password is not right.");
  trainer.log_in("mona", kPassword);
  EXPECT_EQ(trainer.screen(), TrainerScreen::log_in);
  EXPECT_EQ(trainer.refusal(), "Too many tries. Try again in 1 s.");
  trainer.log_in("tina", kPassword);
  EXPECT_EQ(trainer.screen(), TrainerScreen::choose) << "another name does not wait";
  trainer.log_out();
  EXPECT_TRUE(until([&] {
    trainer.log_in("mona", kPassword);
    return trainer.screen() == TrainerScreen::choose;
  }));
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
  EXPECT_EQ(last->state.fire.tip_lps_mm, watched.recording().endpoint->tip_lps_mm) << "the very same";
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
  trainer.log_in("mona", kPassword);
  trainer.choose(case_id_);
  ASSERT_TRUE(ready(trainer)) << trainer.refusal();
  ASSERT_TRUE(trainer.begin(false));
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
  const cases::Recording& recording = watched.recording();
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

TEST_F(TrainerTest, HandsAreShownFromAnyScreenButAnAttemptAndACalibrationIsTheNextAttempts) {
  publish();
  const auto led = LedArms::start();
  ASSERT_TRUE(led);
  Arms arms;
  arms.led = *led;
  arms.place = (*led)->place();
  arms.station_file = folder_ / "station.json";
  Trainer trainer(open(), arms);
  trainer.show_devices();
  EXPECT_EQ(trainer.screen(), TrainerScreen::devices) << "also before anybody logs in";
  trainer.leave_devices();
  EXPECT_EQ(trainer.screen(), TrainerScreen::log_in);
  trainer.log_in("mona", kPassword);
  trainer.choose(case_id_);
  ASSERT_TRUE(ready(trainer)) << trainer.refusal();
  trainer.show_devices();
  ASSERT_NE(trainer.device_page(), nullptr);
  ASSERT_TRUE(until([&] { return !trainer.device_page()->status().ids[1].arm.empty(); }));
  std::vector<devices::TakenPoint> taken;
  const devices::Placement device = devices::inverse_of(LedArms::template_from_device(1));
  for (const devices::TemplatePoint& point : devices::template_points())
    taken.push_back({point.name, device(point.template_mm)});
  ASSERT_TRUE(trainer.keep_calibration(1, *devices::calibrate(taken))) << trainer.refusal();
  const auto kept = read_station(arms.station_file);
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->at("right").calibration.points.size(), 6U);
  EXPECT_EQ(kept->at("right").ids.arm, "sim-right");
  EXPECT_EQ(kept->at("left").ids.arm, "sim-left") << "else the service would give it to nobody";
  trainer.exchange_arms();
  EXPECT_EQ(trainer.arms()->station.at("left").ids.arm, "sim-right");
  EXPECT_EQ(trainer.arms()->station.at("left").calibration.points.size(), 6U) << "it goes with its arm";
  ASSERT_TRUE(
      until([&] { return trainer.device_page()->seen().arms[0].reading.healthy; }));  // led by its id from here on
  EXPECT_EQ(trainer.device_page()->status().ids[0].arm, "sim-right");
  trainer.leave_devices();
  EXPECT_EQ(trainer.screen(), TrainerScreen::briefing) << "back where one was";
  EXPECT_EQ(trainer.device_page(), nullptr);

  // The mouse leads the arms, and these lead the tools.
  ASSERT_TRUE(trainer.begin(false));
  PersonAttempt& attempt = *trainer.attempt();
  Seen seen;
  ASSERT_TRUE(until([&] {
    if (const auto newest = attempt.seen()) seen = *newest;
    return seen.arms.used && !seen.arms.lost[0] && !seen.arms.lost[1] && !seen.by_mouse;
  }));
  HandsTold told;
  advance(attempt, told, kDepthMm);
  EXPECT_TRUE(until([&] {
    const auto newest = attempt.arms_seen();
    return newest && (*newest)[0].reading.healthy && (*newest)[0].force_n.bin(1).filled;
  })) << "what the arms do can be looked at";
  trainer.show_devices();
  EXPECT_EQ(trainer.screen(), TrainerScreen::attempt) << "not while they hold tools in a patient";
  attempt.end();
  ASSERT_TRUE(looks_until(trainer, TrainerScreen::debrief)) << trainer.refusal();
  trainer.show_devices();
  ASSERT_TRUE(until([&] {
    const ArmsSeen& now = trainer.device_page()->seen().arms;
    return now[0].reading.healthy && now[1].reading.healthy;
  })) << "the attempt has let the service go";
  // What cannot be kept is said, and nothing is changed.
  const Station before = trainer.arms()->station;
  std::filesystem::remove(arms.station_file);
  std::filesystem::create_directory(arms.station_file);
  EXPECT_FALSE(trainer.change_station([](Station& station) { station["left"].gains.force_share = 0.5; }));
  EXPECT_FALSE(trainer.refusal().empty());
  EXPECT_EQ(trainer.arms()->station.at("left").gains, before.at("left").gains);
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
    trainer.log_in("mona", kPassword);
    trainer.choose(case_id_);
    ASSERT_TRUE(ready(trainer)) << trainer.refusal();
    ASSERT_TRUE(trainer.begin(true));
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

// What led the tools, the guide, pauses and what was watched before are kept with an attempt, and its recording
// replays as if nothing of it had been noted.
TEST_F(TrainerTest, TheConditionsOfAnAttemptAreKept) {
  publish();
  Trainer trainer(open());
  trainer.log_in("mona", kPassword);
  trainer.choose(case_id_);
  ASSERT_TRUE(ready(trainer)) << trainer.refusal();
  ASSERT_TRUE(trainer.begin(true));
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
  std::this_thread::sleep_for(std::chrono::milliseconds(400));
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

// A program died while mona was at it: the needle 12 mm above the skin, the probe beside.
class InterruptedTrainerTest : public TrainerTest {
 protected:
  static constexpr std::size_t kTicks = 4000;
  std::string attempt_id_, person_id_;
  cases::Inputs left_;

  void SetUp() override {
    TrainerTest::SetUp();
    publish();
    casedb::Library library = open();
    person_id_ = casedb::log_in(library, "mona", kPassword)->person_id;
    const auto task = session::prepare_task(library, case_id_, "");
    ASSERT_TRUE(task);
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
      const cases::RecordedTick made = tick.advance_hands(left_, {}, now);
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
  EXPECT_NE(trainer.refusal().find("another task"), std::string::npos) << trainer.refusal();
  auto library = open();
  EXPECT_EQ(casedb::list_open_attempts(library).size(), 1U);
}

}  // namespace
}  // namespace seldinger::app
