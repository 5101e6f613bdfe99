// What a metric or a step needs, in words.
#pragma once

#include <cstdint>
#include <string>

namespace seldinger::assessment {

// "ultrasound, skin": of Needs, or-ed, in their order; empty for none.
std::string words_of_needs(std::uint32_t needs);

}  // namespace seldinger::assessment
