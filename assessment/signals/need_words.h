// What a metric or a step needs, in words.
#pragma once

#include <cstdint>
#include <string>

#include "assessment/signals/needs.h"

namespace seldinger::assessment {

// "ultrasound, skin": of Needs, or-ed, in their order; empty for none.
std::string words_of_needs(Needs needs);

}  // namespace seldinger::assessment
