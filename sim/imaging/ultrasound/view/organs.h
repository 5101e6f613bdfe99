// How organs and layers are told apart on the screen: which of them a voxel is, by its class and place, and at what
// level it is drawn over liver. Fixed to the tissue, so it moves with it and costs nothing while pictures are made.
// What CT cannot resolve (septa of fat, fascia, fibres of muscle, pyramids) is made from place alone.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim/volume/classes.h"
#include "sim/volume/volume.h"

namespace seldinger::imaging {

enum class Organ : std::uint8_t {
  none,  // drawn as its class, or as its HU say
  skin,
  fat_under_skin,
  fascia,
  muscle,
  fat_inside,  // mesentery and what lies about organs
  diaphragm,
  spleen,
  kidney_cortex,
  kidney_pyramid,
  kidney_sinus,
  bowel_wall,
  portal_wall,  // by name alone (portal_walls.h)
};
constexpr std::size_t kOrgans = 13;

struct OrganRow {
  Organ organ;
  const char* name;
  double level_db;     // mean square echo over liver's, texture included
  const char* source;  // measured, recalled or tuned, and from where
};
std::span<const OrganRow, kOrgans> organ_rows() noexcept;
const OrganRow& organ_row(Organ organ) noexcept;

// Of every voxel. Layers of the wall are found slice by slice from the air outside inward: fat before anything else
// is the skin's, what comes next is fascia and muscle (soft tissue for kWallMuscleMm, where no label tells).
constexpr double kSkinMm = 2.0, kFasciaMm = 2.0, kWallMuscleMm = 12.0, kCortexMm = 7.0, kDiaphragmMm = 3.0,
                 kBowelWallMm = 3.0;
std::vector<Organ> organs_of(const volume::Volume& volume, std::span<const volume::TissueClass> classes,
                             int threads = 0);

// Puts the level of each voxel that is of an organ into `levels` (echogenicity.h). Same bytes for any number of
// threads.
void show_organs(const volume::Volume& volume, std::span<const volume::TissueClass> classes,
                 std::span<std::uint8_t> levels, int threads = 0);

}  // namespace seldinger::imaging
