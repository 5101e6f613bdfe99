#include "sim/imaging/ultrasound/speckle/phase.h"

#include <numbers>

#include "sim/base/exact_math.h"

namespace seldinger::imaging {

const std::array<std::array<float, 2>, kPhases>& phases() {
  static const auto kTable = [] {
    std::array<std::array<float, 2>, kPhases> table;
    for (std::size_t i = 0; i < kPhases; ++i) {
      const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / kPhases;
      table[i] = {static_cast<float>(base::exact_cos(angle)), static_cast<float>(-base::exact_sin(angle))};
    }
    return table;
  }();
  return kTable;
}

}  // namespace seldinger::imaging
