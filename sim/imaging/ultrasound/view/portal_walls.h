// The walls of the portal vein and its branches are bright, since connective tissue runs along with them; hepatic
// veins have none that shows. CT tells neither the wall nor which vein it is: names do, of labels and of
// structures.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim/case/case.h"
#include "sim/case/structure.h"
#include "sim/volume/classes.h"
#include "sim/volume/volume.h"

namespace seldinger::imaging {

// As thick as walls and what lies about them show on a picture (judgement; a portal tract's is some mm in the hilum
// and less than one at the margin).
constexpr double kPortalWallMm = 2.0;

// One byte a voxel, 1 where labels or structures have a portal vein; empty: nowhere.
class PortalLumen {
 public:
  explicit PortalLumen(const volume::Volume& volume) : volume_(volume) {}
  void add(const volume::LabelMap& labels);
  void add(std::span<const cases::Structure> structures);
  std::span<const std::uint8_t> voxels() const noexcept { return voxels_; }

 private:
  const volume::Volume& volume_;
  std::vector<std::uint8_t> voxels_;
};

inline bool draws_portal_walls(cases::SightLaw law) noexcept {
  return law >= cases::SightLaw::material;
}

// Liver and what no label tells apart get the walls' level (organs.h) within kPortalWallMm of the lumen; the lumen
// and all else keep theirs. Takes as long as there is lumen.
void show_portal_walls(const volume::Volume& volume, std::span<const volume::TissueClass> classes,
                       std::span<const std::uint8_t> lumen, std::span<std::uint8_t> levels);

}  // namespace seldinger::imaging
