#include "sim/devices/arms/point_taking.h"

#include <glm/geometric.hpp>

#include "sim/base/check.h"
#include "sim/base/vectors.h"

namespace seldinger::devices {

std::optional<std::size_t> PointTaking::asked() const noexcept {
  for (std::size_t i = 0; i < kTemplatePoints; ++i)
    if (!taken_mm_[i] && !left_out_[i]) return i;
  return std::nullopt;
}

void PointTaking::again(std::size_t point) noexcept {
  CHECK(point < kTemplatePoints);
  taken_mm_[point].reset();
  left_out_[point] = false;
  state_ = Taking::waiting;
}

void PointTaking::leave_out() noexcept {
  const auto point = asked();
  if (!point || template_points()[*point].required) return;
  left_out_[*point] = true;
  state_ = Taking::waiting;
}

void PointTaking::advance(const ArmReading& reading, bool told, double elapsed_s) noexcept {
  const bool down = reading.buttons[0], pressed = told || (down && !was_down_);
  was_down_ = down;
  const auto point = asked();
  if (!point) return;
  if (!reading.healthy || !base::is_finite(reading.position_mm)) {
    if (state_ == Taking::reading || pressed) state_ = Taking::lost;
    return;
  }
  if (state_ != Taking::reading) {
    if (!pressed) return;
    state_ = Taking::reading;
    from_mm_ = reading.position_mm;
    sum_mm_ = glm::dvec3(0.0);
    read_s_ = 0.0;
    readings_ = 0;
  }
  if (glm::length(reading.position_mm - from_mm_) > kTakeStillMm) {
    state_ = Taking::moved;
    return;
  }
  sum_mm_ += reading.position_mm;
  ++readings_;
  read_s_ += elapsed_s;
  if (read_s_ < kTakeS) return;
  taken_mm_[*point] = sum_mm_ / static_cast<double>(readings_);
  state_ = Taking::waiting;
}

std::vector<TakenPoint> PointTaking::points() const {
  std::vector<TakenPoint> points;
  for (std::size_t i = 0; i < kTemplatePoints; ++i)
    if (taken_mm_[i]) points.push_back({template_points()[i].name, *taken_mm_[i]});
  return points;
}

}  // namespace seldinger::devices
