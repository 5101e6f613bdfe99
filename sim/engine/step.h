// One tick of everything.
#pragma once

#include <cstdint>

#include "sim/case/case.h"
#include "sim/case/inputs.h"
#include "sim/case/state.h"

namespace seldinger::engine {

// Raised whenever the same Inputs may give another State: recordings of another version are shown, not verified.
constexpr std::uint32_t kStepVersion = 2;
constexpr double kTickSeconds = 0.001;

// Advances one tick. Pure: the same arguments give the same State on every machine, in Debug and in -O2. No clock,
// file, allocation, lock or global; only + − × ÷ √ and sim/base/exact_math.
// Tools move as the hands do: this version has no forces and no tissue motion. A case of another modality than xray
// does not touch the fluoroscope.
void step(const cases::Case& scene, const cases::Inputs& inputs, double dt_s, cases::State& state) noexcept;

}  // namespace seldinger::engine
