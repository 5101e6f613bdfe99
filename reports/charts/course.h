// An attempt over time, as charts draw it: how deep the tip was, what the picture showed, what was felt, and what
// happened.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "assessment/signals/signals.h"
#include "reports/charts/frame_spans.h"
#include "sim/case/record/recording.h"

namespace seldinger::reports {

struct CoursePoint {
  double t_s = 0.0;
  double inserted_mm = 0.0;  // along the needle; 0 outside
  bool in_body = false, tip_seen = false;
};

// How deep the target's near and far surface and its centre lie for the needle that is in, from its entry.
struct TargetDepth {
  Span span;
  double center_mm = 0.0, radius_mm = 0.0;
};

struct ForcePointInTime {
  double t_s = 0.0, axial_n = 0.0, lateral_n = 0.0;
};

struct Band {
  std::string name;
  std::vector<Span> spans;
};

// A lane holds what lasts or happens at once (t1_s = t0_s): steps of a procedure, events.
struct LaneMark {
  double t0_s = 0.0, t1_s = 0.0;
  std::string kind;  // a class of drawing: hand, trainee, mentor, patient; step, skipped, violated
  std::string words;
  std::string step_id{};  // of a step: what its words open
};
struct Lane {
  std::string name;
  std::vector<LaneMark> marks;
  std::vector<LaneMark> timeless{};  // what did not happen: told, not drawn
};

struct Course {
  double t0_s = 0.0, t1_s = 0.0;    // of the whole recording
  std::vector<CoursePoint> points;  // as signals: up to the endpoint
  std::vector<TargetDepth> targets;
  std::vector<ForcePointInTime> forces;
  std::vector<Band> bands;
  std::vector<Lane> lanes;  // those that have something to tell
  std::optional<double> fired_s;
};

Course course_of(const assessment::Signals& signals, const cases::Recording& recording);

}  // namespace seldinger::reports
