// Guidance by ultrasound.
#pragma once

#include "session/guidance/guidance.h"

namespace seldinger::session {

extern const GuidanceKind kUltrasoundGuidance;

}  // namespace seldinger::session
