#include "sim/haptics/probe/bone_depth.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/base/check.h"

namespace seldinger::haptics {
namespace {

constexpr int kHalvings = 8;

}  // namespace

BoneDepth::BoneDepth(const volume::Volume& volume, std::span<const volume::TissueClass> classes)
    : volume_(&volume), classes_(classes), voxel_from_lps_(volume::voxel_from_lps(volume)) {
  CHECK(classes.size() == volume.hu.size());
  step_mm_ = std::min({volume.spacing_mm.x, volume.spacing_mm.y, volume.spacing_mm.z});
}

double BoneDepth::hardness(const glm::dvec3& p_lps_mm) const noexcept {
  const glm::dvec3 index(voxel_from_lps_ * glm::dvec4(p_lps_mm, 1.0));
  if (!volume::inside(*volume_, index)) return 0.0;
  const glm::ivec3 low(static_cast<int>(std::floor(index.x)), static_cast<int>(std::floor(index.y)),
                       static_cast<int>(std::floor(index.z)));
  const glm::dvec3 part = index - glm::dvec3(low);
  const glm::ivec3 last = volume_->size_voxels - 1;
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::ivec3 up(corner & 1, (corner >> 1) & 1, corner >> 2);
    const volume::TissueClass tissue =
        classes_[volume_->index(std::clamp(low.x + up.x, 0, last.x), std::clamp(low.y + up.y, 0, last.y),
                                std::clamp(low.z + up.z, 0, last.z))];
    if (tissue != volume::TissueClass::bone && tissue != volume::TissueClass::metal) continue;
    sum += (up.x == 1 ? part.x : 1.0 - part.x) * (up.y == 1 ? part.y : 1.0 - part.y) *
           (up.z == 1 ? part.z : 1.0 - part.z);
  }
  return sum;
}

double BoneDepth::along(const glm::dvec3& from_lps_mm, const glm::dvec3& inward, double most_mm) const noexcept {
  double before_mm = 0.0;
  for (double depth_mm = 0.0; depth_mm <= most_mm; depth_mm += step_mm_) {
    if (hardness(from_lps_mm + depth_mm * inward) >= 0.5) {
      double low = before_mm, high = depth_mm;
      for (int i = 0; i < kHalvings; ++i) {
        const double middle = 0.5 * (low + high);
        (hardness(from_lps_mm + middle * inward) >= 0.5 ? high : low) = middle;
      }
      return high;
    }
    before_mm = depth_mm;
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace seldinger::haptics
