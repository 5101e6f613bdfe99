#include "app/window/hands/braced_hand.h"

namespace seldinger::app {

cases::ToolPose BracedHand::carried(cases::ToolPose at_rest, double inserted_mm) const noexcept {
  if (tissue::count_sources(breath_) == 0 || scene_.skin_index.empty()) return at_rest;
  const glm::dvec3 skin_lps_mm =
      scene_.skin_index.closest(at_rest.position_lps_mm - inserted_mm * at_rest.axis).point_lps_mm;
  at_rest.position_lps_mm += tissue::displaced(breath_, skin_lps_mm) - skin_lps_mm;
  return at_rest;
}

// The skin that carries it is looked for at rest, where the last guess says: each step comes nearer by as much as
// breath varies along the skin, which is little.
cases::ToolPose BracedHand::put_back(const cases::ToolPose& pose, double inserted_mm) const noexcept {
  constexpr int kSteps = 8;
  cases::ToolPose at_rest = pose;
  for (int i = 0; i < kSteps; ++i)
    at_rest.position_lps_mm += pose.position_lps_mm - carried(at_rest, inserted_mm).position_lps_mm;
  return at_rest;
}

}  // namespace seldinger::app
