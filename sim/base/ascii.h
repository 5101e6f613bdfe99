// Letters of ASCII, whatever the locale: bytes beyond it stay as they are.
#pragma once

#include <string>
#include <string_view>

namespace seldinger::base {

constexpr bool is_capital(char c) noexcept {
  return c >= 'A' && c <= 'Z';
}

constexpr char lower(char c) noexcept {
  return is_capital(c) ? static_cast<char>(c - 'A' + 'a') : c;
}

inline std::string lower(std::string_view text) {
  std::string small(text);
  for (char& c : small) c = lower(c);
  return small;
}

}  // namespace seldinger::base
