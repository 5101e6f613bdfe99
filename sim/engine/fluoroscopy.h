// One tick of the fluoroscope: the part of step() that a case of this modality needs.
#pragma once

#include "sim/case/case.h"
#include "sim/case/inputs.h"
#include "sim/case/state.h"

namespace seldinger::engine {

// Moves arm, table and detector within the machine's limits, takes in the report of the last frame, and fires the
// pulse that is due. What is not finite asks nothing; what is beyond the machine is clamped to it; a report of a
// frame that was not fired, or that was reported before, is left out.
void advance_fluoroscope(const cases::Case& scene, const cases::Inputs& inputs, double dt_s,
                         cases::FluoroscopyState& state) noexcept;

}  // namespace seldinger::engine
