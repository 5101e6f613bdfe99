// The distinct directions from which somebody looked, and the widest angle between two of them. Used by step() and,
// on recorded frames, by metrics, so that both tell the same numbers.
#pragma once

#include <array>
#include <glm/vec3.hpp>

namespace seldinger::cases {

constexpr int kMaxViews = 32;
constexpr double kViewApartDeg = 5.0;  // nearer to one already there, it is the same view

struct ViewingAngles {
  int count = 0;                            // of distinct views, at most kMaxViews
  double widest_deg = 0.0;                  // between two lines of sight, 0 to 90: opposite views show the same
  std::array<double, kMaxViews> lao_deg{};  // of the first `count`; 0 beyond
  std::array<double, kMaxViews> cranial_deg{};
  bool operator==(const ViewingAngles&) const = default;
};

// Takes in a picture from these angles. Allocation-free; the same bits on every machine.
void add_view(double lao_deg, double cranial_deg, ViewingAngles& views) noexcept;

}  // namespace seldinger::cases
