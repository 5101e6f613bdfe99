// Whether any picture of a case could show its target.
#pragma once

#include "sim/case/case.h"

namespace seldinger::assessment {

struct Signals;

// Under a fluoroscope a target of soft tissue differs too little from what lies about it, wherever the machine
// stands. Told by the least absorption that pictures show (below); a rough answer, so that what an attempt's
// pictures did show counts before it. Else false: a slice shows any target that lies in it; ultrasound is turned to
// any depth that a needle reaches, and whether its target stands out is asked picture by picture (imaging::
// target_level): one that echoes as what lies about it, or that bone or gas hides from everywhere, was not seen.
bool target_cannot_show(const cases::Case& scene);

// The answer for an attempt: no picture could, and none did.
bool no_view_shows_target(const Signals& signals);

}  // namespace seldinger::assessment
