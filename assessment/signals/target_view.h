// Whether any picture of a case could show its target.
#pragma once

#include "sim/case/case.h"

namespace seldinger::assessment {

struct Signals;

// Under a fluoroscope a target of soft tissue differs too little from what lies about it, wherever the machine
// stands. Told by the least absorption that pictures show (below); a rough answer, so that what an attempt's
// pictures did show counts before it. Slices show any target, ultrasound is turned to any depth that a needle
// reaches: false.
bool target_cannot_show(const cases::Case& scene);

// The answer for an attempt: no picture could, and none did.
bool no_view_shows_target(const Signals& signals);

}  // namespace seldinger::assessment
