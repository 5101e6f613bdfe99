// Numbers in what import says.
#pragma once

#include <array>
#include <cstdio>
#include <numbers>
#include <string>

namespace seldinger::casedb {

inline std::string number_text(double value) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.4g", value);
  return text.data();
}

constexpr double degrees_of(double radians) noexcept {
  return radians * (180.0 / std::numbers::pi);
}

// "1 file", "3 files".
inline std::string count_text(std::size_t count, const char* one) {
  return std::to_string(count) + ' ' + one + (count == 1 ? "" : "s");
}

}  // namespace seldinger::casedb
