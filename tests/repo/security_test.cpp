// Tests of the repository: whatever SECURITY.md promises, and each attack it tells of, names its test, and that
// test is there.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/fixtures/files.h"
#include "tests/fixtures/places.h"

namespace {

namespace fs = std::filesystem;
const fs::path kRoot = seldinger::fixtures::source_dir();

struct Tests {
  std::set<std::string> whole, names, suites, programs;  // "Suite.Name", "Name", "Suite", "some_test"
};

Tests read_tests() {
  static const std::regex kTest(R"(\bTEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\s*\))");
  static const std::regex kProgram(R"(\bNAME\s+(\w+_test)\b|seldinger(?:_program)?_test\((\w+))");
  Tests tests;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "tests")) {
    const fs::path& file = entry.path();
    if (file.extension() != ".cpp" && file.filename() != "CMakeLists.txt") continue;
    const std::string text = seldinger::fixtures::whole_file(file);
    const bool code = file.extension() == ".cpp";
    if (code) tests.programs.insert(file.stem());
    for (std::sregex_iterator it(text.begin(), text.end(), code ? kTest : kProgram), end; it != end; ++it) {
      if (!code) {
        tests.programs.insert((*it)[1].matched ? it->str(1) : it->str(2));
        continue;
      }
      tests.suites.insert(it->str(1));
      tests.names.insert(it->str(2));
      tests.whole.insert(it->str(1) + "." + it->str(2));
    }
  }
  return tests;
}

const Tests& all_tests() {
  static const Tests tests = read_tests();
  return tests;
}

bool begins_one(const std::set<std::string>& names, const std::string& start) {
  const auto found = names.lower_bound(start);
  return found != names.end() && found->starts_with(start);
}

// "Suite.Name", "Suite.Begi…", "Suite.*", "Name" or "Suite" alone, "some_test", or a folder of tests.
bool is_test(const Tests& tests, std::string named) {
  const std::string kRest = "…";
  if (named.starts_with("tests/")) return fs::is_directory(kRoot / named);
  if (named.ends_with(".*")) return tests.suites.contains(named.substr(0, named.size() - 2));
  if (named.ends_with(kRest)) {
    named.resize(named.size() - kRest.size());
    return begins_one(named.find('.') == named.npos ? tests.names : tests.whole, named);
  }
  if (named.find('.') != named.npos) return tests.whole.contains(named);
  return tests.names.contains(named) || tests.suites.contains(named) || tests.programs.contains(named);
}

// The cells of each row of a table that has a column of tests, without its two first lines.
std::vector<std::vector<std::string>> rows_with_tests(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(text);
  std::string line;
  bool tests = false;
  for (std::string before; std::getline(lines, line); before = line) {
    if (!line.starts_with("|")) {
      tests = false;
      continue;
    }
    std::vector<std::string> cells;
    std::istringstream in(line.substr(1));
    for (std::string cell; std::getline(in, cell, '|');) cells.push_back(cell);
    if (!before.starts_with("|")) {  // what its columns are called
      const std::string& last = cells.back();
      tests = last.find("test") != last.npos || last.find("held by") != last.npos;
      EXPECT_TRUE(tests) << "a table without a column of tests: " << line;
      continue;
    }
    if (tests && !line.starts_with("|---")) rows.push_back(cells);
  }
  return rows;
}

std::vector<std::string> named_in(const std::string& text) {
  static const std::regex kNamed(R"(`([A-Za-z][^`]*)`)");
  std::vector<std::string> names;
  for (std::sregex_iterator it(text.begin(), text.end(), kNamed), end; it != end; ++it) names.push_back(it->str(1));
  return names;
}

TEST(Security, EachPromiseAndEachAttackNamesATestThatIsThere) {
  const Tests& tests = all_tests();
  const auto rows = rows_with_tests(seldinger::fixtures::whole_file(kRoot / "SECURITY.md"));
  EXPECT_GT(rows.size(), 60U);
  for (const auto& cells : rows) {
    const std::vector<std::string> named = named_in(cells.back());
    EXPECT_FALSE(named.empty()) << "no test is named: " << cells.front();
    for (const std::string& one : named)
      if (one.find("./run") == one.npos) {
        EXPECT_TRUE(is_test(tests, one)) << one << ", of:" << cells.front();
      }
  }
}

TEST(Security, ATestThatIsNotThereIsMissed) {
  const Tests& tests = all_tests();
  EXPECT_TRUE(is_test(tests, "Security.ATestThatIsNotThereIsMissed"));
  EXPECT_TRUE(is_test(tests, "Security.ATest…"));
  EXPECT_TRUE(is_test(tests, "Security.*"));
  EXPECT_TRUE(is_test(tests, "repo_test"));
  EXPECT_TRUE(is_test(tests, "tests/repo"));
  for (const char* planted : {"Security.ATestThatIsNot", "Security.Nothing…", "Insecurity.*", "no_such_test",
                              "NoSuch", "tests/nowhere", "Cases.ATestThatIsNotThereIsMissed"})
    EXPECT_FALSE(is_test(tests, planted)) << planted;
}

}  // namespace
