// docs/import.md names every code that import says, and no other.
#include <algorithm>
#include <regex>
#include <set>

#include "import_case.h"

namespace seldinger::casedb {
namespace {

std::set<std::string> all_matches(const std::string& text, const std::regex& pattern) {
  std::set<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), pattern), end; at != end; ++at) found.insert((*at)[1]);
  return found;
}

TEST(Codes, AreThoseOfTheDocument) {
  const std::filesystem::path root = SELDINGER_SOURCE_DIR;
  // The ways in which something is said: a code in front of its text.
  const std::regex said(
      R"rx((?:\badd\(|push_back\(\s*\{|Error(?: \w+)?\{|return \{|DicomKind::\w+, |say\(&DicomSlice::\w+, )\s*"([a-z0-9_]+)",)rx");
  std::set<std::string> codes;
  for (const auto& entry : std::filesystem::directory_iterator(root / "casedb/import"))
    if (entry.path().extension() == ".cpp" || entry.path().extension() == ".h")
      codes.merge(all_matches(file_bytes(entry.path()), said));
  EXPECT_GT(codes.size(), 40U);
  std::set<std::string> documented;
  std::string document = file_bytes(root / "docs/import.md");
  document.erase(0, document.find("## Warnings"));
  // The first cell of each row.
  for (std::size_t at = 0; at < document.size();) {
    const std::size_t end = std::min(document.find('\n', at), document.size());
    const std::string line = document.substr(at, end - at);
    if (line.starts_with("| `"))
      documented.merge(all_matches(line.substr(0, line.find(" | ")), std::regex("`([a-z0-9_]+)`")));
    at = end + 1;
  }
  for (const std::string& code : codes)
    EXPECT_TRUE(documented.contains(code)) << code << " is not in docs/import.md";
  for (const std::string& code : documented) EXPECT_TRUE(codes.contains(code)) << code << " is said nowhere";
}

}  // namespace
}  // namespace seldinger::casedb
