// CTs whose field of view ends within the patient: boxes, the circle of a reconstruction, an oblique plane behind
// which nothing is left, and coarser grids of them.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "sim/volume/volume.h"

namespace seldinger::volume {

// Shares of the body's box, along the volume's axes: 0.3 at a face takes the nearest 30 % of the body away. A
// negative share, or 0, leaves that face where it was.
struct Crop {
  std::string name;
  std::array<double, 6> faces{};       // −x, +x, −y, +y, −z, +z
  std::optional<double> circle{};      // radius in halves of the body's longer side, about the middle of its box
  std::optional<glm::dvec3> beyond{};  // what lies this way from the middle of the box becomes padding, …
  double beyond_from = 0.0;            // … from this share of the body's half size on
};

// Crops through lung, bowel and bone, of one to five faces; circles; oblique planes.
std::vector<Crop> crops();
// Those of them with these names (CHECK).
std::vector<Crop> crops(const std::vector<std::string>& names);

// `whole` with `body` as its mask. What is cut off leaves the volume; padding is kAirHu.
Volume cropped(const Volume& whole, const std::vector<std::uint8_t>& body, const Crop& crop,
               std::int16_t fill = kAirHu);

// By averaging whole voxels to about spacing_mm along each axis; finer ones stay.
Volume coarser(const Volume& volume, double spacing_mm);

}  // namespace seldinger::volume
