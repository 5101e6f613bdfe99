#include "casedb/database/utf8.h"

namespace seldinger::casedb {

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

bool is_text(std::string_view text) noexcept {
  while (!text.empty())
    if (const auto character = next_character(text); !character || *character == 0) return false;
  return true;
}

}  // namespace seldinger::casedb
