// Guidance by a fluoroscope.
#pragma once

#include "session/guidance/guidance.h"

namespace seldinger::session {

extern const GuidanceKind kFluoroscopyGuidance;

}  // namespace seldinger::session
