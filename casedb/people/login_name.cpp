#include "casedb/people/login_name.h"

#include "casedb/database/utf8.h"

namespace seldinger::casedb {
namespace {

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
