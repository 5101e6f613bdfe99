// Contrast medium in the patient, as a volume of its own that the projectors of any patient can integrate: a voxel
// that is filled to a share c of what was injected has −1000 + 1000 · c HU, so that its "millimetres of water" are
// millimetres of contrast medium.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "sim/case/needle_flow.h"
#include "sim/imaging/xray/projection/moved_volume.h"
#include "sim/imaging/xray/projection/projection.h"
#include "sim/tissue/displacement.h"
#include "sim/tissue/lumens.h"
#include "sim/volume/volume.h"

namespace seldinger::imaging {

class ContrastMedium {
 public:
  // `patient` must outlive it.
  ContrastMedium(const volume::Volume& patient, tissue::Lumens lumens);

  // From now on what `flow` says: each pool fills its lumen along the way from where it came out, or tissue round
  // about that. False: there is none.
  bool take(const cases::NeedleFlow& flow);

  // Millimetres of it on each pixel's ray, row by row; only after a take() that was true. `geometry` in order
  // (check_geometry).
  std::vector<float> lengths_mm(const XrayGeometry& geometry, const tissue::Displacement& displacement,
                                int threads);

  // What lengths_mm() integrated last, where tissue had taken it.
  const volume::Volume& shown() const noexcept { return moved_ ? moved_->volume() : volume_; }

 private:
  // What lies where, from the pool's place on.
  struct Order {
    std::int32_t lumen = -1;
    glm::dvec3 at_rest_lps_mm{0.0};
    std::vector<std::uint32_t> voxels;
  };
  const std::vector<std::uint32_t>& order_of(const cases::ContrastPool& pool, Order& order) const;
  std::vector<std::uint32_t> depot_order(const glm::dvec3& at_lps_mm, double ml) const;

  const volume::Volume& patient_;
  tissue::Lumens lumens_;
  std::array<Order, cases::kContrastPools> orders_{};
  std::array<cases::ContrastPool, cases::kContrastPools> taken_{};
  volume::Volume volume_;  // at rest: the box around what there is, and a voxel more on each side
  std::optional<MovedVolume> moved_;
};

}  // namespace seldinger::imaging
