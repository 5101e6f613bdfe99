#include "assessment/plan_comparison.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "assessment/signals/signals.h"
#include "sim/base/check.h"

namespace seldinger::assessment {
namespace {

constexpr double kLeastPathMm = 0.1;  // a tip that has hardly passed the skin points nowhere

std::optional<DonePath> path_at(const Signals& signals, std::size_t i) {
  if (!signals.passages[i].in_body) return std::nullopt;
  const DonePath done{signals.poses[i].t_s,
                      {signals.passages[i].entry_lps_mm, signals.poses[i].tip_at_rest_lps_mm()}};
  if (!(done.path.depth_mm() >= kLeastPathMm)) return std::nullopt;
  return done;
}

}  // namespace

std::optional<DonePath> done_path(const Signals& signals) {
  if (signals.poses.empty()) return std::nullopt;
  if (signals.endpoint)
    if (auto done = path_at(signals, signals.poses.size() - 1)) return done;
  std::optional<DonePath> deepest;
  for (std::size_t i = 0; i < signals.poses.size(); ++i)
    if (auto done = path_at(signals, i); done && (!deepest || done->path.depth_mm() > deepest->path.depth_mm()))
      deepest = done;
  return deepest;
}

PlanComparison compare(const PlannedPath& planned, const PlannedPath& done) {
  PlanComparison comparison;
  comparison.planned_depth_mm = planned.depth_mm();
  comparison.depth_mm = done.depth_mm();
  CHECK(comparison.planned_depth_mm > 0.0 && comparison.depth_mm > 0.0);
  comparison.entry_mm = glm::distance(planned.entry_lps_mm, done.entry_lps_mm);
  comparison.tip_mm = glm::distance(planned.tip_lps_mm, done.tip_lps_mm);
  const glm::dvec3 as_planned = (planned.tip_lps_mm - planned.entry_lps_mm) / comparison.planned_depth_mm;
  const glm::dvec3 as_done = (done.tip_lps_mm - done.entry_lps_mm) / comparison.depth_mm;
  // By both sine and cosine: an arc cosine alone is blind to small angles.
  comparison.angle_deg = std::atan2(glm::length(glm::cross(as_planned, as_done)), glm::dot(as_planned, as_done)) *
                         (180.0 / std::numbers::pi);
  return comparison;
}

}  // namespace seldinger::assessment
