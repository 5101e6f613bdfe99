#include "sim/devices/virtual_arm.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace seldinger::devices {
namespace {

glm::dvec3 quantised(const glm::dvec3& v, double quantum) noexcept {
  return glm::floor(v / quantum + 0.5) * quantum;
}

}  // namespace

cases::ToolPose advance(const cases::ToolPose& hand, double dt_s, VirtualDeviceState& state,
                        const VirtualArmOptions& options) noexcept {
  cases::ToolPose& pose = state.pose;
  if (!state.started) {
    pose = hand;
    state.started = true;
  }
  const double share = dt_s / (options.lag_s + dt_s);  // implicit Euler of the lag: stable for every dt
  glm::dvec3 move = (hand.position_lps_mm - pose.position_lps_mm) * share;
  const double length_mm = std::sqrt(glm::dot(move, move)), limit_mm = options.max_speed_mm_s * dt_s;
  if (length_mm > limit_mm) move *= limit_mm / length_mm;
  pose.position_lps_mm += move;
  pose.axis += (hand.axis - pose.axis) * share;
  pose.side += (hand.side - pose.side) * share;
  return {quantised(pose.position_lps_mm, options.encoder_mm), quantised(pose.axis, options.encoder_unit),
          quantised(pose.side, options.encoder_unit)};
}

cases::ToolPose follow(const cases::ToolPose& read, VirtualDeviceState& state,
                       const VirtualArmOptions& options) noexcept {
  state = {read, true};
  return advance(read, 0.0, state, options);
}

}  // namespace seldinger::devices
