// The way that somebody planned before a puncture, and how the puncture went against it. Such a plan is the
// trainee's own: the case's is AttemptSetting::plan.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace seldinger::assessment {

struct Signals;

// From the skin straight to where the tip is to be when the needle is fired, or said to be there. A line needs two
// ends that are apart (CHECKed by who compares).
struct PlannedPath {
  glm::dvec3 entry_lps_mm{0.0}, tip_lps_mm{0.0};
  double depth_mm() const { return glm::distance(entry_lps_mm, tip_lps_mm); }
  bool operator==(const PlannedPath&) const = default;
};

// What became of it: where the needle went in and where its tip was, at rest as the CT saw both.
struct DonePath {
  double t_s = 0.0;
  PlannedPath path;  // with its ends apart
};

// At the endpoint, if the needle was in the body; of an attempt without one where its tip was deepest. Nothing: the
// needle was never in.
std::optional<DonePath> done_path(const Signals& signals);

struct PlanComparison {
  double entry_mm = 0.0;                          // from the planned entry to the one that was made
  double angle_deg = 0.0;                         // between the two ways
  double planned_depth_mm = 0.0, depth_mm = 0.0;  // along each
  double tip_mm = 0.0;                            // from the planned place of the tip to where it was
};

PlanComparison compare(const PlannedPath& planned, const PlannedPath& done);

}  // namespace seldinger::assessment
