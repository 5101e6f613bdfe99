#include "sim/tissue/loose_organs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numbers>

namespace seldinger::tissue {
namespace {

using volume::TissueClass;

constexpr std::array<TissueClass, 3> kLoose = {TissueClass::liver, TissueClass::kidney, TissueClass::spleen};
constexpr double kLeastMl = 15.0;  // a newborn's kidney has some 20 ml (design)

double middle_x_mm(const cases::Mesh& skin) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const glm::vec3& vertex : skin.vertices_lps_mm) {
    low = std::min(low, static_cast<double>(vertex.x));
    high = std::max(high, static_cast<double>(vertex.x));
  }
  return 0.5 * (low + high);
}

}  // namespace

std::vector<LooseOrgan> loose_organs(const cases::Case& scene) {
  const volume::Volume& volume = scene.volume;
  if (scene.classes.size() != volume.hu.size() || scene.skin.vertices_lps_mm.empty()) return {};
  const double middle_mm = middle_x_mm(scene.skin);
  struct Sum {
    std::array<std::int64_t, 3> ijk{};
    std::int64_t voxels = 0;
  };
  std::array<std::array<Sum, 2>, kLoose.size()> sums{};
  std::array<int, 256> of_class;  // asked of every voxel
  of_class.fill(-1);
  for (std::size_t which = 0; which < kLoose.size(); ++which)
    of_class[static_cast<std::size_t>(kLoose[which])] = static_cast<int>(which);
  std::size_t at = 0;
  for (int k = 0; k < volume.size_voxels.z; ++k)
    for (int j = 0; j < volume.size_voxels.y; ++j)
      for (int i = 0; i < volume.size_voxels.x; ++i, ++at) {
        const int which = of_class[static_cast<std::size_t>(scene.classes[at])];
        if (which < 0) continue;
        const bool left = kLoose[static_cast<std::size_t>(which)] == TissueClass::kidney &&
                          (volume.lps_from_voxel * glm::dvec4(i, j, k, 1.0)).x > middle_mm;
        Sum& sum = sums[static_cast<std::size_t>(which)][left ? 1 : 0];
        sum.ijk[0] += i;
        sum.ijk[1] += j;
        sum.ijk[2] += k;
        ++sum.voxels;
      }
  const double voxel_mm3 = std::abs(glm::determinant(glm::dmat3(volume.lps_from_voxel)));
  std::vector<LooseOrgan> organs;
  for (std::size_t which = 0; which < kLoose.size(); ++which)
    for (const Sum& sum : sums[which]) {
      const auto voxels = static_cast<double>(sum.voxels);
      const double mm3 = voxels * voxel_mm3;
      if (mm3 < 1000.0 * kLeastMl) continue;
      const glm::dvec4 middle(static_cast<double>(sum.ijk[0]) / voxels, static_cast<double>(sum.ijk[1]) / voxels,
                              static_cast<double>(sum.ijk[2]) / voxels, 1.0);
      organs.push_back(
          {kLoose[which], glm::dvec3(volume.lps_from_voxel * middle), std::cbrt(0.75 * mm3 / std::numbers::pi)});
    }
  return organs;
}

std::optional<PushedOrgan> pushed(std::span<const LooseOrgan> organs, const NeedleDrag& needle) noexcept {
  const glm::dvec3 at_lps_mm = needle.entry_lps_mm + needle.cut_mm * needle.direction;
  const auto off_mm2 = [&](const LooseOrgan& organ) {
    const glm::dvec3 off_mm = at_lps_mm - organ.middle_lps_mm;
    return glm::dot(off_mm, off_mm);
  };
  const LooseOrgan* nearest = nullptr;
  for (const LooseOrgan& organ : organs)
    if (organ.tissue == needle.organ && (nearest == nullptr || off_mm2(organ) < off_mm2(*nearest)))
      nearest = &organ;
  if (nearest == nullptr || !(needle.organ_n > 0.0)) return std::nullopt;
  return PushedOrgan{nearest->middle_lps_mm, nearest->radius_mm, at_lps_mm, needle.organ_n * needle.direction};
}

}  // namespace seldinger::tissue
