#include "app/hands/arms_seen.h"

#include <glm/geometric.hpp>
#include <limits>

namespace seldinger::app {
namespace {

constexpr double kCountS = 0.5, kShowS = 0.02;

}  // namespace

void ArmsWatch::see(std::size_t side, const devices::ArmReading& reading, const glm::dvec3& asked_n,
                    double elapsed_s) noexcept {
  ArmSeen& arm = seen_[side];
  arm.reading = reading;
  arm.asked_n = asked_n;
  for (int axis = 0; axis < 3; ++axis)
    arm.at_mm[static_cast<std::size_t>(axis)].add(
        reading.healthy ? reading.position_mm[axis] : std::numeric_limits<double>::quiet_NaN(), elapsed_s);
  arm.force_n.add(glm::length(asked_n), elapsed_s);
  counted_for_s_[side] += elapsed_s;
  if (counted_for_s_[side] < kCountS) return;
  arm.readings_per_s = static_cast<double>(reading.count - counted_[side]) / counted_for_s_[side];
  counted_[side] = reading.count;
  counted_for_s_[side] = 0.0;
}

bool ArmsWatch::due(double elapsed_s) noexcept {
  shown_for_s_ += elapsed_s;
  if (shown_for_s_ < kShowS) return false;
  shown_for_s_ = 0.0;
  return true;
}

}  // namespace seldinger::app
