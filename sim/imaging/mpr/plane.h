// The view's plane in numbers that step from pixel to pixel: what mpr_cpu and mpr_gpu share. (mpr_reference does
// not use it: it is their oracle.)
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "sim/base/check.h"
#include "sim/imaging/mpr/mpr.h"
#include "sim/tissue/rest_plane.h"

namespace seldinger::imaging {

// Views come from the caller in order (app refuses others). A centre that is not finite is not the caller's mistake
// but a lost device: such a picture is all outside.
inline void check_view(const MprView& view, const Inserted& inserted) {
  constexpr double kSlack = 1e-6;  // orthonormal to far below a pixel over any picture
  CHECK(view.width_px > 0 && view.height_px > 0);
  CHECK(view.pixel_mm > 0.0 && view.needle_slab_mm >= 0.0);
  CHECK(std::abs(glm::dot(view.u, view.u) - 1.0) <= kSlack && std::abs(glm::dot(view.v, view.v) - 1.0) <= kSlack);
  CHECK(std::abs(glm::dot(view.u, view.v)) <= kSlack);
  CHECK(inserted.lesions.size() <= static_cast<std::size_t>(kMaxLesions));
}

struct Plane {
  glm::dvec3 index_first, index_per_column, index_per_row;                    // continuous voxel index
  glm::dvec3 position_first_mm, position_per_column_mm, position_per_row_mm;  // from the view's centre
  glm::dvec3 normal;                                                          // u × v, unit
};

inline Plane plane_from_view(const glm::dmat4& voxel_from_lps, const MprView& view) {
  Plane plane;
  plane.position_per_column_mm = view.u * view.pixel_mm;
  plane.position_per_row_mm = view.v * view.pixel_mm;
  plane.position_first_mm = plane.position_per_column_mm * (-0.5 * (view.width_px - 1)) +
                            plane.position_per_row_mm * (-0.5 * (view.height_px - 1));
  plane.normal = glm::cross(view.u, view.v);
  const glm::dmat3 turn(voxel_from_lps);
  plane.index_per_column = turn * plane.position_per_column_mm;
  plane.index_per_row = turn * plane.position_per_row_mm;
  plane.index_first = glm::dvec3(voxel_from_lps * glm::dvec4(view.center_lps_mm + plane.position_first_mm, 1.0));
  return plane;
}

// Where the tissue of the view's pixels was: from the middle of pixel (0,0), along rows and columns.
inline tissue::RestPlane rest_plane_of(const MprView& view, const tissue::Displacement& displacement) {
  const glm::dvec2 size_mm = view.pixel_mm * glm::dvec2(view.width_px - 1, view.height_px - 1);
  return {displacement,
          {view.center_lps_mm - 0.5 * size_mm.x * view.u - 0.5 * size_mm.y * view.v, view.u, view.v, size_mm}};
}

}  // namespace seldinger::imaging
