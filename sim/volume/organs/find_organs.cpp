#include "sim/volume/organs/find_organs.h"

#include <glm/common.hpp>
#include <glm/vec4.hpp>
#include <utility>

#include "sim/base/check.h"
#include "sim/volume/organs/chest.h"
#include "sim/volume/organs/great_vessels.h"
#include "sim/volume/organs/solid_organs.h"

namespace seldinger::volume {

std::optional<OrganFound> organ_at(const Organs& organs, const glm::dvec3& lps_mm) {
  const glm::ivec3 at(glm::round(glm::dvec3(voxel_from_lps(organs.grid) * glm::dvec4(lps_mm, 1.0))));
  if (at != glm::clamp(at, glm::ivec3(0), organs.grid.size_voxels - 1)) return std::nullopt;
  const FoundOrgan organ = organs.at[organs.grid.index(at.x, at.y, at.z)];
  for (const OrganFound& one : organs.found)
    if (organ != FoundOrgan::none && one.organ == organ) return one;
  return std::nullopt;
}

std::optional<int> level_of(const Organs& organs, FoundOrgan organ) noexcept {
  for (const OrganFound& one : organs.found)
    if (one.organ == organ && one.confidence >= kOrganConfidence) return one.level_hu;
  return std::nullopt;
}

Organs find_organs(const Volume& volume, const std::vector<TissueClass>& classes) {
  CHECK(classes.size() == volume.hu.size());
  OrganGrid grid = organ_grid(volume, classes);
  Organs made;
  made.at.assign(grid.volume.hu.size(), FoundOrgan::none);
  std::vector<Part> parts;
  const auto take = [&](std::vector<Part> some) {
    for (Part& one : some) parts.push_back(std::move(one));
  };
  if (const std::vector<glm::dvec2> middle_mm = middle_of_back(grid); !middle_mm.empty()) {
    const Spine spine = find_spine(grid, middle_mm);
    const std::vector<Part> lungs = find_lungs(grid, middle_mm);
    std::vector<Part> solid = find_solid_organs(grid, middle_mm);
    std::optional<Part> gallbladder = find_gallbladder(grid, middle_mm, solid);
    take(std::move(solid));
    if (gallbladder) parts.push_back(std::move(*gallbladder));
    take(lungs);
    take(find_vertebrae(grid, spine));
    take(find_ribs(grid, spine, lungs));
    take(find_great_vessels(grid, spine));
  }
  for (const Part& one : parts) {
    made.found.push_back(one.found);
    if (one.found.confidence < kOrganConfidence) continue;
    for (const std::size_t at : one.voxels)
      if (made.at[at] == FoundOrgan::none) made.at[at] = one.found.organ;
  }
  made.grid = std::move(grid.volume);
  return made;
}

}  // namespace seldinger::volume
