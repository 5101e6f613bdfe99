// How far the tissue about a plane moves, forwards, on a grid: what lays a picture's scatterers, which ask from
// where they rest to where they are, and, turned round, what finds the place at rest of a picture's samples.
//
// The grid stands on columns along that axis of LPS which the plane's normal is most along; nodes of a column are
// told by their height above the plane. So all of a row of cubes of the scatterers' lattice lies in one column.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "sim/tissue/displacement.h"

namespace seldinger::tissue {

// A plane and, of tissue at rest, what is asked for: x and y are coordinates along the two axes of LPS after the
// columns' (in turn), z is the height above the plane.
struct SlabPart {
  glm::dvec3 origin_lps_mm{0.0}, normal{0.0, 0.0, 1.0};  // unit
  glm::dvec3 low_mm{0.0}, high_mm{0.0};
  double spacing_mm = 3.0, layer_mm = 3.0;  // > 0 (CHECKed): between columns, and between nodes of one
};

class MovedSlab {
 public:
  MovedSlab(const Displacement& displacement, const SlabPart& part);

  static int column_axis(const glm::dvec3& normal) noexcept;
  int column_axis() const noexcept { return axis_; }
  glm::dvec3 slab_of(const glm::dvec3& rest_lps_mm) const noexcept;  // x, y and height, as SlabPart has them

  // u at a place at rest, between nodes in straight lines; beyond the grid as on its border.
  glm::dvec3 moved_mm(const glm::dvec3& rest_lps_mm) const noexcept;
  // ∂x/∂X there, by columns.
  glm::dmat3 stretch(const glm::dvec3& rest_lps_mm) const noexcept;

  // X of the tissue that the grid puts at x, by Newton's steps from a guess.
  static constexpr int kSteps = 3;
  glm::dvec3 rest_of(const glm::dvec3& at_lps_mm, const glm::dvec3& guess_lps_mm,
                     int steps = kSteps) const noexcept;

  // Between which u lies in a box of slab_of's coordinates, along three unit axes.
  struct Range {
    glm::dvec3 low_mm, high_mm;
  };
  Range range(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec3 (&axes)[3]) const noexcept;

  // Whether nothing moves in a box of slab_of's coordinates.
  bool is_still(const glm::dvec3& low, const glm::dvec3& high) const noexcept;

  // The column before a place each way, and the parts of the way from there to the next ones.
  struct Between {
    int i, j;
    float right, down;
  };
  Between between(double x_mm, double y_mm) const noexcept;
  const glm::vec4* column(int i, int j) const noexcept { return nodes_.data() + index(i, j); }

  // u, xyz, at the nodes: size().z layers of a column, columns along x, rows of them along y.
  std::span<const glm::vec4> nodes() const noexcept { return nodes_; }
  glm::ivec3 size() const noexcept { return size_; }
  const SlabPart& part() const noexcept { return part_; }

 private:
  struct Cell {
    glm::ivec3 at;
    glm::dvec3 part;  // of the way to the next nodes, [0, 1]
  };
  Cell cell_of(const glm::dvec3& slab_mm) const noexcept;
  std::size_t index(int i, int j) const noexcept {
    return (static_cast<std::size_t>(j) * static_cast<std::size_t>(size_.x) + static_cast<std::size_t>(i)) *
           static_cast<std::size_t>(size_.z);
  }
  glm::dvec3 node(const Cell& cell, int right, int down, int up) const noexcept;
  void sample(const glm::dvec3& rest_lps_mm, glm::dvec3& moved_mm, glm::dmat3& stretch) const noexcept;

  SlabPart part_;
  int axis_;
  glm::dvec3 per_step_;  // nodes a mm
  glm::ivec3 size_;      // nodes, at least two each way
  std::vector<glm::vec4> nodes_;
};

}  // namespace seldinger::tissue
