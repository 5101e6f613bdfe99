// Tests of assessment/procedure: what of a recording completes, skips or violates a step.
#include "assessment/procedure/steps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <set>

#include "assessment/registry.h"
#include "sim/case/c_arm.h"
#include "tests/assessment/metrics/sample_attempts.h"

namespace seldinger::assessment {
namespace {

using cases::EventKind;

constexpr SampleKind kUltrasoundCore{cases::Modality::ultrasound, cases::Approach::in_plane,
                                     cases::InstrumentKind::core};
constexpr SampleKind kUltrasoundAcross{cases::Modality::ultrasound, cases::Approach::out_of_plane,
                                       cases::InstrumentKind::access};
constexpr SampleKind kFluoroscopy{cases::Modality::xray, cases::Approach::in_plane, cases::InstrumentKind::access};

// To and fro by 14 mm, once, from 0.2 to 0.8 s.
double slide_mm(double t_s) {
  return t_s > 0.2 && t_s < 0.8 ? 14.0 * std::sin(2.0 * std::numbers::pi * (t_s - 0.2) / 0.6) : 0.0;
}

// An attempt in which all is done as it is to be: scan, slide the probe to and fro, measure the depth, say what is
// to be said, straight in with the tip in the picture, a jiggle, a held breath before the organ's capsule (33 mm,
// at 4.6 s), the trigger at 8 s, out at 10 s, a last look, sign-out. The patient breathes, and tissue yields.
SampleAttempt exemplary(const SampleKind& kind) {
  SampleAttempt sample = sample_attempt(kind);
  const glm::dvec3 way = glm::normalize(sample.setting.target->center_lps_mm);
  const bool xray = kind.modality == cases::Modality::xray;
  const bool across = !xray && kind.approach == cases::Approach::out_of_plane;
  const double deep_mm = kind.instrument == cases::InstrumentKind::core ? 54.0 : 60.0;  // its edge is at 56
  const std::vector<Knot> depth = {{1.0, -40.0}, {2.0, -2.0},    {3.0, 20.0},    {3.3, 17.0},
                                   {3.6, 20.0},  {6.0, deep_mm}, {8.5, deep_mm}, {10.0, -20.0}};
  sample.recording.poses.clear();
  sample.recording.forces.clear();
  sample.recording.frames.clear();
  for (int i = 0; i <= 1200; ++i) {
    cases::PoseSample pose;
    pose.t_s = i * 0.01;
    pose.needle_direction = way;
    pose.tip_lps_mm = way * reach(depth, pose.t_s);
    // Out of plane the probe goes with the tip.
    pose.probe_origin_lps_mm = across ? glm::dvec3(pose.tip_lps_mm.x, 0.0, 0.0) : glm::dvec3(30.0, 0.0, 0.0);
    pose.probe_axial = {0, 1, 0};
    pose.probe_lateral = across ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    pose.probe_origin_lps_mm += slide_mm(pose.t_s) * pose.probe_lateral;
    sample.recording.poses.push_back(pose);
  }
  const glm::dvec3 end = way * reach(depth, 8.0);
  sample.recording.endpoint = cases::Endpoint{8.0, end, way};
  for (int i = 0; i < 12 * 15; ++i) {
    cases::FrameTruth frame;
    frame.t_s = i / 15.0;
    frame.target = true;
    frame.needle_tip = frame.t_s > (xray ? 1.5 : 1.9) && frame.t_s < 9.9;
    if (xray) {
      frame.beam = cases::BeamTruth{};
      // Along the needle until 5 s, then 40° beside it.
      const cases::BeamAngles along = cases::angles_of_beam(-way, cases::PatientPosition::supine);
      frame.beam->lao_deg = along.lao_deg + (frame.t_s < 5.0 ? 0.0 : 40.0);
      frame.beam->cranial_deg = along.cranial_deg;
    } else if (kind.modality == cases::Modality::ultrasound) {
      frame.near_plane = cases::NearPlane{};
    }
    sample.recording.frames.push_back(frame);
  }
  const std::uint16_t target_mm = cases::tenths_of(sample.setting.target->center_lps_mm.y);  // the face is at y = 0
  sample.recording.events = {{0.05, EventKind::calipers_recorded},
                             {0.1, EventKind::sign_in},
                             {0.2, EventKind::proceed},
                             {0.3, EventKind::probe_checked},
                             {0.35, EventKind::depth_measured, 0.0, target_mm},
                             {0.4, EventKind::note_plan, 0.0, cases::tenths_of(deep_mm)},
                             {0.5, EventKind::aspirate},
                             {0.6, EventKind::anaesthetic},
                             {0.7, EventKind::nick},
                             {3.0, EventKind::breath_hold_request},
                             {4.1, EventKind::breath_held},
                             {8.6, EventKind::breathe_again},
                             {11.9, EventKind::sign_out}};
  return sample;
}

std::map<std::string, StepResult> walked(const SampleAttempt& sample) {
  const auto signals = sample.signals();
  EXPECT_TRUE(signals.has_value()) << (signals ? "" : signals.error().text);
  std::map<std::string, StepResult> results;
  if (signals)
    for (const StepResult& result : walk_steps(*signals)) results[result.id] = result;
  return results;
}

void say(SampleAttempt& sample, double t_s, EventKind kind) {
  auto& events = *sample.recording.events;
  events.insert(std::upper_bound(events.begin(), events.end(), t_s,
                                 [](double t, const cases::Event& event) { return t < event.t_s; }),
                {t_s, kind});
}
void leave_out(SampleAttempt& sample, EventKind kind) {
  std::erase_if(*sample.recording.events, [&](const cases::Event& event) { return event.kind == kind; });
}
void move_event(SampleAttempt& sample, EventKind kind, double t_s) {
  leave_out(sample, kind);
  say(sample, t_s, kind);
}

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

// A fault, the step that it is of, and what becomes of the step. No other step changes.
struct Fault {
  const char* name;
  const char* step;
  StepState state;
  std::function<void(SampleAttempt&)> make;
  const SampleKind& kind = kUltrasoundCore;
  std::set<std::string> besides = {};
};

void blind_from(SampleAttempt& sample, double from_s, double to_s) {
  for (cases::FrameTruth& frame : sample.recording.frames)
    if (frame.t_s > from_s && frame.t_s < to_s) frame.needle_tip = false;
}

void hold_probe_still(SampleAttempt& sample) {
  for (cases::PoseSample& pose : sample.recording.poses)
    pose.probe_origin_lps_mm -= slide_mm(pose.t_s) * pose.probe_lateral;
}

void measure(SampleAttempt& sample, double t_s, double depth_mm) {
  move_event(sample, EventKind::depth_measured, t_s);
  for (cases::Event& event : *sample.recording.events)
    if (event.kind == EventKind::depth_measured) event.tenths_mm = cases::tenths_of(depth_mm);
}

void plan(SampleAttempt& sample, double depth_mm) {
  for (cases::Event& event : *sample.recording.events)
    if (event.kind == EventKind::note_plan) event.tenths_mm = cases::tenths_of(depth_mm);
}

// A second hold, from 7 s on; the needle has been at rest since 6 s.
void hold_again(SampleAttempt& sample) {
  say(sample, 6.8, EventKind::breathe_again);
  say(sample, 7.0, EventKind::breath_held);
}

// The needle rests from 3.6 to 5 s, in the middle of which breath is held once more than before.
void rest_in_hold(SampleAttempt& sample) {
  const double rest_mm = 20.0, deep_mm = 54.0;
  const glm::dvec3 way = sample.recording.poses.front().needle_direction;
  const std::vector<Knot> depth = {{3.6, rest_mm}, {5.0, rest_mm}, {6.8, deep_mm}};
  for (cases::PoseSample& pose : sample.recording.poses)
    if (pose.t_s >= 3.6 && pose.t_s <= 6.8) pose.tip_lps_mm = way * reach(depth, pose.t_s);
  move_event(sample, EventKind::breath_held, 3.7);
  say(sample, 4.75, EventKind::breathe_again);
  say(sample, 5.1, EventKind::breath_held);
}

const std::vector<Fault>& faults() {
  using enum StepState;
  static const std::vector<Fault> all = {
      {"no sign-in", "sign_in", skipped, [](auto& s) { leave_out(s, EventKind::sign_in); }},
      {"sign-in after the puncture", "sign_in", skipped, [](auto& s) { move_event(s, EventKind::sign_in, 5.0); }},
      {"nothing decided", "decide", skipped, [](auto& s) { leave_out(s, EventKind::proceed); }},
      {"the probe's side said and not tested", "check_probe", skipped, &hold_probe_still},
      {"the probe slid one way only", "check_probe", skipped,
       [](auto& s) {
         hold_probe_still(s);
         for (auto& pose : s.recording.poses)
           pose.probe_origin_lps_mm += std::min(14.0, 20.0 * pose.t_s) * pose.probe_lateral;
       }},
      {"the probe slid across the picture", "check_probe", skipped,
       [](auto& s) {
         hold_probe_still(s);
         for (auto& pose : s.recording.poses) pose.probe_origin_lps_mm.z += slide_mm(pose.t_s);
       }},
      {"the probe slid with the picture frozen", "check_probe", skipped,
       [](auto& s) {
         for (auto& frame : s.recording.frames) frame.live = frame.t_s == 0.0 || frame.t_s > 0.9;
       }},
      {"the probe rocked, not slid", "check_probe", done,
       [](auto& s) {
         hold_probe_still(s);
         for (auto& pose : s.recording.poses) {
           const double angle = slide_mm(pose.t_s) * std::numbers::pi / 180.0;
           pose.probe_axial = {std::sin(angle), std::cos(angle), 0.0};
           pose.probe_lateral = {std::cos(angle), -std::sin(angle), 0.0};
         }
       }},
      {"the side tested and not spoken of", "check_probe", done,
       [](auto& s) { leave_out(s, EventKind::probe_checked); }},
      {"depth said and not measured", "note_depth", skipped,
       [](auto& s) { leave_out(s, EventKind::depth_measured); }},
      {"depth measured after the puncture", "note_depth", skipped,
       [](auto& s) { measure(s, 5.0, s.setting.target->center_lps_mm.y); }},
      {"something else measured", "note_depth", skipped,
       [](auto& s) { measure(s, 0.35, s.setting.target->center_lps_mm.y - 25.0); }},
      {"depth measured where the picture does not show the target", "note_depth", skipped,
       [](auto& s) {
         for (auto& frame : s.recording.frames) frame.target = frame.target && frame.t_s > 0.4;
       }},
      {"depth measured off a picture frozen before the probe moved", "note_depth", done,
       [](auto& s) {
         measure(s, 1.6, s.setting.target->center_lps_mm.y);
         for (auto& frame : s.recording.frames) frame.live = frame.t_s < 0.8 || frame.t_s > 1.7;
         for (auto& pose : s.recording.poses)
           if (pose.t_s > 0.9 && pose.t_s < 1.7) pose.probe_origin_lps_mm.y = -60.0;
       }},
      {"no depth planned", "insert_to_depth", skipped, [](auto& s) { plan(s, 0.0); }},
      {"deeper than was planned", "insert_to_depth", skipped, [](auto& s) { plan(s, 43.0); }},
      {"short of what was planned", "insert_to_depth", skipped, [](auto& s) { plan(s, 65.0); }},
      {"as deep as a mark of the needle tells", "insert_to_depth", done, [](auto& s) { plan(s, 63.5); }},
      {"not as steep as planned", "enter_at_angle", skipped,
       [](auto& s) { s.setting.plan->direction = glm::normalize(glm::dvec3(0.6, 1.0, 0.0)); }},
      {"beside the planned direction, as steep", "enter_at_angle", done,
       [](auto& s) { s.setting.plan->direction = glm::normalize(glm::dvec3(-0.2, 1.0, 0.0)); }},
      {"pushed on in the hold before it is seen",
       "check_in_breath_hold",
       violated,
       [](auto& s) { blind_from(s, 4.05, 5.0); },
       kUltrasoundCore,
       {"advance_seen"}},
      {"fired in the hold before it is seen",
       "check_in_breath_hold",
       violated,
       [](auto& s) {
         hold_again(s);
         blind_from(s, 6.9, 8.5);
       },
       kUltrasoundCore,
       {"sample"}},
      {"a hold in which it is not seen, found again before it goes on", "find_again", done,
       [](auto& s) {
         rest_in_hold(s);
         blind_from(s, 3.6, 4.85);
       }},
      {"a hold in which it is not seen, and on without a look",
       "find_again",
       violated,
       [](auto& s) {
         rest_in_hold(s);
         blind_from(s, 3.6, 7.0);
       },
       kUltrasoundCore,
       {"advance_seen", "check_in_breath_hold"}},
      {"no aspiration", "anaesthetise", violated, [](auto& s) { leave_out(s, EventKind::aspirate); }},
      {"aspiration after it", "anaesthetise", violated, [](auto& s) { move_event(s, EventKind::aspirate, 0.65); }},
      {"no anaesthetic", "anaesthetise", skipped, [](auto& s) { leave_out(s, EventKind::anaesthetic); }},
      {"no nick", "nick", skipped, [](auto& s) { leave_out(s, EventKind::nick); }},
      {"skin not numb", "insert", violated, [](auto& s) { say(s, 2.1, EventKind::pain_skin); }},
      {"bone", "keep_off_bone", violated, [](auto& s) { say(s, 4.0, EventKind::pain_bone); }},
      {"a blind run",
       "advance_seen",
       violated,
       [](auto& s) { blind_from(s, 4.0, 5.5); },
       kUltrasoundCore,
       {"check_in_breath_hold"}},
      {"fired blind", "sample", violated, [](auto& s) { blind_from(s, 7.5, 8.2); }},
      {"fired on a frozen picture", "sample", violated,
       [](auto& s) {
         for (auto& frame : s.recording.frames) frame.live = frame.live && !(frame.t_s > 7.5 && frame.t_s < 8.2);
       }},
      {"no breath held",
       "ask_breath_hold",
       skipped,
       [](auto& s) {
         leave_out(s, EventKind::breath_hold_request);
         leave_out(s, EventKind::breath_held);
       },
       kUltrasoundCore,
       {"hold_before_organ", "check_in_breath_hold", "fire_in_breath_hold"}},
      {"breath held without being asked for", "ask_breath_hold", skipped,
       [](auto& s) { leave_out(s, EventKind::breath_hold_request); }},
      {"into the organ before breath is held", "hold_before_organ", violated,
       [](auto& s) { move_event(s, EventKind::breath_held, 5.2); }},
      {"on in the organ when breath is lost", "hold_before_organ", violated,
       [](auto& s) {
         say(s, 4.2, EventKind::breath_lost);  // a second is given to notice it
         say(s, 5.8, EventKind::breath_held);
       }},
      {"stopped when breath is lost, until it is held again", "hold_before_organ", done,
       [](auto& s) {
         say(s, 6.0, EventKind::breath_lost);
         say(s, 7.0, EventKind::breath_held);
       }},
      {"breath held, no look at it", "check_in_breath_hold", skipped,
       [](auto& s) {
         for (auto& frame : s.recording.frames) frame.target = frame.target && (frame.t_s < 4.1 || frame.t_s > 9.0);
       }},
      {"fired when breath was lost", "fire_in_breath_hold", violated,
       [](auto& s) { say(s, 7.9, EventKind::breath_lost); }},
      {"fired as it was given back", "fire_in_breath_hold", violated,
       [](auto& s) { move_event(s, EventKind::breathe_again, 7.9); }},
      {"no jiggle", "jiggle", skipped,
       [](auto& s) {
         std::erase_if(s.recording.poses, [](const auto& pose) { return pose.t_s > 2.99 && pose.t_s < 3.61; });
         for (auto& pose : s.recording.poses)
           if (pose.t_s > 3.6) pose.t_s -= 0.6;
         s.recording.endpoint->t_s -= 0.6;
         for (auto& frame : s.recording.frames)
           if (frame.t_s > 3.6) frame.t_s -= 0.6;
       }},
      {"the probe in the air",
       "place_probe",
       skipped,
       [](auto& s) {
         for (auto& pose : s.recording.poses) pose.probe_origin_lps_mm.y -= 30.0;
       },
       kUltrasoundCore,
       {"check_probe", "note_depth"}},
      {"the target found only after the puncture",
       "find_target",
       skipped,
       [](auto& s) {
         for (auto& frame : s.recording.frames) frame.target = frame.t_s > 4.0;
       },
       kUltrasoundCore,
       {"note_depth"}},
      {"the target never found",
       "find_target",
       skipped,
       [](auto& s) {
         for (auto& frame : s.recording.frames) frame.target = false;
       },
       kUltrasoundCore,
       {"note_depth", "see_both", "check_in_breath_hold", "scan_after"}},
      {"stopped short of the target",
       "reach_target",
       skipped,
       [](auto& s) { s.setting.target->center_lps_mm *= 1.5; },
       kUltrasoundCore,
       {"note_depth", "advance_seen", "keep_off_bone", "hold_before_organ"}},
      {"on after a cough", "stop_in_trouble", violated, [](auto& s) { say(s, 3.6, EventKind::cough); }},
      {"still after bleeding", "stop_in_trouble", done, [](auto& s) { say(s, 5.5, EventKind::bleeding); }},
      {"no last look", "scan_after", skipped,
       [](auto& s) {
         for (auto& frame : s.recording.frames) frame.target = frame.target && frame.t_s < 9.0;
       }},
      {"left in",
       "needle_out",
       skipped,
       [](auto& s) { std::erase_if(s.recording.poses, [](const auto& pose) { return pose.t_s > 8.2; }); },
       kUltrasoundCore,
       {"scan_after"}},
      {"no sign-out", "sign_out", skipped, [](auto& s) { leave_out(s, EventKind::sign_out); }},
      {"ahead of the plane", "advance_to_plane", violated,
       [](auto& s) {
         for (auto& pose : s.recording.poses) pose.probe_origin_lps_mm.x = 0.0;
       },
       kUltrasoundAcross},
      {"the hand in the beam", "aim_along_beam", violated,
       [](auto& s) {
         for (auto& frame : s.recording.frames) frame.beam->hand_in_beam = frame.t_s > 1.0 && frame.t_s < 1.2;
       },
       kFluoroscopy},
      {"depth not noted", "note_depth_under_beam", skipped, [](auto& s) { leave_out(s, EventKind::note_plan); },
       kFluoroscopy},
      {"one view only", "judge_depth", skipped,
       [](auto& s) {
         for (auto& frame : s.recording.frames) frame.beam->lao_deg = s.recording.frames[0].beam->lao_deg;
       },
       kFluoroscopy},
      {"never along the needle", "aim_along_beam", skipped,
       [](auto& s) {
         for (auto& frame : s.recording.frames) frame.beam->lao_deg = s.recording.frames.back().beam->lao_deg;
       },
       kFluoroscopy},
  };
  return all;
}

std::map<std::string, double> counted(const SampleAttempt& sample) {
  std::map<std::string, double> values;
  for (const MetricValue& metric : measure_all(*sample.signals()))
    if (metric.value) values[metric.id] = *metric.value;
  return values;
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

TEST(Steps, AFaultChangesItsStepAndNoOther) {
  for (const Fault& fault : faults()) {
    SampleAttempt sample = exemplary(fault.kind);
    const auto before = walked(sample);
    fault.make(sample);
    const auto after = walked(sample);
    EXPECT_EQ(after.at(fault.step).state, fault.state)
        << fault.name << ": " << fault.step << " is " << name_of(after.at(fault.step).state);
    for (const auto& [id, result] : after)
      if (id != fault.step && !fault.besides.contains(id)) {
        EXPECT_EQ(result.state, before.at(id).state) << fault.name << " changes " << id;
      }
  }
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

TEST(Steps, EachCanBeSkippedOrViolated) {
  std::set<std::string> reached;
  for (const Fault& fault : faults()) {
    if (fault.state != StepState::done) reached.insert(fault.step);
    reached.insert(fault.besides.begin(), fault.besides.end());
  }
  // What an attempt without an endpoint, or one that never comes near, lacks.
  for (const SampleKind& kind : {kUltrasoundCore, kUltrasoundAcross, kFluoroscopy}) {
    SampleAttempt still = exemplary(kind);
    still.recording.endpoint.reset();
    for (auto& pose : still.recording.poses) pose.tip_lps_mm.y -= 300.0;
    for (auto& frame : still.recording.frames) frame.target = frame.needle_tip = false;
    for (const auto& [id, result] : walked(still))
      if (result.state == StepState::skipped) reached.insert(id);
  }
  for (const StepInfo& step : procedure_steps()) EXPECT_TRUE(reached.contains(step.id)) << step.id;
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
