// Guidance by a slice of the CT below the probe.
#pragma once

#include "session/guidance/guidance.h"

namespace seldinger::session {

extern const GuidanceKind kSliceGuidance;

}  // namespace seldinger::session
