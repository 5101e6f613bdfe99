// Every step can be missed, and a fault changes the step that it is of and no other.
#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "tests/assessment/procedure/exemplary_attempt.h"

namespace seldinger::assessment {
namespace {

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

void measure(SampleAttempt& sample, double t_s, double depth_mm) {
  move_event(sample, EventKind::depth_measured, t_s);
  for (cases::Event& event : *sample.recording.events)
    if (event.kind == EventKind::depth_measured) event.tenths_mm = cases::tenths_of(depth_mm);
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

void leave_out_jiggle(SampleAttempt& sample) {
  auto& recording = sample.recording;
  std::erase_if(recording.poses, [](const auto& pose) { return pose.t_s > 2.99 && pose.t_s < 3.61; });
  for (auto& pose : recording.poses)
    if (pose.t_s > 3.6) pose.t_s -= 0.6;
  recording.endpoint->t_s -= 0.6;
  for (auto& frame : recording.frames)
    if (frame.t_s > 3.6) frame.t_s -= 0.6;
}

// By 3 mm, once in each period.
double to_and_fro_mm(double since_s, double period_s) {
  return 1.5 - 1.5 * std::cos(2.0 * std::numbers::pi * since_s / period_s);
}

// Before the puncture: safety, probe and depth.
std::vector<Fault> faults_of_checks() {
  using enum StepState;
  return {
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
  };
}

// Depth and angle, and whether it is seen.
std::vector<Fault> faults_of_the_way_in() {
  using enum StepState;
  return {
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
  };
}

// Anaesthetic, skin, bone, and steps taken blind.
std::vector<Fault> faults_of_the_needle() {
  using enum StepState;
  return {
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
  };
}

// Breath held, lost and given back, and what shows the tip beside it.
std::vector<Fault> faults_of_breath() {
  using enum StepState;
  return {
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
      {"no jiggle", "jiggle", skipped, &leave_out_jiggle},
      // Steps 3: done, and shown.
      {"no jiggle, but breath past a hand at rest", "jiggle", skipped,
       [](auto& s) {
         leave_out_jiggle(s);
         for (auto& pose : s.recording.poses)
           if (pose.t_s > 5.4 && pose.t_s < 7.4)
             pose.rest_tip_lps_mm = pose.tip_lps_mm - to_and_fro_mm(pose.t_s - 5.4, 1.0) * pose.needle_direction;
       }},
      // Steps 3: violated, pushed on by breath.
      {"a hold in which it is not seen, and breath that takes it along before it is found again", "find_again",
       done,
       [](auto& s) {
         rest_in_hold(s);
         blind_from(s, 3.6, 4.95);
         for (auto& pose : s.recording.poses)
           if (pose.t_s > 4.75 && pose.t_s < 4.95) {
             pose.rest_tip_lps_mm = pose.tip_lps_mm;
             pose.tip_lps_mm += to_and_fro_mm(pose.t_s - 4.75, 0.2) * pose.needle_direction;
           }
       }},
  };
}

// Probe and target.
std::vector<Fault> faults_of_the_target() {
  using enum StepState;
  return {
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
  };
}

// Stylet, trouble, the last look; across the picture and under a fluoroscope.
std::vector<Fault> faults_of_the_end() {
  using enum StepState;
  return {
      {"the introducer's stylet drawn at the target's edge", "exchange_stylet", done,
       [](auto& s) {
         say(s, 0.9, EventKind::stylet_in);
         say(s, 6.9, EventKind::stylet_out);
       }},
      {"the introducer's stylet drawn on the way", "exchange_stylet", skipped,
       [](auto& s) {
         say(s, 0.9, EventKind::stylet_in);
         say(s, 3.9, EventKind::stylet_out);
       }},
      {"fired on the introducer's stylet", "exchange_stylet", violated,
       [](auto& s) { say(s, 0.9, EventKind::stylet_in); }},
      {"an introducer asked for in tissue", "exchange_stylet", not_asked,
       [](auto& s) { say(s, 3.9, EventKind::stylet_in); }},
      {"an introducer put aside", "exchange_stylet", not_asked,
       [](auto& s) {
         say(s, 0.5, EventKind::stylet_in);
         say(s, 0.9, EventKind::stylet_out);
       }},
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
}

const std::vector<Fault>& faults() {
  static const std::vector<Fault> kAll = [] {
    std::vector<Fault> all;
    for (const auto& some : {faults_of_checks(), faults_of_the_way_in(), faults_of_the_needle(), faults_of_breath(),
                             faults_of_the_target(), faults_of_the_end()})
      for (const Fault& fault : some) all.push_back(fault);
    return all;
  }();
  return kAll;
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

}  // namespace
}  // namespace seldinger::assessment
