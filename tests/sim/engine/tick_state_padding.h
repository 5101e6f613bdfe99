// Which bytes of a TickState belong to no field: told by the compiler, so that a test need not list the fields.
#pragma once

#include <vector>

namespace seldinger::engine {

// One entry a byte. Empty: this compiler cannot tell.
std::vector<bool> padding_of_tick_state();

}  // namespace seldinger::engine
