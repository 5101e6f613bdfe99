// A CT on a coarse grid along the patient's axes, where organs are looked for. Inside sim/volume/organs only.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/volume/classes.h"

namespace seldinger::volume {

constexpr double kOrganGridMm = 3.0;

struct OrganGrid {
  Volume volume;                   // averages
  std::vector<std::uint8_t> soft;  // 1: none of air, gas, lung, fat, bone and metal
  std::vector<std::uint8_t> bone;
  std::vector<std::uint8_t> lung;
  std::vector<std::uint8_t> body;
  std::vector<float> level_hu;  // of soft voxels: the mean of those neighbours that are alike, edges kept
  double noise_sd_hu = 0.0;     // of volume
};
OrganGrid organ_grid(const Volume& volume, const std::vector<TissueClass>& classes);

}  // namespace seldinger::volume
