// What attempts of people are stored under, where those of simulated operators have a profile's name.
#pragma once

#include <string_view>

namespace seldinger::assessment {

inline constexpr std::string_view kPersonOperator = "person";

}  // namespace seldinger::assessment
