// Guidance by a fluoroscope.
#pragma once

#include "app/guidance.h"

namespace seldinger::app {

extern const GuidanceKind kFluoroscopyGuidance;

}  // namespace seldinger::app
