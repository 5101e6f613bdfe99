#include "assessment/operators/probe_over.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "sim/base/exact_math.h"

namespace seldinger::assessment {
namespace {

// The probe turned about its long side so that its plane holds p, by no more than kMostFanDeg.
cases::ToolPose fanned_to(cases::ToolPose probe, const glm::dvec3& p) {
  const glm::dvec3 to = p - probe.position_lps_mm, normal = plane_normal(probe);
  const double ahead_mm = glm::dot(to, normal), deep_mm = glm::dot(to, probe.axis);
  const double most = kMostFanDeg * std::numbers::pi / 180.0;
  const double angle = deep_mm > 0.0 ? std::clamp(base::exact_atan(ahead_mm / deep_mm), -most, most)
                                     : (ahead_mm < 0.0 ? -most : most);
  probe.axis = glm::normalize(probe.axis * base::exact_cos(angle) + normal * base::exact_sin(angle));
  return probe;
}

// In its plane, rocked little by little as the needle goes in.
cases::ToolPose rocked_over(const PuncturePlan& plan, double inserted_mm) noexcept {
  const double share = plan.depth_mm > 0.0 ? std::clamp(inserted_mm / plan.depth_mm, 0.0, 1.0) : 1.0;
  const cases::ToolPose &first = plan.probe_first, &last = plan.probe;
  if (share == 1.0 || first.axis == last.axis) return last;
  cases::ToolPose probe = last;
  probe.position_lps_mm = first.position_lps_mm + share * (last.position_lps_mm - first.position_lps_mm);
  probe.axis = glm::normalize(first.axis + share * (last.axis - first.axis));
  probe.side = glm::normalize(last.side - probe.axis * glm::dot(last.side, probe.axis));
  return probe;
}

}  // namespace

glm::dvec3 plane_normal(const cases::ToolPose& probe) noexcept {
  return glm::cross(probe.side, probe.axis);
}

cases::ToolPose probe_over(const PuncturePlan& plan, double inserted_mm) noexcept {
  if (plan.approach == cases::Approach::in_plane) return rocked_over(plan, inserted_mm);
  const glm::dvec3 tip = plan.entry_lps_mm + inserted_mm * plan.direction;
  const glm::dvec3 slide = plan.probe.position_lps_mm - plan.probe_first.position_lps_mm;
  const glm::dvec3 normal = plane_normal(plan.probe);
  const double whole_mm = glm::dot(slide, normal);
  const double share =
      std::abs(whole_mm) > 1.0
          ? std::clamp(glm::dot(tip - plan.probe_first.position_lps_mm, normal) / whole_mm, 0.0, 1.0)
          : 1.0;
  cases::ToolPose probe = plan.probe;
  probe.position_lps_mm = plan.probe_first.position_lps_mm + share * slide;
  probe.axis = glm::normalize(plan.probe_first.axis + share * (plan.probe.axis - plan.probe_first.axis));
  return fanned_to(probe, tip);
}

}  // namespace seldinger::assessment
