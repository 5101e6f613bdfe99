// The columns of a moved slab about a tile, turned once into its frame: what lies between them along a row of the
// lattice is asked for tens of thousands of times a picture.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "sim/tissue/moved_slab.h"

namespace seldinger::imaging {

class TurnedColumns {
 public:
  // About a box of the slab's x and y; `layers` from `first_layer` on, u along three unit axes.
  void turn(const tissue::MovedSlab& slab, const glm::vec3 (&axes)[3], const glm::dvec2& low_mm,
            const glm::dvec2& high_mm, int first_layer, int layers);
  // The line of columns at x, within the box.
  void go_to(double x_mm) noexcept;
  // The column at y of that line: u's xyz along the axes, a layer each, the fourth number nobody's.
  void lay(double y_mm, float (*mm)[4]) const noexcept;

 private:
  struct Node {
    float xyz[4];
  };
  // `into` becomes as many layers, so far of the way from one column to another.
  void mix(const Node* one, const Node* other, float part, float (*into)[4]) const noexcept;

  const tissue::MovedSlab* slab_ = nullptr;
  int left_ = 0, upper_ = 0, across_ = 0, down_ = 0, layers_ = 0;  // the first column's numbers; how many
  std::vector<Node> turned_, line_;                                // [x][y][layer], [y][layer]
};

}  // namespace seldinger::imaging
