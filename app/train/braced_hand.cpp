#include "app/train/braced_hand.h"

namespace seldinger::app {

cases::ToolPose BracedHand::carried(cases::ToolPose at_rest, double inserted_mm) const noexcept {
  if (tissue::count_sources(breath_) == 0 || scene_.skin_index.empty()) return at_rest;
  const glm::dvec3 skin_lps_mm =
      scene_.skin_index.closest(at_rest.position_lps_mm - inserted_mm * at_rest.axis).point_lps_mm;
  at_rest.position_lps_mm += tissue::displaced(breath_, skin_lps_mm) - skin_lps_mm;
  return at_rest;
}

}  // namespace seldinger::app
