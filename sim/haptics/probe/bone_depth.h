// How deep bone lies under a place of the skin: one ray through the tissue classes.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "sim/volume/classes.h"
#include "sim/volume/volume.h"

namespace seldinger::haptics {

class BoneDepth {
 public:
  // One class per voxel (CHECKed). Both must outlive this.
  BoneDepth(const volume::Volume& volume, std::span<const volume::TissueClass> classes);

  // mm from `from_lps_mm` along the unit vector `inward` to the first bone or metal, looked for as far as
  // `most_mm`; infinity when there is none. Between voxels it moves smoothly: bone begins where half of what is
  // around is bone.
  double along(const glm::dvec3& from_lps_mm, const glm::dvec3& inward, double most_mm) const noexcept;

 private:
  double hardness(const glm::dvec3& p_lps_mm) const noexcept;  // 0 soft to 1 bone, trilinear

  const volume::Volume* volume_;
  std::span<const volume::TissueClass> classes_;
  glm::dmat4 voxel_from_lps_;
  double step_mm_;
};

}  // namespace seldinger::haptics
