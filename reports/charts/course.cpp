#include "reports/charts/course.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "assessment/procedure/steps.h"
#include "reports/charts/recorded_events.h"
#include "reports/words/step_card.h"

namespace seldinger::reports {
namespace {

std::vector<CoursePoint> points_of(const assessment::Signals& signals) {
  std::vector<CoursePoint> points;
  std::size_t next = 0;
  bool seen = false;
  for (std::size_t i = 0; i < signals.poses.size(); ++i) {
    for (; next < signals.frames.size() && signals.frames[next].t_s <= signals.poses[i].t_s; ++next)
      seen = signals.frames[next].live && signals.frames[next].needle_tip;
    points.push_back({signals.poses[i].t_s, signals.inserted_mm(i), signals.passages[i].in_body, seen});
  }
  return points;
}

// A puncture each: from the entry that it had.
std::vector<TargetDepth> targets_of(const assessment::Signals& signals) {
  std::vector<TargetDepth> targets;
  if (!signals.setting.target) return targets;
  const cases::Lesion& target = *signals.setting.target;
  for (std::size_t i = 0; i < signals.poses.size(); ++i) {
    const cases::SkinPassage& skin = signals.passages[i];
    if (!skin.in_body) continue;
    const double t_s = signals.poses[i].t_s;
    const bool goes_on =
        i > 0 && signals.passages[i - 1].in_body && signals.passages[i - 1].entry_lps_mm == skin.entry_lps_mm;
    if (!goes_on)
      targets.push_back({{t_s, t_s}, glm::distance(skin.entry_lps_mm, target.center_lps_mm), target.radius_mm});
    targets.back().span.to_s = t_s;
  }
  return targets;
}

}  // namespace

Course course_of(const assessment::Signals& signals, const cases::Recording& recording) {
  Course course;
  course.points = points_of(signals);
  course.t0_s = signals.poses.front().t_s;
  course.t1_s = std::max(signals.poses.back().t_s, recording.poses.back().t_s);
  course.targets = targets_of(signals);
  for (const cases::ForceSample& force : recording.forces)
    course.forces.push_back({force.t_s, force.needle_axial_n, force.needle_lateral_n});
  if (signals.endpoint) course.fired_s = signals.endpoint->t_s;
  const auto& frames = recording.frames;
  const auto band = [&](const char* name, auto holds) {
    course.bands.push_back({name, spans_where(frames, holds)});
  };
  const bool xray = signals.setting.modality == cases::Modality::xray;
  band(xray ? "Beam on" : "Picture live", [](const cases::FrameTruth& frame) { return frame.live; });
  band("Tip seen", [](const cases::FrameTruth& frame) { return frame.live && frame.needle_tip; });
  band("Target seen", [](const cases::FrameTruth& frame) { return frame.live && frame.target; });
  band("Both seen", [](const cases::FrameTruth& frame) { return frame.live && frame.joint(); });

  // What was not listened to is no omission, and its step is not asked for.
  Lane steps{"Steps", {}};
  for (const assessment::StepResult& result : assessment::walk_steps(signals)) {
    if (result.state == assessment::StepState::not_asked) continue;
    const bool done = result.state == assessment::StepState::done;
    const std::string state(assessment::name_of(result.state));
    const StepMark& told = step_mark(result);
    const LaneMark mark{result.t_s.value_or(0.0), result.t_s.value_or(0.0), done ? "step" : state,
                        step_label(result.id) + " (" + told.words + ")", result.id};
    (result.t_s ? steps.marks : steps.timeless).push_back(mark);
  }
  std::stable_sort(steps.marks.begin(), steps.marks.end(),
                   [](const LaneMark& a, const LaneMark& b) { return a.t0_s < b.t0_s; });
  if (!steps.marks.empty() || !steps.timeless.empty()) course.lanes.push_back(std::move(steps));

  Lane events{"Events", {}};
  for (const RecordedEvent& event : recorded_events(recording)) {
    const bool pedal = event.info->kind.rfind("pedal", 0) == 0;  // the band says it
    if (!pedal) events.marks.push_back({event.t_s, event.t_s, event.info->source, event.info->words});
  }
  if (!events.marks.empty()) course.lanes.push_back(std::move(events));
  return course;
}

}  // namespace seldinger::reports
