// What both ways to a picture ask of a view.
#pragma once

#include <span>

#include "sim/imaging/ultrasound/view/ultrasound.h"

namespace seldinger::imaging {

// CHECKs what ultrasound.h demands.
void check_view(const UltrasoundView& view, std::span<const float> depth_below_skin_mm);

// The view's own frequency, or else the probe's.
double working_mhz(const UltrasoundView& view) noexcept;

}  // namespace seldinger::imaging
