// Where something is in the patient: a sphere, an ellipsoid, a tube along a polyline (vessels and ducts that CT
// does not show), or a set of voxels of the case's grid (a tissue class, a label). Two questions are asked of any
// of them: how far, and which part of a straight way is inside.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <variant>
#include <vector>

#include "sim/volume/volume.h"

namespace seldinger::cases {

struct Sphere {
  glm::dvec3 center_lps_mm{0.0};
  double radius_mm = 0.0;
};

struct Ellipsoid {  // its axes are those of LPS
  glm::dvec3 center_lps_mm{0.0};
  glm::dvec3 radii_mm{0.0};
};

struct Tube {  // round at its joints and ends; at least one point
  std::vector<glm::dvec3> points_lps_mm;
  double radius_mm = 0.0;
};

// Voxels of a grid with perpendicular axes, kept within their bounding box. A point belongs to its nearest voxel.
struct VoxelSet {
  glm::ivec3 low{0}, size{0};  // the box, in voxels of the grid
  glm::dvec3 spacing_mm{1.0};
  glm::dmat4 voxel_from_lps{1.0};
  std::vector<std::uint8_t> member;  // size.x · size.y · size.z, 0 or 1, i fastest
};

using Shape = std::variant<Sphere, Ellipsoid, Tube, VoxelSet>;

// The voxels of `volume` whose entry in `values` (one per voxel, CHECK) is `value`. Empty box when there is none.
VoxelSet voxels_with(const volume::Volume& volume, std::span<const std::uint8_t> values, std::uint8_t value);

// Distance to the surface in mm, negative inside, to 1e-6 mm. Beyond ±limit_mm it is ±limit_mm. Inside a tube it is
// at least as far from the surface as told. An empty shape is limit_mm away.
double signed_distance_mm(const Shape& shape, const glm::dvec3& point_lps_mm, double limit_mm);

// A part of the way from a to b, as shares of it: 0 at a, 1 at b.
struct Stretch {
  double from = 0.0, to = 0.0;
};
// The parts inside, in order and apart from each other. A way of no length is either inside (0 to 1) or not.
std::vector<Stretch> stretches_inside(const Shape& shape, const glm::dvec3& a_lps_mm, const glm::dvec3& b_lps_mm);

// Axis-aligned box in LPS around the shape, mm; nothing (low > high) when empty.
struct Bounds {
  glm::dvec3 low_lps_mm{1.0}, high_lps_mm{-1.0};
};
Bounds bounds_of(const Shape& shape);

}  // namespace seldinger::cases
