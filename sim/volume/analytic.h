// Volumes and labels from analytic shapes: "analytic" scenes (docs/scenes/README.md) and the built-in phantom.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <variant>
#include <vector>

#include "sim/volume/volume.h"

namespace seldinger::volume {

struct Box {
  glm::dvec3 min_mm, max_mm;
};
struct Sphere {
  glm::dvec3 center_mm;
  double radius_mm;
};
struct Cylinder {  // finite, flat ends
  glm::dvec3 from_mm, to_mm;
  double radius_mm;
};
struct Ellipsoid {  // axis-aligned in LPS
  glm::dvec3 center_mm, radii_mm;
};
using Geometry = std::variant<Box, Sphere, Cylinder, Ellipsoid>;

struct Shape {
  Geometry geometry;
  double hu = 0.0;
  std::string class_name{};         // tissue name; empty: HU decides
  std::vector<std::string> over{};  // paints only where one of these classes lies so far; empty: everywhere
};

struct AnalyticVolume {
  glm::ivec3 size_voxels{0};
  glm::dvec3 spacing_mm{1.0};
  glm::dvec3 origin_mm{0.0};  // centre of voxel (0,0,0); axes along LPS
  double background_hu = -1000.0;
  std::vector<Shape> shapes;
};

// Inside or on the shape.
bool contains(const Geometry& geometry, const glm::dvec3& p_lps_mm) noexcept;

// A voxel belongs to a shape when its centre is inside or on it; later shapes overwrite. HU is rounded to int16.
Volume rasterize(const AnalyticVolume& analytic);
// As rasterize, and the class of each voxel.
Volume rasterize(const AnalyticVolume& analytic, LabelMap& labels);

}  // namespace seldinger::volume
