// docs/import.md names every code that import says, and no other.
#include <algorithm>
#include <array>
#include <set>
#include <string_view>

#include "import_case.h"
#include "tests/fixtures/places.h"

namespace seldinger::casedb {
namespace {

bool is_code_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
}

// Whether what stands before a word makes it the code of something said.
bool says(std::string_view all_before) {
  std::string before(all_before.substr(all_before.size() - std::min<std::size_t>(all_before.size(), 100)));
  std::erase_if(before, [](char c) { return c == ' ' || c == '\n'; });
  static constexpr std::array<std::string_view, 5> kWays = {".add(", "push_back({", "Error{", "Errorno_body{",
                                                            "return{"};
  if (std::any_of(kWays.begin(), kWays.end(), [&](auto way) { return before.ends_with(way); })) return true;
  const std::size_t word = before.rfind("::");  // {DicomKind::localizer, "…    say(&DicomSlice::lossy, "…
  if (!before.ends_with(',') || word == std::string::npos) return false;
  const std::string scope = before.substr(0, word), name = before.substr(word + 2, before.size() - word - 3);
  return std::all_of(name.begin(), name.end(), is_code_letter) &&
         (scope.ends_with("{DicomKind") || scope.ends_with("say(&DicomSlice"));
}

// Words between two `quote`s that `wanted` takes by what stands before them.
template <typename Wanted>
void collect(std::string_view text, char quote, Wanted wanted, std::set<std::string>& words) {
  for (std::size_t at = text.find(quote); at != std::string_view::npos; at = text.find(quote, at + 1)) {
    const std::size_t end = text.find(quote, at + 1);
    if (end == std::string_view::npos) return;
    const std::string_view word = text.substr(at + 1, end - at - 1);
    if (!word.empty() && std::all_of(word.begin(), word.end(), is_code_letter) && wanted(text.substr(0, at)))
      words.emplace(word);
  }
}

TEST(Codes, AreThoseOfTheDocument) {
  const std::filesystem::path root = fixtures::source_dir();
  std::set<std::string> codes, documented;
  for (const auto& entry : std::filesystem::directory_iterator(root / "casedb/import"))
    if (entry.path().extension() == ".cpp" || entry.path().extension() == ".h")
      collect(fixtures::whole_file(entry.path()), '"', says, codes);
  EXPECT_GT(codes.size(), 40U);
  const std::string document = fixtures::whole_file(root / "docs/import.md");
  // The first cell of each row.
  for (std::size_t at = document.find("\n| `"); at != std::string::npos; at = document.find("\n| `", at + 1))
    collect(
        std::string_view(document).substr(at, document.find(" | ", at) - at), '`', [](auto) { return true; },
        documented);
  for (const std::string& code : codes)
    EXPECT_TRUE(documented.contains(code)) << code << " is not in docs/import.md";
  for (const std::string& code : documented) EXPECT_TRUE(codes.contains(code)) << code << " is said nowhere";
}

}  // namespace
}  // namespace seldinger::casedb
