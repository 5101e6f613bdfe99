// Phases of the carrier by table: the same bits on every machine.
#pragma once

#include <array>
#include <cstddef>

namespace seldinger::imaging {

// e^(−2πi·n/kPhases), real and imaginary part.
constexpr std::size_t kPhases = 1024;
const std::array<std::array<float, 2>, kPhases>& phases();

}  // namespace seldinger::imaging
