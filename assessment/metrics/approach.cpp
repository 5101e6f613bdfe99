// Metrics of the way towards the target: how near, and how the needle went in against the plan.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "assessment/metrics/tables.h"
#include "assessment/signals/signals.h"

namespace seldinger::assessment {
namespace {

double distance_to_segment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 way = b - a;
  const double squared = glm::dot(way, way);
  const double at = squared > 0.0 ? std::clamp(glm::dot(p - a, way) / squared, 0.0, 1.0) : 0.0;
  return glm::distance(p, a + at * way);
}

Measured closest_approach(const Signals& signals) {
  const glm::dvec3& center = signals.setting.target->center_lps_mm;
  double nearest_mm = glm::distance(center, signals.poses.front().tip_at_rest_lps_mm());
  for (std::size_t i = 0; i + 1 < signals.poses.size(); ++i) {
    const glm::dvec3 &from = signals.poses[i].tip_at_rest_lps_mm(), &to = signals.poses[i + 1].tip_at_rest_lps_mm();
    nearest_mm = std::min(nearest_mm, distance_to_segment(center, signals.gap(i) ? to : from, to));
  }
  return Measured::of(nearest_mm);
}

Measured entry_angle_error(const Signals& signals) {
  const PunctureCounts counts = count_punctures(signals);
  if (counts.punctures == 0) return Measured::none("never_punctured");
  const glm::dvec3& direction = signals.poses[counts.first_pose].needle_direction;
  const glm::dvec3& planned = signals.setting.plan->direction;
  return Measured::of(std::atan2(glm::length(glm::cross(direction, planned)), glm::dot(direction, planned)) *
                      180.0 / std::numbers::pi);
}

Measured entry_point_error(const Signals& signals) {
  const PunctureCounts counts = count_punctures(signals);
  if (counts.punctures == 0) return Measured::none("never_punctured");
  return Measured::of(
      glm::distance(signals.passages[counts.first_pose].entry_lps_mm, signals.setting.plan->entry_lps_mm));
}

constexpr const char* kPlanned = "planned entry and depth are a step of the task (task analysis, step 6)";

constexpr MetricInfo kApproachMetrics[] = {
    {"closest_approach", 1, "mm", "Closest approach", Group::target, Direction::lower_is_better, kTarget,
     "Smallest distance of the tip from the target's centre on the whole path, before a core needle's throw; "
     "secondary to tip_target_dist. Gaps over 0.25 s are not bridged.",
     "Perk Tutor's TargetsHit, as a distance", &closest_approach, kMedianRatio, kOfTheWay},
    {"entry_angle_error", 1, "deg", "Angle to planned entry", Group::path, Direction::lower_is_better,
     kPlan | kSkin | kMotion,
     "Angle between the needle and the planned direction at the first pose in the body of the first skin puncture. "
     "Null: never_punctured.",
     kPlanned, &entry_angle_error, kMedianRatio, kOfTheWay | kNothingIsNothing},
    {"entry_point_error", 1, "mm", "Distance from planned entry", Group::path, Direction::lower_is_better,
     kPlan | kSkin | kMotion,
     "From where the first skin puncture went through the skin to the planned entry. Null: never_punctured.",
     kPlanned, &entry_point_error, kMedianRatio, kOfTheWay | kNothingIsNothing},
};

}  // namespace

std::span<const MetricInfo> approach_metrics() {
  return kApproachMetrics;
}

}  // namespace seldinger::assessment
