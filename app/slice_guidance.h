// Guidance by a slice of the CT below the probe.
#pragma once

#include "app/guidance.h"

namespace seldinger::app {

extern const GuidanceKind kSliceGuidance;

}  // namespace seldinger::app
