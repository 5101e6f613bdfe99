// A line of text as printf makes it, of at most 255 bytes.
#pragma once

#include <cstdio>
#include <string>

namespace seldinger::app {

template <class... Values>
std::string formatted(const char* format, Values... values) {
  char line[256];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

}  // namespace seldinger::app
