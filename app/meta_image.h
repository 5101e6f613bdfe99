// A picture as MetaImage: float32 in the picture's unit, with its place in the patient.
#pragma once

#include <string>
#include <vector>

#include "sim/imaging/mpr/mpr.h"

namespace seldinger::app {

// One slice, x fastest = along u. The text header is MetaIO's; the third direction is u × v.
std::string meta_image(const imaging::HuImage& picture, const imaging::MprView& view);

}  // namespace seldinger::app
