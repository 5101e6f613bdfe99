#include "app/window/hands/frame_plan.h"

#include <algorithm>

namespace seldinger::app {

double wait_for_picture_until_s(std::optional<double> expected_s, double began_s) noexcept {
  const double latest_s = began_s + kMostFrameS;
  if (!expected_s || *expected_s > latest_s) return began_s;
  return std::min(latest_s, *expected_s + kLateShare * std::max(0.0, *expected_s - began_s));
}

}  // namespace seldinger::app
