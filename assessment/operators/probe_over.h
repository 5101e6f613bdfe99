// How a planned probe is held to see a tip so far in.
#pragma once

#include "assessment/operators/plan.h"

namespace seldinger::assessment {

// In plane: the same everywhere. Out of plane it slides from `probe_first` towards `probe`, and where that does not
// bring its plane onto the tip it is fanned, by no more than kMostFanDeg.
constexpr double kMostFanDeg = 35.0;
cases::ToolPose probe_over(const PuncturePlan& plan, double inserted_mm) noexcept;

// Unit normal of a probe's plane.
glm::dvec3 plane_normal(const cases::ToolPose& probe) noexcept;

}  // namespace seldinger::assessment
