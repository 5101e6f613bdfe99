#include "sim/devices/virtual_device.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace seldinger::devices {
namespace {

glm::dvec3 quantised(const glm::dvec3& v, double quantum) noexcept {
  return glm::floor(v / quantum + 0.5) * quantum;
}

}  // namespace

cases::ToolPose VirtualDevice::advance(const cases::ToolPose& hand, double dt_s) noexcept {
  if (!started_) {
    pose_ = hand;
    started_ = true;
  }
  const double share = dt_s / (options_.lag_s + dt_s);  // implicit Euler of the lag: stable for every dt
  glm::dvec3 move = (hand.position_lps_mm - pose_.position_lps_mm) * share;
  const double length_mm = std::sqrt(glm::dot(move, move)), limit_mm = options_.max_speed_mm_s * dt_s;
  if (length_mm > limit_mm) move *= limit_mm / length_mm;
  pose_.position_lps_mm += move;
  pose_.axis += (hand.axis - pose_.axis) * share;
  pose_.side += (hand.side - pose_.side) * share;
  return {quantised(pose_.position_lps_mm, options_.encoder_mm), quantised(pose_.axis, options_.encoder_unit),
          quantised(pose_.side, options_.encoder_unit)};
}

cases::ToolPose VirtualDevice::follow(const cases::ToolPose& read) noexcept {
  pose_ = read;
  started_ = true;
  return advance(read, 0.0);
}

}  // namespace seldinger::devices
