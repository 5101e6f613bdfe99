// An attempt in which every step is done as it is to be, ways to change it, and what steps and metrics say of it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "assessment/procedure/steps.h"
#include "assessment/registry.h"
#include "sim/case/c_arm.h"
#include "tests/assessment/metrics/sample_attempts.h"

namespace seldinger::assessment {

using cases::EventKind;

constexpr SampleKind kUltrasoundCore{cases::Modality::ultrasound, cases::Approach::in_plane,
                                     cases::InstrumentKind::core};
constexpr SampleKind kUltrasoundAcross{cases::Modality::ultrasound, cases::Approach::out_of_plane,
                                       cases::InstrumentKind::access};
constexpr SampleKind kFluoroscopy{cases::Modality::xray, cases::Approach::in_plane, cases::InstrumentKind::access};

// To and fro by 14 mm, once, from 0.2 to 0.8 s.
inline double slide_mm(double t_s) {
  return t_s > 0.2 && t_s < 0.8 ? 14.0 * std::sin(2.0 * std::numbers::pi * (t_s - 0.2) / 0.6) : 0.0;
}

// An attempt in which all is done as it is to be: scan, slide the probe to and fro, measure the depth, say what is
// to be said, straight in with the tip in the picture, a jiggle, a held breath before the organ's capsule (33 mm,
// at 4.6 s), the trigger at 8 s, out at 10 s, a last look, sign-out. The patient breathes, and tissue yields.
inline SampleAttempt exemplary(const SampleKind& kind) {
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

inline std::map<std::string, StepResult> walked(const SampleAttempt& sample) {
  const auto signals = sample.signals();
  EXPECT_TRUE(signals.has_value()) << (signals ? "" : signals.error().text);
  std::map<std::string, StepResult> results;
  if (signals)
    for (const StepResult& result : walk_steps(*signals)) results[result.id] = result;
  return results;
}

inline void say(SampleAttempt& sample, double t_s, EventKind kind) {
  auto& events = *sample.recording.events;
  events.insert(std::upper_bound(events.begin(), events.end(), t_s,
                                 [](double t, const cases::Event& event) { return t < event.t_s; }),
                {t_s, kind});
}
inline void leave_out(SampleAttempt& sample, EventKind kind) {
  std::erase_if(*sample.recording.events, [&](const cases::Event& event) { return event.kind == kind; });
}
inline void move_event(SampleAttempt& sample, EventKind kind, double t_s) {
  leave_out(sample, kind);
  say(sample, t_s, kind);
}

inline void hold_probe_still(SampleAttempt& sample) {
  for (cases::PoseSample& pose : sample.recording.poses)
    pose.probe_origin_lps_mm -= slide_mm(pose.t_s) * pose.probe_lateral;
}

inline void plan(SampleAttempt& sample, double depth_mm) {
  for (cases::Event& event : *sample.recording.events)
    if (event.kind == EventKind::note_plan) event.tenths_mm = cases::tenths_of(depth_mm);
}

inline std::map<std::string, double> counted(const SampleAttempt& sample) {
  std::map<std::string, double> values;
  for (const MetricValue& metric : measure_all(*sample.signals()))
    if (metric.value) values[metric.id] = *metric.value;
  return values;
}

}  // namespace seldinger::assessment
