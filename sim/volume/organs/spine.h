// The middle of the back and the bodies of vertebrae, from which organs' places are told. Inside sim/volume/organs
// only.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "sim/volume/organs/lattice.h"

namespace seldinger::volume {

// In grid mm, by slice: the mean of the bone in the middle of the back half of the body, and of slices around.
// Where so much of a side is cut off that the middle of what is seen is not the patient's, it is where the spine
// is; empty where that is not proven, or no slice has bone there: then nothing is told whose name hangs on it.
std::vector<glm::dvec2> middle_of_back(const OrganGrid& grid);

// Vertebral bodies of one slice and of those around: blocks of bone that are thick from
// side to side and from front to back.
struct VertebralBody {
  glm::dvec2 centre_mm{0.0};
  double half_width_mm = 0.0, half_depth_mm = 0.0;
};
struct Spine {
  std::vector<std::optional<VertebralBody>> bodies;  // by slice; one run of slices
  double seen_share = 0.0;                           // of the run, slices with such a block
};
Spine find_spine(const OrganGrid& grid, const std::vector<glm::dvec2>& middle_mm);

}  // namespace seldinger::volume
