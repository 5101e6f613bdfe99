#include "sim/imaging/ultrasound/view/portal_walls.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <string_view>

#include "sim/base/ascii.h"
#include "sim/base/check.h"
#include "sim/case/paint.h"
#include "sim/imaging/ultrasound/view/echogenicity.h"
#include "sim/imaging/ultrasound/view/organs.h"

namespace seldinger::imaging {
namespace {

using volume::TissueClass;

bool is_portal(std::string_view name) {
  return base::lower(name).find("portal") != std::string::npos;
}

// Steps from a voxel to all that lie within the wall's thickness of it.
std::vector<glm::ivec3> steps_within(const glm::dvec3& spacing_mm, double mm) {
  std::vector<glm::ivec3> steps;
  const glm::ivec3 reach(glm::floor(mm / spacing_mm));
  for (int z = -reach.z; z <= reach.z; ++z)
    for (int y = -reach.y; y <= reach.y; ++y)
      for (int x = -reach.x; x <= reach.x; ++x) {
        const glm::dvec3 away_mm = glm::dvec3(x, y, z) * spacing_mm;
        if (glm::dot(away_mm, away_mm) <= mm * mm) steps.emplace_back(x, y, z);
      }
  return steps;
}

}  // namespace

void PortalLumen::add(const volume::LabelMap& labels) {
  std::vector<std::uint8_t> portal(labels.names.size(), 0);
  bool any = false;
  for (std::size_t i = 1; i < portal.size(); ++i) {
    portal[i] = is_portal(labels.names[i]) ? 1 : 0;
    any = any || portal[i] != 0;
  }
  if (!any || labels.label.size() != volume_.hu.size()) return;
  voxels_.resize(volume_.hu.size());
  for (std::size_t i = 0; i < voxels_.size(); ++i)
    if (labels.label[i] < portal.size() && portal[labels.label[i]] != 0) voxels_[i] = 1;
}

void PortalLumen::add(std::span<const cases::Structure> structures) {
  for (const cases::Structure& one : structures) {
    if (one.tissue != TissueClass::vessel || !is_portal(one.name)) continue;
    voxels_.resize(volume_.hu.size());
    cases::over_voxels_in(one.shape, volume_, 0.0, [&](std::size_t at, double) { voxels_[at] = 1; });
  }
}

void show_portal_walls(const volume::Volume& volume, std::span<const TissueClass> classes,
                       std::span<const std::uint8_t> lumen, std::span<std::uint8_t> levels) {
  if (lumen.empty()) return;
  CHECK(lumen.size() == classes.size() && levels.size() == classes.size() && classes.size() == volume.hu.size());
  const double wall_db = organ_row(Organ::portal_wall).level_db;
  const std::vector<glm::ivec3> steps = steps_within(volume.spacing_mm, kPortalWallMm);
  std::size_t from = 0;
  for (int k = 0; k < volume.size_voxels.z; ++k)
    for (int j = 0; j < volume.size_voxels.y; ++j)
      for (int i = 0; i < volume.size_voxels.x; ++i, ++from) {
        if (lumen[from] == 0) continue;
        for (const glm::ivec3& step : steps) {
          const glm::ivec3 to = glm::ivec3(i, j, k) + step;
          if (glm::any(glm::lessThan(to, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(to, volume.size_voxels)))
            continue;
          const std::size_t at = volume.index(to.x, to.y, to.z);
          if (lumen[at] == 0 && (classes[at] == TissueClass::liver || classes[at] == TissueClass::soft_tissue))
            levels[at] = echo_level(wall_db, classes[at]);
        }
      }
}

}  // namespace seldinger::imaging
