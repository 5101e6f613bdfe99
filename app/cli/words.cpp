#include "app/cli/words.h"

#include <algorithm>
#include <utility>

namespace seldinger::app {
namespace {

// Optimal string alignment: Levenshtein's changes, and neighbours swapped once (Damerau, CACM 7(3), 1964).
std::size_t changes_between(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, changed});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    std::swap(before_last, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

}  // namespace

std::string shown(std::string_view typed) {
  constexpr std::size_t kMostBytes = 200;
  std::string text = "\"";
  for (std::size_t i = 0; i < std::min(typed.size(), kMostBytes); ++i) {
    const auto byte = static_cast<unsigned char>(typed[i]);
    const auto next = static_cast<unsigned char>(i + 1 < typed.size() ? typed[i + 1] : 0);
    // U+0080 to U+009F, which terminals obey too, are C2 80 to C2 9F.
    const bool second_set = byte == 0xC2 && next >= 0x80 && next < 0xA0;
    text += byte < 0x20 || byte == 0x7F || second_set ? '?' : typed[i];
    if (second_set) ++i;
  }
  return text + (typed.size() > kMostBytes ? "…\"" : "\"");
}

std::optional<std::string> nearest(std::string_view typed, std::span<const std::string> known) {
  if (typed.empty()) return std::nullopt;
  std::optional<std::string> found;
  bool twice = false;
  std::size_t least = std::max<std::size_t>(1, typed.size() / 3) + 1;
  for (const std::string& one : known) {
    const std::size_t changes = changes_between(typed, one);
    if (changes > least || (changes == least && !found)) continue;
    twice = changes == least && found && *found != one;
    if (changes < least) found = one, least = changes;
  }
  if (found) return twice ? std::nullopt : found;
  for (const std::string& one : known)
    if (typed.size() >= 2 && one.starts_with(typed)) {
      if (found) return std::nullopt;
      found = one;
    }
  return found;
}

std::string did_you_mean(std::string_view typed, std::span<const std::string> known) {
  const auto meant = nearest(typed, known);
  return meant ? "; did you mean " + *meant + "?" : "";
}

std::string one_of(std::span<const std::string> words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? " or " : ", ";
    text += words[i];
  }
  return text;
}

base::Error error_of(const std::string& what, std::string_view typed, base::Error error) {
  error.text = what + " " + shown(typed) + ": " + error.text;
  return error;
}

}  // namespace seldinger::app
