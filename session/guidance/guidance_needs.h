// What guidance by a modality needs of a stored case.
#pragma once

#include "sim/case/case.h"

namespace seldinger::session {

// What is built depends on what looks at it or feels it: classes cost a file and a byte a voxel.
// Touch asks the class of a voxel, ultrasound also how bright it is; scoring does without both.
enum class Needs { metrics, touch, ultrasound };

// What an attempt by this modality needs.
Needs needs_of(cases::Modality modality) noexcept;

}  // namespace seldinger::session
