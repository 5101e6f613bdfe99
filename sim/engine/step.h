// One tick of everything.
#pragma once

#include <cstdint>

#include "sim/base/tick.h"
#include "sim/case/case.h"
#include "sim/case/inputs.h"
#include "sim/case/state.h"
#include "sim/tissue/displacement.h"

namespace seldinger::engine {

// Raised whenever the same Inputs may give another State: recordings of another version are shown, not verified.
constexpr std::uint32_t kStepVersion = 2;

// Advances one tick. Pure: the same arguments give the same State on every machine, in Debug and in -O2. No clock,
// file, allocation, lock or global; only + − × ÷ √ and sim/base/exact_math.
// Tools move as the hands do. Where the tip is relative to the skin is told in the patient at rest, from whose
// place tissue is displaced as `displacement` says. A case of another modality than xray does not touch the
// fluoroscope.
void step(const cases::Case& scene, const cases::Inputs& inputs, double dt_s,
          const tissue::Displacement& displacement, cases::State& state) noexcept;
// Of tissue that is where it is at rest.
void step(const cases::Case& scene, const cases::Inputs& inputs, double dt_s, cases::State& state) noexcept;

}  // namespace seldinger::engine
