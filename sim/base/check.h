// CHECK: a programmer's mistake ends the program, also in release. Bad outside data is a Result, not a CHECK.
#pragma once

namespace seldinger::base {
[[noreturn]] void check_failed(const char* expression, const char* file, int line) noexcept;
}

#define CHECK(expression)                                                                \
  do {                                                                                   \
    if (!(expression)) ::seldinger::base::check_failed(#expression, __FILE__, __LINE__); \
  } while (false)
