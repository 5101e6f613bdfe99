// Where a probe stands for a planned way: beside the entry so that its plane holds the way, or across it.
#pragma once

#include <optional>

#include "assessment/operators/plan.h"

namespace seldinger::assessment {

// How the probe is held to see a tip so far in. In plane: the same everywhere. Out of plane it slides from
// `probe_first` towards `probe`, and where that does not bring its plane onto the tip it is fanned, by no more than
// kMostFanDeg.
constexpr double kMostFanDeg = 35.0;
cases::ToolPose probe_over(const PuncturePlan& plan, double inserted_mm) noexcept;

// Unit normal of a probe's plane.
glm::dvec3 plane_normal(const cases::ToolPose& probe) noexcept;

// Completes a plan whose way is made: the best place on the skin from which the way and the target are seen. How
// good it is there, the more the better; nothing when there is none.
std::optional<double> place_probe(const cases::MeshIndex& skin, const PathLimits& limits, PuncturePlan& plan);

}  // namespace seldinger::assessment
