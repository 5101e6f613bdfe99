#include "casedb/questionnaires/drawn_word.h"

#include <array>

#include "casedb/database/credentials.h"

namespace seldinger::casedb {

std::string drawn_word(std::string_view letters, std::size_t length) {
  std::string word;
  while (word.size() < length) {
    std::array<std::byte, 1> random{};
    fill_random(random);
    const auto value = std::to_integer<std::size_t>(random[0]);
    if (value < 256 - 256 % letters.size()) word += letters[value % letters.size()];
  }
  return word;
}

std::string drawn_code() {
  return drawn_word("ACDEFGHJKLMNPQRTUVWXY34679", 6);
}

std::string code_from(std::string_view typed) {
  std::string capitals;
  for (const char c : typed)
    if (c != ' ' && c != '-') capitals += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return capitals;
}

}  // namespace seldinger::casedb
