// Guidance by ultrasound.
#pragma once

#include "app/guidance.h"

namespace seldinger::app {

extern const GuidanceKind kUltrasoundGuidance;

}  // namespace seldinger::app
