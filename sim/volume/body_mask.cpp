#include "sim/volume/body_mask.h"

#include <algorithm>
#include <cmath>

#include "sim/volume/axial_slices.h"
#include "sim/volume/components.h"

namespace seldinger::volume {
namespace {

// The cover of a couch's mattress may touch the back and so belong to the same component, though it is a sheet of 2
// to 3 mm. A part thinner than about 5 mm and longer than 80 mm is no part of a body; an ear or a finger is
// shorter.
constexpr double kSheetRadiusMm = 2.0, kSheetLengthMm = 80.0;

void drop_sheets(const Volume& volume, const AxialSlices& slices, std::vector<std::uint8_t>& mask) {
  const glm::dvec2 spacing_mm = slices.spacing_mm();
  const glm::ivec2 radius(std::max(1, static_cast<int>(std::lround(kSheetRadiusMm / spacing_mm.x))),
                          std::max(1, static_cast<int>(std::lround(kSheetRadiusMm / spacing_mm.y))));
  std::vector<std::uint8_t> kept = mask;
  Components(volume.size_voxels, thin_parts(slices, mask, radius))
      .paint(
          [&](const Piece& piece) {
            const glm::dvec3 extent_mm = glm::dvec3(piece.high - piece.low + 1) * volume.spacing_mm;
            return std::max({extent_mm.x, extent_mm.y, extent_mm.z}) >= kSheetLengthMm;
          },
          0, kept);
  Components(volume.size_voxels, kept).keep_largest(kept);
  // A body that is a sheet all over stays as it is.
  if (std::count(kept.begin(), kept.end(), 1) * 2 > std::count(mask.begin(), mask.end(), 1)) mask = std::move(kept);
}

}  // namespace

std::vector<std::uint8_t> body_mask(const Volume& volume, int threshold_hu) {
  std::vector<std::uint8_t> mask(volume.hu.size());
  std::transform(volume.hu.begin(), volume.hu.end(), mask.begin(),
                 [&](std::int16_t hu) { return static_cast<std::uint8_t>(hu > threshold_hu ? 1 : 0); });
  Components(volume.size_voxels, mask).keep_largest(mask);
  if (std::find(mask.begin(), mask.end(), std::uint8_t{1}) == mask.end()) return mask;
  const AxialSlices slices(volume);
  drop_sheets(volume, slices, mask);
  fill_slices(slices, mask);
  return mask;
}

}  // namespace seldinger::volume
