// One layer of a volume from the slices around it.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>

namespace seldinger::casedb {

// A decoded slice, and where its first pixel lies within the layer.
struct PlacedSlice {
  std::span<const std::int16_t> hu;
  glm::dvec2 shift_px{0.0};
};

// HU of a layer `weight` (0 to 1) of the way from `below` to `above`: bilinear within each slice, linear between
// them. Where only one of the two reaches, it alone counts; where none does there is air (−1024).
void blend_layer(const PlacedSlice& below, const PlacedSlice& above, double weight, glm::ivec2 slice_px,
                 glm::ivec2 layer_px, std::span<std::int16_t> layer);

}  // namespace seldinger::casedb
