#include "casedb/login_name.h"

#include <optional>

namespace seldinger::casedb {
namespace {

// Takes one character off the front; nothing when the bytes are not UTF-8 (RFC 3629: shortest form, no surrogates).
std::optional<char32_t> next_character(std::string_view& text) noexcept {
  const auto lead = static_cast<unsigned char>(text.front());
  const std::size_t length = lead < 0x80   ? 1
                             : lead < 0xc2 ? 0
                             : lead < 0xe0 ? 2
                             : lead < 0xf0 ? 3
                             : lead < 0xf5 ? 4
                                           : 0;
  if (length == 0 || length > text.size()) return std::nullopt;
  char32_t character = length == 1 ? lead : lead & (0x7fU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if ((byte & 0xc0) != 0x80) return std::nullopt;
    character = character << 6 | (byte & 0x3f);
  }
  const bool too_long = (length == 3 && character < 0x800) || (length == 4 && character < 0x10000);
  if (too_long || character > 0x10ffff || (character >= 0xd800 && character <= 0xdfff)) return std::nullopt;
  text.remove_prefix(length);
  return character;
}

bool printable(char32_t c) noexcept {
  struct Range {
    char32_t first, last;
  };
  constexpr Range kRefused[] = {
      {0x00, 0x1f},     {0x7f, 0xa0},     {0xad, 0xad},     {0x61c, 0x61c},      {0x1680, 0x1680}, {0x180e, 0x180e},
      {0x2000, 0x200f}, {0x2028, 0x202f}, {0x205f, 0x206f}, {0x3000, 0x3000},    {0xe000, 0xf8ff}, {0xfe00, 0xfe0f},
      {0xfeff, 0xfeff}, {0xfff0, 0xfffb}, {0xfffe, 0xffff}, {0xe0000, 0x10ffff},
  };
  for (const Range& range : kRefused)
    if (c >= range.first && c <= range.last) return false;
  return true;
}

}  // namespace

bool is_login_name(std::string_view name) noexcept {
  if (name.empty() || name.front() == ' ' || name.back() == ' ') return false;
  for (int count = 0; !name.empty(); ++count) {
    const auto character = next_character(name);
    if (count == 64 || !character || !printable(*character)) return false;
  }
  return true;
}

}  // namespace seldinger::casedb
