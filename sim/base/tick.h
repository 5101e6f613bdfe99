// The tick of everything that runs at 1 kHz: engine, haptics, hands and devices.
#pragma once

namespace seldinger::base {

inline constexpr double kTickS = 0.001;

}  // namespace seldinger::base
