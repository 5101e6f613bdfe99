#include "app/window/hands/calipers.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

#include "sim/imaging/ultrasound/console.h"

namespace seldinger::app {

void Calipers::press(const glm::dvec2& at_mm, double reach_mm) {
  held_.reset();
  double nearest_mm = reach_mm;
  for (std::size_t i = 0; i < ends_mm_.size(); ++i)
    if (const double away_mm = glm::distance(ends_mm_[i], at_mm); away_mm <= nearest_mm) {
      nearest_mm = away_mm;
      held_ = i;
    }
  if (held_) return drag(at_mm);
  if (ends_mm_.size() >= 2 * kMost) ends_mm_.clear();
  ends_mm_.push_back(at_mm);
  held_ = ends_mm_.size() - 1;
}

void Calipers::drag(const glm::dvec2& at_mm) noexcept {
  if (held_) ends_mm_[*held_] = at_mm;
}

void Calipers::clear() noexcept {
  ends_mm_.clear();
  held_.reset();
}

std::optional<double> Calipers::length_mm(std::size_t caliper) const noexcept {
  if (2 * caliper + 1 >= ends_mm_.size()) return std::nullopt;
  return imaging::caliper_mm(ends_mm_[2 * caliper], ends_mm_[2 * caliper + 1]);
}

std::optional<double> Calipers::depth_mm(std::size_t caliper) const noexcept {
  if (2 * caliper + 1 >= ends_mm_.size()) return std::nullopt;
  const double a_mm = ends_mm_[2 * caliper].y, b_mm = ends_mm_[2 * caliper + 1].y;
  if (std::abs(std::min(a_mm, b_mm)) > kAtFaceMm || !(std::max(a_mm, b_mm) > kAtFaceMm)) return std::nullopt;
  return std::max(a_mm, b_mm);
}

std::vector<std::string> Calipers::words() const {
  std::vector<std::string> lines;
  char text[64];
  for (std::size_t i = 0; i < kMost; ++i)
    if (const auto mm = length_mm(i)) {
      std::snprintf(text, sizeof text, "%c %.1f mm", static_cast<char>('A' + i), *mm);
      lines.emplace_back(text);
    }
  if (lines.size() == kMost) {
    std::snprintf(text, sizeof text, "ellipse %.0f mm2", imaging::ellipse_area_mm2(*length_mm(0), *length_mm(1)));
    lines.emplace_back(text);
  }
  return lines;
}

}  // namespace seldinger::app
