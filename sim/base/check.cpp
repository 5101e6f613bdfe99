#include "sim/base/check.h"

#include <cstdio>
#include <cstdlib>

namespace seldinger::base {

void check_failed(const char* expression, const char* file, int line) noexcept {
  std::fprintf(stderr, "CHECK failed: %s (%s:%d)\n", expression, file, line);
  std::abort();
}

}  // namespace seldinger::base
