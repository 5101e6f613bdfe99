#include "sim/volume/organs/organ_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec4.hpp>

namespace seldinger::volume {
namespace {

constexpr double kAlikeSd = 3.0;

Volume empty_grid(const Volume& volume) {
  glm::dvec3 low_mm(1e9), high_mm(-1e9);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::ivec3 at(corner % 2, corner / 2 % 2, corner / 4);
    const glm::dvec3 p(volume.lps_from_voxel * glm::dvec4(glm::dvec3(at * (volume.size_voxels - 1)), 1.0));
    low_mm = glm::min(low_mm, p);
    high_mm = glm::max(high_mm, p);
  }
  const glm::ivec3 size = glm::ivec3(glm::floor((high_mm - low_mm) / kOrganGridMm)) + 1;
  return make_volume(size, glm::dvec3(kOrganGridMm), glm::dmat3(1.0), low_mm);
}

// From neighbours along x; their differences' median is 0.954 sd.
double noise_of(const OrganGrid& grid) {
  std::array<std::size_t, 512> count{};
  std::size_t pairs = 0;
  const auto width = static_cast<std::size_t>(grid.volume.size_voxels.x);
  for (std::size_t at = 0; at + 1 < grid.soft.size(); ++at) {
    if (grid.soft[at] == 0 || grid.soft[at + 1] == 0 || (at + 1) % width == 0) continue;
    ++count[static_cast<std::size_t>(std::min(511, std::abs(grid.volume.hu[at] - grid.volume.hu[at + 1])))];
    ++pairs;
  }
  std::size_t below = 0;
  for (std::size_t hu = 0; hu < count.size(); ++hu)
    if ((below += count[hu]) * 2 >= pairs) return std::max(1.0, static_cast<double>(hu) / 0.954);
  return 1.0;
}

// The mean of a voxel's neighbours that are soft and differ from it by no more than noise.
void smooth(OrganGrid& grid) {
  const double alike_hu = kAlikeSd * grid.noise_sd_hu;
  const std::vector<std::int16_t>& hu = grid.volume.hu;
  const glm::ivec3 n = grid.volume.size_voxels;
  for (int k = 0; k < n.z; ++k)
    for (int j = 0; j < n.y; ++j)
      for (int i = 0; i < n.x; ++i) {
        const std::size_t at = grid.volume.index(i, j, k);
        if (grid.soft[at] == 0) continue;
        double sum = 0.0;
        int count = 0;
        for (int z = std::max(0, k - 1); z <= std::min(n.z - 1, k + 1); ++z)
          for (int y = std::max(0, j - 1); y <= std::min(n.y - 1, j + 1); ++y)
            for (int x = std::max(0, i - 1); x <= std::min(n.x - 1, i + 1); ++x) {
              const std::size_t other = grid.volume.index(x, y, z);
              if (grid.soft[other] == 0 || std::abs(hu[other] - hu[at]) > alike_hu) continue;
              sum += hu[other];
              ++count;
            }
        grid.level_hu[at] = static_cast<float>(sum / count);
      }
}

}  // namespace

OrganGrid organ_grid(const Volume& volume, const std::vector<TissueClass>& classes) {
  OrganGrid made;
  made.volume = empty_grid(volume);
  const glm::ivec3 n = made.volume.size_voxels;
  const std::size_t voxels = made.volume.hu.size();
  made.soft.assign(voxels, 0), made.bone.assign(voxels, 0), made.lung.assign(voxels, 0),
      made.body.assign(voxels, 0);
  made.level_hu.assign(voxels, 0.0F);
  const glm::dmat4 from_grid = voxel_from_lps(volume) * made.volume.lps_from_voxel;
  std::array<glm::dvec3, 27> parts;
  for (int part = 0; part < 27; ++part)
    parts[static_cast<std::size_t>(part)] =
        glm::dmat3(from_grid) * (glm::dvec3(part % 3 - 1, part / 3 % 3 - 1, part / 9 - 1) / 3.0);
  for (int k = 0; k < n.z; ++k)
    for (int j = 0; j < n.y; ++j)
      for (int i = 0; i < n.x; ++i) {
        double sum = 0.0;
        int inside = 0, soft = 0, bone = 0, lung = 0, body = 0;
        const glm::dvec3 middle = glm::dvec3(from_grid * glm::dvec4(i, j, k, 1.0)) + 0.5;
        for (const glm::dvec3& part : parts) {
          const glm::ivec3 at(glm::floor(middle + part));
          if (at.x < 0 || at.y < 0 || at.z < 0 || at.x >= volume.size_voxels.x || at.y >= volume.size_voxels.y ||
              at.z >= volume.size_voxels.z)
            continue;
          const std::size_t from = volume.index(at.x, at.y, at.z);
          const TissueClass tissue = classes[from];
          sum += volume.hu[from];
          ++inside;
          soft += tissue != TissueClass::air && tissue != TissueClass::gas && tissue != TissueClass::lung &&
                          tissue != TissueClass::fat && tissue != TissueClass::bone && tissue != TissueClass::metal
                      ? 1
                      : 0;
          bone += tissue == TissueClass::bone ? 1 : 0;
          lung += tissue == TissueClass::lung ? 1 : 0;
          body += tissue != TissueClass::air ? 1 : 0;
        }
        if (inside == 0) continue;
        const std::size_t at = made.volume.index(i, j, k);
        made.volume.hu[at] = static_cast<std::int16_t>(std::lround(sum / inside));
        made.soft[at] = soft * 2 > inside ? 1 : 0;
        made.bone[at] = bone * 2 > inside ? 1 : 0;
        made.lung[at] = lung * 2 > inside ? 1 : 0;
        made.body[at] = body * 2 > inside ? 1 : 0;
      }
  made.noise_sd_hu = noise_of(made);
  smooth(made);
  return made;
}

}  // namespace seldinger::volume
