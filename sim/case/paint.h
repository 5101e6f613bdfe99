// Puts what a mentor drew into a volume: each voxel takes the share of it that lies inside, as CT averages over a
// voxel.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "sim/case/form/shape.h"
#include "sim/volume/classes.h"
#include "sim/volume/volume.h"

namespace seldinger::cases {

struct Brush {
  double hu = 0.0;
  bool adds = false;     // hu is added to what is there
  double edge_mm = 0.0;  // a linear ramp across the surface, half of it inside
};

// Mean over the voxels whose centre is inside; both 0 when there is none.
struct Painted {
  std::size_t voxels = 0;
  double hu = 0.0, before_hu = 0.0;
};
Painted paint(const Shape& shape, const Brush& brush, volume::Volume& volume);

// The voxels whose centre is inside become `tissue`. One class per voxel (CHECK).
void paint_class(const Shape& shape, volume::TissueClass tissue, const volume::Volume& volume,
                 std::span<volume::TissueClass> classes);

// tell(voxel, depth) of the voxels whose centre is inside: how deep below the surface, at most `deepest_mm`.
void over_voxels_in(const Shape& shape, const volume::Volume& volume, double deepest_mm,
                    const std::function<void(std::size_t voxel, double depth_mm)>& tell);

}  // namespace seldinger::cases
