#include "tests/casedb/import/cuts/ways.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <utility>

#include "sim/base/rng.h"

namespace seldinger::volume {

std::vector<Way> ways() {
  constexpr std::array kSpacingsMm{1, 2, 3, 5};
  constexpr std::array kNoiseSdHu{6.0, 12.0, 20.0};
  std::vector<Way> made;
  std::size_t which = 0;
  for (Crop& crop : crops()) {
    const std::size_t kind = which++ % 12;  // a spacing with a noise; phases and metal go on every twelve
    const std::size_t round = (which - 1) / 12;
    made.push_back({std::move(crop), kSpacingsMm[kind % 4], kTorsoPhases[(kind + kind / 4 + round) % 4],
                    kNoiseSdHu[kind % 3], (kind + round) % 2 == 1});
  }
  return made;
}

bool alike(const Way& one, const Way& other) {
  return one.spacing_mm == other.spacing_mm && one.phase == other.phase && one.noise_sd_hu == other.noise_sd_hu &&
         one.metal == other.metal;
}

Volume seen(const Volume& ct, const Way& way) {
  Volume made = coarser(ct, way.spacing_mm);
  const glm::dvec3 middle_mm = glm::dvec3(made.size_voxels - 1) / 2.0 * made.spacing_mm;
  for (int k = 0; k < made.size_voxels.z; ++k)
    for (int j = 0; j < made.size_voxels.y; ++j)
      for (int i = 0; i < made.size_voxels.x; ++i) {
        const std::size_t at = made.index(i, j, k);
        const glm::dvec3 off_mm = glm::abs(glm::dvec3(i, j, k) * made.spacing_mm - middle_mm);
        if (way.metal && std::hypot(off_mm.x, off_mm.z) <= 3.0 && off_mm.y <= 30.0) {
          made.hu[at] = 3071;
        } else if (made.hu[at] > kAirHu) {  // what was not measured stays so
          const double sd_hu = made.hu[at] < -900 ? way.noise_sd_hu / 2.0 : way.noise_sd_hu;
          made.hu[at] = static_cast<std::int16_t>(
              std::clamp(std::round(made.hu[at] + sd_hu * base::normal_at(7, at)), double{kAirHu}, 32767.0));
        }
      }
  return made;
}

EnhancedTorso cropped(const EnhancedTorso& torso, const std::vector<std::uint8_t>& body, const Crop& crop) {
  EnhancedTorso made;
  made.volume = cropped(torso.volume, body, crop);
  made.truth.names = torso.truth.names;
  made.truth.label.resize(made.volume.hu.size());
  made.bone_share.resize(made.volume.hu.size());
  const glm::ivec3 n = made.volume.size_voxels;
  const glm::ivec3 low(
      glm::round((glm::dvec3(made.volume.lps_from_voxel[3]) - glm::dvec3(torso.volume.lps_from_voxel[3])) /
                 torso.volume.spacing_mm));
  for (int k = 0; k < n.z; ++k)
    for (int j = 0; j < n.y; ++j)
      for (int i = 0; i < n.x; ++i) {
        const std::size_t at = made.volume.index(i, j, k),
                          from = torso.volume.index(i + low.x, j + low.y, k + low.z);
        if (made.volume.hu[at] == kAirHu) continue;
        made.truth.label[at] = torso.truth.label[from];
        made.bone_share[at] = torso.bone_share[from];
      }
  return made;
}

}  // namespace seldinger::volume
