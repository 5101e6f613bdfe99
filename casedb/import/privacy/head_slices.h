// A volume looked at in axial slices of the patient, whatever its own axes are: where brain lies in a ring of bone,
// how much lies in front of it, and where jaws are. What find_face() goes by.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "sim/volume/volume.h"

namespace seldinger::casedb {

constexpr std::size_t kFronts = 15;         // directions a face may look to
glm::dvec3 front_direction(std::size_t i);  // from 70° right of anterior by 10°, unit vectors in LPS

struct HeadSlice {
  bool brain = false;                      // soft tissue within a ring of bone, of a head's size
  std::array<double, kFronts> block_mm{};  // from the brain's foremost point to the skin, along each direction
  bool jaw = false;                        // a section of a head's width with bone on both sides of its front
};

struct HeadSlices {
  double spacing_mm = 3.0;
  glm::dvec3 origin_lps_mm{0.0};  // centre of the first cell
  glm::ivec3 size{0};
  std::vector<std::uint8_t> body;  // one byte a cell of spacing_mm
  std::vector<HeadSlice> slices;   // upwards

  double z_of(int slice) const noexcept { return origin_lps_mm.z + slice * spacing_mm; }
  // How far the body reaches along a direction between two heights.
  double foremost_mm(const glm::dvec3& front, double from_z_mm, double to_z_mm) const;
};

HeadSlices head_slices(const volume::Volume& volume);

}  // namespace seldinger::casedb
