#include "assessment/operators/organ_places.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/vec4.hpp>

namespace seldinger::assessment {
namespace {

bool is_solid(volume::FoundOrgan organ) {
  using volume::FoundOrgan;
  return organ == FoundOrgan::liver || organ == FoundOrgan::spleen || organ == FoundOrgan::right_kidney ||
         organ == FoundOrgan::left_kidney;
}

}  // namespace

OrganPlaces::OrganPlaces(const volume::Organs& organs)
    : organs_(organs),
      grid_from_lps_(volume::voxel_from_lps(organs.grid)),
      lungs_(static_cast<std::size_t>(organs.grid.size_voxels.z)) {
  const glm::ivec3 n = organs.grid.size_voxels;
  for (int k = 0; k < n.z; ++k) {
    std::optional<int> right, left;
    for (int j = 0; j < n.y; ++j)
      for (int i = 0; i < n.x; ++i) {
        const volume::FoundOrgan organ = organs.at[organs.grid.index(i, j, k)];
        if (organ == volume::FoundOrgan::right_lung) right = std::min(i, right.value_or(i));
        if (organ == volume::FoundOrgan::left_lung) left = std::max(i, left.value_or(i));
      }
    if (right && left) lungs_[static_cast<std::size_t>(k)] = {*right, *left};
  }
  // A slice that holds none: as the nearest that does.
  for (std::size_t k = 1; k < lungs_.size(); ++k)
    if (!lungs_[k]) lungs_[k] = lungs_[k - 1];
  for (std::size_t k = lungs_.size(); k-- > 1;)
    if (!lungs_[k - 1]) lungs_[k - 1] = lungs_[k];
}

std::optional<int> OrganPlaces::rank(const glm::dvec3& center_lps_mm, double radius_mm) const {
  const auto organ = volume::organ_at(organs_, center_lps_mm);
  const std::array<glm::dvec3, 6> around{{{radius_mm, 0, 0},
                                          {-radius_mm, 0, 0},
                                          {0, radius_mm, 0},
                                          {0, -radius_mm, 0},
                                          {0, 0, radius_mm},
                                          {0, 0, -radius_mm}}};
  if (organ && is_solid(organ->organ) && std::all_of(around.begin(), around.end(), [&](const glm::dvec3& off) {
        const auto there = volume::organ_at(organs_, center_lps_mm + off);
        return there && there->organ == organ->organ;
      }))
    return 0;
  const glm::ivec3 at(glm::round(glm::dvec3(grid_from_lps_ * glm::dvec4(center_lps_mm, 1.0))));
  const auto& lungs = lungs_[static_cast<std::size_t>(std::clamp(at.z, 0, organs_.grid.size_voxels.z - 1))];
  if (lungs && (at.x < lungs->right || at.x > lungs->left)) return std::nullopt;
  return 1;
}

}  // namespace seldinger::assessment
