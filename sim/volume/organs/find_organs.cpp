#include "sim/volume/organs/find_organs.h"

#include "sim/base/check.h"
#include "sim/volume/organs/chest.h"
#include "sim/volume/organs/great_vessels.h"
#include "sim/volume/organs/solid_organs.h"

namespace seldinger::volume {

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
    take(find_solid_organs(grid, middle_mm));
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
