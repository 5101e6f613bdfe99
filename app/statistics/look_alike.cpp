#include "app/statistics/look_alike.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "casedb/database/utf8.h"

namespace seldinger::app {
namespace {

// Capitals and small letters of Greek and Cyrillic, with the Latin small letter that they are seen as.
constexpr std::array<std::pair<char32_t, char>, 39> kSeenAs = {{
    {U'Α', 'a'}, {U'Β', 'b'}, {U'Ε', 'e'}, {U'Ζ', 'z'}, {U'Η', 'h'}, {U'Ι', 'i'}, {U'Κ', 'k'}, {U'Μ', 'm'},
    {U'Ν', 'n'}, {U'Ο', 'o'}, {U'Ρ', 'p'}, {U'Τ', 't'}, {U'Υ', 'y'}, {U'Χ', 'x'}, {U'ο', 'o'}, {U'ν', 'v'},
    {U'А', 'a'}, {U'В', 'b'}, {U'Е', 'e'}, {U'К', 'k'}, {U'М', 'm'}, {U'Н', 'h'}, {U'О', 'o'}, {U'Р', 'p'},
    {U'С', 'c'}, {U'Т', 't'}, {U'Х', 'x'}, {U'І', 'i'}, {U'Ѕ', 's'}, {U'а', 'a'}, {U'е', 'e'}, {U'о', 'o'},
    {U'р', 'p'}, {U'с', 'c'}, {U'у', 'y'}, {U'х', 'x'}, {U'і', 'i'}, {U'ѕ', 's'}, {U'ј', 'j'},
}};

// Blanks, and what takes no room: no-break and thin spaces, joiners, marks of direction and of byte order.
bool is_blank(char32_t one) {
  return one == U' ' || one == U'\t' || one == U'\n' || one == U'\r' || one == 0xA0 || one == 0xAD ||
         (one >= 0x2000 && one <= 0x200F) || one == 0x202F || one == 0x2060 || one == 0x3000 || one == 0xFEFF;
}

}  // namespace

std::string as_seen(std::string_view label) {
  std::string seen;
  while (!label.empty()) {
    const std::string_view before = label;
    const auto character = casedb::next_character(label);
    if (!character) return seen + std::string(before);
    if (is_blank(*character)) continue;
    const auto like =
        std::find_if(kSeenAs.begin(), kSeenAs.end(), [&](const auto& one) { return one.first == *character; });
    if (like != kSeenAs.end())
      seen += like->second;
    else if (*character >= U'A' && *character <= U'Z')
      seen += static_cast<char>(*character - U'A' + U'a');
    else
      seen += before.substr(0, before.size() - label.size());
  }
  return seen;
}

bool hold_look_alikes(const std::vector<std::string>& labels) {
  std::map<std::string, std::string> label_by_look;
  std::string last;
  for (const std::string& label : labels) {
    if (label.empty() || label == last) continue;
    last = label;
    const auto [before, is_new] = label_by_look.emplace(as_seen(label), label);
    if (!is_new && before->second != label) return true;
  }
  return false;
}

}  // namespace seldinger::app
