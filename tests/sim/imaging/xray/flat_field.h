// A patient of even thickness.
#pragma once

#include <vector>

#include "sim/imaging/xray/projection/projection.h"

namespace seldinger::imaging {

// A square field of size_px.
inline PathLengths flat(int size_px, double water_mm, double mineral_mm = 0.0) {
  const auto pixels = static_cast<std::size_t>(size_px * size_px);
  return {size_px,
          size_px,
          std::vector<float>(pixels, static_cast<float>(water_mm)),
          std::vector<float>(pixels, static_cast<float>(mineral_mm)),
          {}};
}

}  // namespace seldinger::imaging
