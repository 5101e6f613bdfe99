// Where, of what a CT without labels was told to hold, a training lesion may lie.
#pragma once

#include <optional>
#include <vector>

#include "sim/volume/organs/find_organs.h"

namespace seldinger::assessment {

class OrganPlaces {
 public:
  explicit OrganPlaces(const volume::Organs& organs);  // kept by reference

  // Of a ball: 0 within one solid organ, 1 elsewhere. Nothing beside both lungs, where armpit, shoulder and arm
  // are; where a slice holds none, beside those of the nearest that does.
  std::optional<int> rank(const glm::dvec3& center_lps_mm, double radius_mm) const;

 private:
  struct Span {  // of both lungs in a slice of the grid, in voxels
    int right = 0, left = 0;
  };
  const volume::Organs& organs_;
  glm::dmat4 grid_from_lps_;
  std::vector<std::optional<Span>> lungs_;
};

}  // namespace seldinger::assessment
