// When the patient held the breath, and how far the needle was advanced where that matters, as a recording tells.
#pragma once

#include <span>
#include <vector>

namespace seldinger::assessment {

struct Signals;

// Without a marked organ, the way matters from so near to the target's edge on (design).
constexpr double kLastWayMm = 20.0;

// From when the patient held still to when breath moved again, at most to the endpoint.
struct BreathHold {
  double from_s = 0.0, to_s = 0.0;
  bool lost = false;  // by itself: held too long, or a cough
};
// By rising time, apart from each other. What was said is known (kEvents).
std::vector<BreathHold> breath_holds(const Signals& signals);
// Whether one of them held at a time; a lost one counts for `grace_s` longer.
bool held_at(std::span<const BreathHold> holds, double t_s, double grace_s = 0.0);

// One per pose: what of `advance_mm` was inside the target's organ (where none is marked, kLastWayMm from the
// target's edge or nearer). There is a target.
std::vector<double> pushed_on_last_way_mm(const Signals& signals);

}  // namespace seldinger::assessment
