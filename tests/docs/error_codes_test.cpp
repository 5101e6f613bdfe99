// Every code that the product's sources give to an error, a finding or a warning is in the table of
// app/cli/error_codes.cpp, and every code of the table is given somewhere.
#include "app/cli/error_codes.h"
#include "tests/fixtures/places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <string_view>

namespace {

namespace fs = std::filesystem;

bool is_name_letter(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

bool looks_like_a_code(std::string_view word) {
  return !word.empty() && std::islower(static_cast<unsigned char>(word.front())) != 0 &&
         std::all_of(word.begin(), word.end(), [](char c) { return is_name_letter(c) && !(c >= 'A' && c <= 'Z'); });
}

std::string without_line_comments(std::string_view text) {
  std::string kept;
  bool in_literal = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!in_literal && text.substr(i, 2) == "//") {
      while (i < text.size() && text[i] != '\n') ++i;
      kept += '\n';
      continue;
    }
    if (in_literal && text[i] == '\\' && i + 1 < text.size()) {
      kept += text[i++];
    } else if (text[i] == '\'' && !in_literal && text.substr(i, 3) == "'\"'") {
      kept += "' '";
      i += 2;
      continue;
    } else if (text[i] == '"' || text[i] == '\n') {
      in_literal = text[i] == '"' && !in_literal;
    }
    kept += text[i];
  }
  return kept;
}

bool take_end(std::string_view& text, std::string_view end) {
  if (!text.ends_with(end)) return false;
  text.remove_suffix(end.size());
  return true;
}

std::string_view take_name(std::string_view& text) {
  std::size_t from = text.size();
  while (from > 0 && is_name_letter(text[from - 1])) --from;
  const std::string_view name = text.substr(from);
  text.remove_suffix(name.size());
  return name;
}

// `CONDITION ?` and `CONDITION ? "other" :` at the end of what stands before a literal are taken away.
void take_choice(std::string_view& before) {
  if (before.ends_with("\":")) {
    const std::size_t other = before.rfind('"', before.size() - 3);
    if (other == std::string_view::npos || other == 0 || before[other - 1] != '?') return;
    before = before.substr(0, other);
  }
  if (!before.ends_with('?')) return;
  int depth = 0;
  for (std::size_t i = before.size() - 1; i-- > 0;) {
    if (before[i] == ')' || before[i] == '}') ++depth;
    if ((before[i] == '(' || before[i] == '{') && depth-- == 0) {
      before = before.substr(0, i + 1);
      return;
    }
  }
}

// Whether what stands before a literal makes it a code. `all_before` has no comments.
bool makes_a_code(std::string_view all_before) {
  std::string tight(all_before.substr(all_before.size() - std::min<std::size_t>(all_before.size(), 300)));
  std::erase_if(tight, [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; });
  std::string_view before = tight;
  take_choice(before);
  if (take_end(before, "return{")) {
    // A braced return gives an error where the function, or a lambda of it, does.
    const std::size_t end_of_last = all_before.rfind("\n}");
    const std::string_view function =
        all_before.substr(end_of_last == std::string_view::npos ? 0 : end_of_last + 2);
    static constexpr std::array<std::string_view, 3> kTypes = {"Error ", "Problem ", "Result<"};
    return std::any_of(kTypes.begin(), kTypes.end(), [&](auto type) {
      const std::size_t at = function.find(type);
      return at != std::string_view::npos && function.find('(', at) != std::string_view::npos;
    });
  }
  if (take_end(before, ".push_back({")) {
    take_end(before, ")");
    static const std::set<std::string_view> kLists = {"findings", "warnings", "problems", "wrong",
                                                      "list_",    "found",    "checks",   "different"};
    return kLists.contains(take_name(before));
  }
  if (before.ends_with("problems.add(") || before.ends_with("refuse({")) return true;
  // In casedb/import/dicom/dicom_volume.cpp and sim/haptics/fit/depth_curve.cpp: lambdas that take a code.
  if (before.ends_with("bad(") && all_before.find("bad = [&](const char* code,") != std::string_view::npos)
    return true;
  if (take_end(before, ",")) {
    take_name(before);
    return take_end(before, "::") && (before.ends_with("{DicomKind") || before.ends_with("{CtVerdict") ||
                                      before.ends_with("say(&DicomSlice"));
  }
  if (take_end(before, "Failure(")) return true;
  if (!take_end(before, "{")) return false;
  const std::string_view type = take_name(before);  // Error, or with the variable's name: Errornone
  return !type.starts_with("ErrorCode") && (type.starts_with("Error") || type.starts_with("Problem"));
}

std::set<std::string> codes_in(std::string_view source) {
  const std::string text = without_line_comments(source);
  std::set<std::string> codes;
  for (std::size_t at = text.find('"'); at != std::string::npos; at = text.find('"', at)) {
    std::size_t end = at + 1;
    while (end < text.size() && text[end] != '"' && text[end] != '\n') end += text[end] == '\\' ? 2 : 1;
    if (end >= text.size()) break;
    const std::string_view word = std::string_view(text).substr(at + 1, end - at - 1);
    if (looks_like_a_code(word) && makes_a_code(std::string_view(text).substr(0, at))) codes.emplace(word);
    if (word.starts_with("error: ")) {
      const std::string_view said = word.substr(7, word.find(':', 7) - 7);
      if (looks_like_a_code(said)) codes.emplace(said);
    }
    at = end + 1;
  }
  return codes;
}

TEST(ErrorCodes, AreSeenInEachFormThatGivesOne) {
  using Codes = std::set<std::string>;
  EXPECT_EQ(codes_in("return base::Error{\"a_1\", \"text\"};"), Codes{"a_1"});
  EXPECT_EQ(codes_in("const base::Error kNone{\n    \"b\", text};"), Codes{"b"});
  EXPECT_EQ(codes_in("x = Error{state == few ? \"c\" : \"d\", text};"), (Codes{"c", "d"}));
  EXPECT_EQ(codes_in("throw base::Failure(\"e\", \"text\");"), Codes{"e"});
  EXPECT_EQ(codes_in("return refuse({\"f\", \"text\"});"), Codes{"f"});
  EXPECT_EQ(codes_in("(repair ? r.repaired : r.findings)\n    .push_back({\"g\", \"text\"});"), Codes{"g"});
  EXPECT_EQ(codes_in("problems.add(left.empty() ? \"h\" : \"i\", \"text\");"), (Codes{"h", "i"}));
  EXPECT_EQ(codes_in("base::Error bad(const char* t) {\n  return {\"j\", t};\n}\n"), Codes{"j"});
  EXPECT_EQ(codes_in("Row row_of(int n) {\n  return {\"k\", n};\n}\n"), Codes{});
  EXPECT_EQ(codes_in("{DicomKind::no_image, \"l\", \"text\"},\nsay(&DicomSlice::odd, \"m\", \"text\");"),
            (Codes{"l", "m"}));
  EXPECT_EQ(codes_in("std::fputs(\"error: n: text\\n\", stderr);"), Codes{"n"});
  EXPECT_EQ(codes_in("// Error{\"o\", text}\nrows.push_back({\"p\", 1}); add(\"q\", 'x');"), Codes{});
}

TEST(ErrorCodes, OfTheSourcesAreThoseOfTheTable) {
  std::map<std::string, std::string> given;  // code → a file that gives it
  for (const char* layer : {"sim", "assessment", "casedb", "session", "reports", "web", "app"}) {
    const fs::path folder = seldinger::fixtures::source_dir() / layer;
    if (!fs::exists(folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      const fs::path& path = entry.path();
      if (path.extension() != ".cpp" && path.extension() != ".h") continue;
      std::ifstream stream(path);
      const std::string text{std::istreambuf_iterator<char>(stream), {}};
      for (const std::string& code : codes_in(text)) given.try_emplace(code, path.filename().string());
    }
  }
  EXPECT_GT(given.size(), 150U);
  std::set<std::string> listed;
  for (const auto& section : seldinger::app::error_codes())
    for (const auto& one : section.codes) {
      EXPECT_TRUE(listed.insert(one.code).second) << one.code << " is in the table twice";
      EXPECT_TRUE(given.contains(one.code)) << one.code << " is in the table, and nothing gives it";
    }
  for (const auto& [code, file] : given)
    EXPECT_TRUE(listed.contains(code)) << code << " (" << file << ") is not in app/cli/error_codes.cpp";
}

TEST(ErrorCodes, HaveAMeaningInASentenceAndAKind) {
  for (const auto& section : seldinger::app::error_codes())
    for (const auto& one : section.codes) {
      const std::string meaning = one.meaning, remedy = one.remedy;
      EXPECT_NE(one.kinds, 0U) << one.code;
      EXPECT_TRUE(!meaning.empty() && meaning.back() == '.') << one.code;
      EXPECT_TRUE(remedy.empty() || remedy.back() == '.') << one.code;
      EXPECT_EQ((meaning + remedy).find('|'), std::string::npos) << one.code << " would break the page's table";
    }
}

}  // namespace
