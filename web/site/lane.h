// Which threads answer a request.
#pragma once

#include <cstddef>

namespace seldinger::web {

enum class Lane {
  pages,
  log_in,   // a password's hash takes 64 MiB and 60 ms by design: two at once
  heavy,    // what takes a whole case into memory: one at a time
  changes,  // what may wait for another program that writes: one at a time
};
inline constexpr std::size_t kLanes = 4;

}  // namespace seldinger::web
