#include "sim/volume/organs/organ_classes.h"

#include <array>
#include <glm/common.hpp>
#include <glm/vec4.hpp>

#include "sim/base/check.h"
#include "sim/volume/tissue/find_tissue.h"

namespace seldinger::volume {
namespace {

struct OrganClass {
  TissueClass tissue;  // air: the organ's voxels stay what they are
  bool takes_vessel = false;
};

constexpr OrganClass class_of(FoundOrgan organ) {
  switch (organ) {
    case FoundOrgan::liver:
      return {TissueClass::liver};
    case FoundOrgan::spleen:
      return {TissueClass::spleen, true};
    case FoundOrgan::right_kidney:
    case FoundOrgan::left_kidney:
      return {TissueClass::kidney, true};
    case FoundOrgan::aorta:
    case FoundOrgan::vena_cava:
      return {TissueClass::vessel};
    case FoundOrgan::bladder:
    case FoundOrgan::gallbladder:
      return {TissueClass::fluid};
    case FoundOrgan::none:
    case FoundOrgan::right_lung:
    case FoundOrgan::left_lung:
    case FoundOrgan::vertebrae:
    case FoundOrgan::ribs:
      break;
  }
  return {TissueClass::air};
}

TissueClass marked(FoundOrgan organ, TissueClass tissue) {
  const OrganClass is = class_of(organ);
  const bool changes = tissue == TissueClass::soft_tissue || (tissue == TissueClass::vessel && is.takes_vessel);
  return changes && is.tissue != TissueClass::air ? is.tissue : tissue;
}

// That which makes up half or more of the eight voxels of the grid around a point, by how near they are.
FoundOrgan organ_between(const Organs& organs, const glm::dvec3& in_grid) {
  const glm::dvec3 low = glm::floor(in_grid), part = in_grid - low;
  const glm::ivec3 most = organs.grid.size_voxels - 1;
  std::array<double, kFoundOrganNames.size()> share{};
  for (int corner = 0; corner < 8; ++corner) {
    const glm::ivec3 step(corner & 1, (corner >> 1) & 1, corner >> 2);
    const glm::ivec3 at = glm::clamp(glm::ivec3(low) + step, glm::ivec3(0), most);
    const glm::dvec3 weight = glm::mix(1.0 - part, part, glm::dvec3(step));
    const FoundOrgan organ = organs.at[organs.grid.index(at.x, at.y, at.z)];
    if ((share[static_cast<std::size_t>(organ)] += weight.x * weight.y * weight.z) >= 0.5) return organ;
  }
  return FoundOrgan::none;
}

}  // namespace

void mark_organs(const Volume& volume, const Organs& organs, std::vector<TissueClass>& classes) {
  CHECK(classes.size() == volume.hu.size());
  const glm::dmat4 grid_from_voxel = voxel_from_lps(organs.grid) * volume.lps_from_voxel;
  const glm::dvec3 step(grid_from_voxel[0]);
  std::size_t at = 0;
  for (int k = 0; k < volume.size_voxels.z; ++k)
    for (int j = 0; j < volume.size_voxels.y; ++j) {
      const glm::dvec3 row(grid_from_voxel * glm::dvec4(0.0, j, k, 1.0));
      for (int i = 0; i < volume.size_voxels.x; ++i, ++at) {
        if (classes[at] == TissueClass::vessel || classes[at] == TissueClass::soft_tissue)
          classes[at] = marked(organ_between(organs, row + static_cast<double>(i) * step), classes[at]);
      }
    }
}

bool may_lie_in(FoundOrgan organ, TissueClass tissue) {
  const bool of_an_organ =
      tissue == TissueClass::liver || tissue == TissueClass::spleen || tissue == TissueClass::kidney;
  return of_an_organ ? tissue == class_of(organ).tissue : tissue == marked(organ, tissue);
}

MarkedClasses marked_classes(const Volume& volume, const LabelMap* labels) {
  MarkedClasses made{tissue_classes(volume, labels), std::nullopt};
  if (labels == nullptr) {
    made.organs = find_organs(volume, made.classes);
    mark_organs(volume, *made.organs, made.classes);
  }
  return made;
}

std::vector<TissueClass> classes_with_organs(const Volume& volume, const LabelMap* labels) {
  return marked_classes(volume, labels).classes;
}

}  // namespace seldinger::volume
