// A surface of equal HU in a volume, as touch needs it: smooth.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "sim/volume/volume.h"

namespace seldinger::haptics {

class IsoSurface {
 public:
  // Solid is what has at least iso_hu. The volume must outlive this.
  IsoSurface(const volume::Volume& volume, double iso_hu);

  struct Value {
    double hu = 0.0;  // above the surface's: ≥ 0 is solid
    glm::dvec3 rise_hu_mm{0.0};
  };
  // By the uniform cubic B-spline of voxels that are smoothed a little (6×6×6 of them). Not trilinear: its kinks
  // where voxels meet, and CT noise of 30 HU in them, are felt as steps. A sheet one voxel thick keeps 0.47 of its
  // contrast, a straight edge stays where it is. Outside the volume is air.
  Value at(const glm::dvec3& p_lps_mm) const noexcept;

  double step_mm() const noexcept { return step_mm_; }  // a quarter of the smallest spacing

 private:
  const volume::Volume* volume_;
  double iso_hu_, step_mm_;
  glm::dmat4 voxel_from_lps_;
  glm::dmat3 lps_rise_;  // rise in LPS from a rise per voxel
};

}  // namespace seldinger::haptics
