#include "sim/case/skin_passage.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace seldinger::cases {

SkinPassage start_passage(const MeshIndex& skin, const glm::dvec3& tip_lps_mm,
                          const glm::dvec3& direction) noexcept {
  SkinPassage passage;
  passage.tip_lps_mm = passage.asked_lps_mm = tip_lps_mm;
  if (skin.empty()) return passage;
  const Closest near = skin.closest_skin(tip_lps_mm);
  passage.triangle = near.triangle;
  passage.geometric_inside = passage.in_body = near.distance_mm < 0.0;
  passage.depth_mm = -near.distance_mm;
  if (passage.in_body) {
    const auto behind = skin.first_hit(tip_lps_mm, -direction, 1000.0);
    passage.entry_lps_mm = behind ? tip_lps_mm - direction * behind->distance_mm : near.point_lps_mm;
  }
  return passage;
}

void advance_passage(const MeshIndex& skin, const glm::dvec3& tip_lps_mm, SkinPassage& passage) noexcept {
  const glm::dvec3 from = passage.tip_lps_mm;
  passage.tip_lps_mm = tip_lps_mm;
  if (skin.empty()) return;
  // A distance changes by no more than the way: what is left of it is a bound.
  const glm::dvec3 since = tip_lps_mm - passage.asked_lps_mm;
  const double moved_mm = std::sqrt(glm::dot(since, since));
  if (moved_mm < kStaleMm && std::abs(passage.depth_mm) - moved_mm > kFarMm) return;
  passage.asked_lps_mm = tip_lps_mm;
  const Closest near = skin.closest_skin(tip_lps_mm, passage.triangle);
  const bool inside = near.distance_mm < 0.0;
  if (inside != passage.geometric_inside) {
    const glm::dvec3 way = tip_lps_mm - from;
    const double length_mm = std::sqrt(glm::dot(way, way));
    const auto hit = length_mm > 0.0 ? skin.first_hit(from, way / length_mm, length_mm) : std::nullopt;
    // Rounding can hide a crossing of a few 1e-12 mm: the nearest skin point is then as good.
    const bool through_cap = hit ? hit->cut : skin.cut(skin.closest(tip_lps_mm, near.triangle).triangle);
    if (!through_cap) {
      passage.in_body = inside;
      if (inside) passage.entry_lps_mm = hit ? from + way * (hit->distance_mm / length_mm) : near.point_lps_mm;
    }
    passage.geometric_inside = inside;
  }
  passage.triangle = near.triangle;
  passage.depth_mm = passage.in_body ? std::abs(near.distance_mm) : -std::abs(near.distance_mm);
}

}  // namespace seldinger::cases
