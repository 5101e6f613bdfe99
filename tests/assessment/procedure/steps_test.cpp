// Tests of assessment/procedure: what of a recording completes or skips a step, and who is asked for it.
#include "assessment/procedure/steps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/assessment/procedure/exemplary_attempt.h"

namespace seldinger::assessment {
namespace {

TEST(Steps, HaveIdsOfTheirOwnAndEvidenceThatIsThere) {
  std::set<std::string> ids;
  for (const StepInfo& step : procedure_steps()) {
    EXPECT_TRUE(ids.insert(step.id).second) << step.id;
    EXPECT_EQ(find_step(step.id), &step);
    EXPECT_NE(step.completes, Evidence::none) << step.id;
  }
  for (std::size_t i = 0; i < evidence().size(); ++i)
    EXPECT_EQ(about(static_cast<Evidence>(i)).evidence, static_cast<Evidence>(i));
}

TEST(Steps, OfAnExemplaryAttemptAreAllDone) {
  for (const SampleKind& kind : {kUltrasoundCore, kUltrasoundAcross, kFluoroscopy}) {
    const SampleAttempt sample = exemplary(kind);
    int done = 0;
    for (const auto& [id, result] : walked(sample)) {
      EXPECT_TRUE(result.state == StepState::done || result.state == StepState::not_asked)
          << sample.name << ", " << id << ": " << name_of(result.state) << " at " << result.t_s.value_or(-1.0);
      EXPECT_EQ(result.reason.empty(), result.state != StepState::not_asked) << id;
      done += result.state == StepState::done ? 1 : 0;
    }
    EXPECT_GE(done, kind.modality == cases::Modality::xray ? 12 : 15) << sample.name;
  }
}

TEST(Steps, AreToldAsShownOrSaid) {
  const auto how = [](const SampleAttempt& sample, const char* id) { return walked(sample).at(id).how; };
  SampleAttempt sample = exemplary(kUltrasoundCore);
  for (const StepInfo& step : procedure_steps()) {
    const StepResult result = walked(sample).at(step.id);
    if (result.state != StepState::done) continue;
    EXPECT_EQ(result.how, step.shown() ? StepHow::shown : StepHow::said) << step.id;
  }
  for (const char* id : {"sign_in", "decide", "anaesthetise", "nick", "ask_breath_hold", "sign_out"})
    EXPECT_EQ(how(sample, id), StepHow::said) << id;
  for (const char* id : {"check_probe", "note_depth", "enter_at_angle", "insert_to_depth", "check_in_breath_hold"})
    EXPECT_EQ(how(sample, id), StepHow::shown) << id;
  EXPECT_EQ(how(sample, "find_again"), std::nullopt) << "not asked for: every hold showed the tip";
  EXPECT_EQ(walked(sample).at("find_again").reason, "no_such_event");
  EXPECT_EQ(how(exemplary(kFluoroscopy), "note_depth_under_beam"), StepHow::said);

  hold_probe_still(sample);
  leave_out(sample, EventKind::depth_measured);
  for (const char* id : {"check_probe", "note_depth"}) {
    EXPECT_EQ(how(sample, id), StepHow::said) << id;
    EXPECT_EQ(walked(sample).at(id).state, StepState::skipped) << id;
    EXPECT_FALSE(walked(sample).at(id).t_s) << id;
  }
  leave_out(sample, EventKind::probe_checked);
  EXPECT_EQ(how(sample, "check_probe"), std::nullopt) << "neither";
  leave_out(sample, EventKind::aspirate);
  EXPECT_EQ(how(sample, "anaesthetise"), std::nullopt) << "violated";
}

// Saying all and doing nothing. Before steps were shown, this raised steps_done by the probe's check and the depth.
TEST(Steps, ThatADeedCanShowAreNotDoneByBeingSaid) {
  for (const SampleKind& kind : {kUltrasoundCore, kUltrasoundAcross}) {
    SampleAttempt silent = exemplary(kind);
    silent.recording.endpoint.reset();
    for (cases::PoseSample& pose : silent.recording.poses) {
      const cases::PoseSample& first = silent.recording.poses.front();
      pose = {pose.t_s, first.tip_lps_mm, first.needle_direction, {30, -80, 0}, {0, 1, 0}, {1, 0, 0}};
    }
    for (cases::FrameTruth& frame : silent.recording.frames) frame.target = frame.needle_tip = false;
    SampleAttempt saying = silent;
    silent.recording.events = {{0.05, EventKind::calipers_recorded}};
    plan(saying, 54.0);
    double t_s = 0.1;
    for (const cases::EventInfo& info : cases::event_kinds())
      if (info.source == cases::EventSource::trainee && info.kind != EventKind::defer)
        say(saying, t_s += 0.1, info.kind);
    for (cases::Event& event : *saying.recording.events) event.tenths_mm = 600;
    const auto said = walked(saying), unsaid = walked(silent);
    for (const StepInfo& step : procedure_steps()) {
      if (!step.shown()) continue;
      EXPECT_NE(said.at(step.id).state, StepState::done) << step.id;
      EXPECT_NE(unsaid.at(step.id).state, StepState::done) << step.id;
    }
    EXPECT_EQ(counted(saying).at("steps_shown"), 0.0) << saying.name;
    EXPECT_EQ(counted(silent).at("steps_shown"), 0.0) << saying.name;
    EXPECT_GT(counted(saying).at("steps_done"), counted(silent).at("steps_done")) << "what is taken at its word";
    EXPECT_EQ(counted(silent).count("steps_violated"), 0U) << "nothing_done; was 0, the best there is";
    EXPECT_EQ(counted(silent).count("pain_reactions"), 0U) << "never_in_tissue; was 0, the best there is";
  }
}

// What was recorded before calipers were is neither done nor left out.
TEST(Steps, OfCalipersAreNotAskedForWhereNobodyRecordedThem) {
  SampleAttempt sample = exemplary(kUltrasoundCore);
  leave_out(sample, EventKind::calipers_recorded);
  leave_out(sample, EventKind::depth_measured);
  plan(sample, 0.0);
  for (const char* id : {"note_depth", "insert_to_depth"}) {
    EXPECT_EQ(walked(sample).at(id).state, StepState::not_asked) << id;
    EXPECT_EQ(walked(sample).at(id).reason, "calipers_not_recorded") << id;
  }
  EXPECT_EQ(counted(sample).at("steps_done"), 1.0);
  EXPECT_EQ(counted(sample).at("steps_shown"), 1.0);
}

// Breath and jiggle are told of who lies still as ever, and do not count.
TEST(Steps, OfBreathCountWhereTissueMovesOnly) {
  SampleAttempt moving = exemplary(kUltrasoundCore);
  EXPECT_EQ(counted(moving).at("steps_done"), 1.0);
  SampleAttempt still = moving;
  still.setting.breathes = still.setting.yields = false;
  EXPECT_EQ(walked(still).at("hold_before_organ").reason, "patient_lies_still");
  EXPECT_EQ(walked(still).at("fire_in_breath_hold").reason, "patient_lies_still");
  for (const char* id : {"ask_breath_hold", "check_in_breath_hold", "jiggle"})
    EXPECT_EQ(walked(still).at(id), walked(moving).at(id)) << id;
  for (SampleAttempt* one : {&moving, &still}) {
    leave_out(*one, EventKind::breath_hold_request);
    leave_out(*one, EventKind::breath_held);
    for (auto& pose : one->recording.poses)  // no jiggle
      if (pose.t_s > 2.99 && pose.t_s < 3.61) pose.tip_lps_mm = one->recording.poses[300].tip_lps_mm;
    for (const char* id : {"ask_breath_hold", "check_in_breath_hold", "jiggle"})
      EXPECT_EQ(walked(*one).at(id).state, StepState::skipped) << id;
  }
  EXPECT_EQ(counted(still).at("steps_done"), 1.0);
  EXPECT_EQ(counted(still).at("steps_violated"), 0.0);
  const double asked = static_cast<double>(std::ranges::count_if(
      walked(moving), [](const auto& one) { return one.second.state != StepState::not_asked; }));
  EXPECT_NEAR(counted(moving).at("steps_done"), (asked - 5.0) / asked, 1e-12)
      << "without asking, holding, looking, firing in it, and a jiggle";
  EXPECT_EQ(counted(moving).at("steps_violated"), 2.0);
  moving.setting.yields = false;
  EXPECT_NEAR(counted(moving).at("steps_done"), (asked - 5.0) / (asked - 1.0), 1e-12);
}

TEST(Steps, AroundAPhantomOnlyHandsAndPicturesAreAskedFor) {
  SampleAttempt sample = exemplary(kUltrasoundCore);
  sample.setting.subject = cases::Subject::phantom;
  sample.setting.breathes = false;
  for (const char* id : {"sign_in", "decide", "anaesthetise", "nick", "keep_off_bone", "ask_breath_hold",
                         "check_in_breath_hold", "sign_out"})
    EXPECT_EQ(walked(sample).at(id).reason, "no_patient") << id;
  for (const char* id :
       {"check_probe", "find_target", "note_depth", "enter_at_angle", "insert", "insert_to_depth", "sample"})
    EXPECT_EQ(walked(sample).at(id).state, StepState::done) << id;
  EXPECT_EQ(counted(sample).at("steps_done"), 1.0);
  EXPECT_EQ(counted(sample).count("pain_reactions"), 0U);
}

TEST(Steps, WhatWasNotListenedToIsNotSkipped) {
  SampleAttempt sample = exemplary(kUltrasoundCore);
  sample.recording.events.reset();
  int done = 0, by_events = 0;
  for (const auto& [id, result] : walked(sample)) {
    EXPECT_TRUE(result.state == StepState::done || result.state == StepState::not_asked) << id;
    done += result.state == StepState::done ? 1 : 0;
    if ((find_step(id)->needs & kEvents) == 0) continue;
    if (result.reason == "not_xray") continue;  // asked first
    ++by_events;
    EXPECT_EQ(result.reason, "events_not_recorded") << id;
  }
  EXPECT_GE(by_events, 4) << "sign-in, decision, anaesthetic and sign-out are said";
  EXPECT_GT(done, 0) << "what the recording shows was done all the same";
  const auto signals = sample.signals();
  const auto metrics = measure_all(*signals);
  for (const char* id : {"steps_done", "decision_right"}) {
    const auto one = std::find_if(metrics.begin(), metrics.end(), [&](const auto& it) { return it.id == id; });
    ASSERT_NE(one, metrics.end()) << id;
    EXPECT_FALSE(one->value) << id;
    EXPECT_EQ(one->reason, "events_not_recorded") << id;
  }
}

TEST(Steps, WhoDefersIsAskedForNothingMore) {
  SampleAttempt sample = exemplary(kUltrasoundCore);
  sample.recording.events = {{0.1, EventKind::sign_in}, {0.2, EventKind::defer}, {0.3, EventKind::sign_out}};
  sample.recording.endpoint.reset();
  std::erase_if(sample.recording.poses, [](const auto& pose) { return pose.t_s > 1.0; });
  for (const auto& [id, result] : walked(sample)) {
    if (id == "sign_in" || id == "decide" || id == "sign_out")
      EXPECT_EQ(result.state, StepState::done) << id;
    else
      EXPECT_EQ(result.state, StepState::not_asked) << id;
  }
  const auto value = [](const SampleAttempt& attempt) {
    for (const MetricValue& metric : measure_all(*attempt.signals()))
      if (metric.id == "decision_right") return metric;
    return MetricValue{};
  };
  EXPECT_EQ(value(sample).value, 0.0) << "it was to go ahead";
  sample.setting.defer_is_right = true;
  EXPECT_EQ(value(sample).value, 1.0);
  SampleAttempt both = sample;
  for (const double t_s : {0.05, 0.25}) {  // before or after it was said to defer
    both.recording.events = {{0.1, EventKind::sign_in}, {0.2, EventKind::defer}};
    say(both, t_s, EventKind::proceed);
    EXPECT_EQ(value(both).value, 0.0) << "said both";  // before: 1
  }
  SampleAttempt punctured = exemplary(kUltrasoundCore);
  punctured.setting.defer_is_right = true;
  EXPECT_EQ(value(punctured).value, 0.0);
  say(punctured, 0.15, EventKind::defer);
  EXPECT_EQ(value(punctured).value, 0.0) << "deferred, and punctured all the same";
  punctured.setting.defer_is_right = false;
  EXPECT_EQ(value(punctured).value, 0.0);
  leave_out(punctured, EventKind::defer);
  EXPECT_EQ(value(punctured).value, 1.0);
  punctured.setting.defer_is_right.reset();
  EXPECT_EQ(value(punctured).reason, "no_right_decision");
  sample.recording.events->clear();
  EXPECT_EQ(value(sample).reason, "nothing_decided");
}

TEST(Steps, AreCountedByState) {
  const std::vector<StepResult> results = {{"sign_in", 1, StepState::done, 1.0, ""},
                                           {"decide", 1, StepState::skipped, {}, ""},
                                           {"insert", 1, StepState::violated, 2.0, ""},
                                           {"jiggle", 1, StepState::skipped, {}, ""},  // not graded: nothing yields
                                           {"nick", 1, StepState::not_asked, {}, "not_a_core_needle"},
                                           {"of_another_version", 1, StepState::done, 1.0, ""}};
  const StepCounts counts = count_steps(results, kYields);
  EXPECT_EQ(counts.done, 1);
  EXPECT_EQ(counts.skipped, 1);
  EXPECT_EQ(counts.violated, 1);
  EXPECT_EQ(counts.to_be_shown, 1) << "insert";
  EXPECT_EQ(counts.shown, 0);
}

}  // namespace
}  // namespace seldinger::assessment
