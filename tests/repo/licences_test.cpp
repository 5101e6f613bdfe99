// What the built programs link against docs/licences.md: nothing unknown, nothing under the GPL.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "tests/fixtures/process.h"

namespace seldinger {
namespace {

namespace fs = std::filesystem;
using Words = std::set<std::string>;
using testing::ElementsAre;
using testing::IsEmpty;

struct Linked {
  std::string package, licence, how;  // shared, static or headers
  Words libraries, headers;           // names without .so.*, beginnings of includes
};

struct Found {
  Words shared, archives, headers;
};

// What may be linked in any way. MPL-2.0 binds its own files only.
const Words kAllowed = {"Apache-2.0", "Beerware", "BSD-2-Clause", "BSD-3-Clause", "BSL-1.0",
                        "IJG",        "ISC",      "MIT",          "MPL-2.0",      "X11",
                        "Unlicense",  "Zlib",     "blessing",     "libpng-2.0"};

Words words_of(const std::string& text) {
  std::istringstream in(text);
  Words words;
  for (std::string word; in >> word;) words.insert(word);
  return words;
}

std::vector<std::string> split(const std::string& text, const std::string& by) {
  std::vector<std::string> parts;
  std::size_t from = 0;
  for (std::size_t at = text.find(by); at != std::string::npos; at = text.find(by, from)) {
    parts.push_back(text.substr(from, at - from));
    from = at + by.size();
  }
  parts.push_back(text.substr(from));
  return parts;
}

std::vector<Linked> table_in(const std::string& page) {
  std::vector<Linked> table;
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("| lib", 0) != 0 && line.rfind("| zlib", 0) != 0 && line.rfind("| nlohmann", 0) != 0) continue;
    auto cells = split(line, "|");
    if (cells.size() != 8) {
      ADD_FAILURE() << "not six cells: " << line;
      continue;
    }
    for (std::string& cell : cells) {
      cell.erase(0, cell.find_first_not_of(' '));
      cell.erase(cell.find_last_not_of(' ') + 1);
    }
    table.push_back({cells[1], cells[2], cells[3], words_of(cells[4]), words_of(cells[5])});
  }
  return table;
}

bool is_allowed(const std::string& licence, const std::string& how) {
  for (const std::string& choice : split(licence, " OR ")) {
    bool all = true;
    for (const std::string& part : split(choice, " AND ")) {
      const bool lesser = part.rfind("LGPL-", 0) == 0 && how == "shared";
      const bool runtime = part == "GPL-3.0-or-later WITH GCC-exception-3.1";
      all = all && (kAllowed.contains(part) || lesser || runtime);
    }
    if (all) return true;
  }
  return false;
}

// One line a fault; none: the table tells all of it, and all of it may be.
std::vector<std::string> faults(const std::vector<Linked>& table, const Found& found) {
  std::vector<std::string> lines;
  std::map<std::string, const Linked*> shared, archives, headers;
  for (const Linked& row : table) {
    if (!is_allowed(row.licence, row.how)) lines.push_back("not allowed: " + row.package + ", " + row.licence);
    if (!Words{"shared", "static", "headers"}.contains(row.how)) lines.push_back("how? " + row.package);
    for (const std::string& one : row.libraries) (row.how == "static" ? archives : shared)[one] = &row;
    for (const std::string& one : row.headers) headers[one] = &row;
  }
  for (const auto& [known, there, kind] :
       {std::tuple(&shared, &found.shared, "library"), {&archives, &found.archives, "archive"}}) {
    for (const std::string& one : *there)
      if (!known->contains(one)) lines.push_back(std::string("unknown ") + kind + ": " + one);
    for (const auto& [one, row] : *known)
      if (!there->contains(one)) lines.push_back(std::string("not linked: ") + one);
  }
  for (const std::string& one : found.headers)
    if (std::none_of(headers.begin(), headers.end(), [&](const auto& row) { return one.rfind(row.first, 0) == 0; }))
      lines.push_back("unknown header: " + one);
  return lines;
}

std::string bare(const std::string& path) {
  const std::string name = fs::path(path).filename();
  return name.substr(0, std::min(name.find(".so"), name.find(".a")));
}

// The loader's whole list of both programs, the archives on their link lines, and what our sources include that is
// neither ours nor the language's.
Found found_in_the_build() {
  Found found;
  const auto scratch = fixtures::fresh_folder("licences");
  const fs::path build = fs::path(fixtures::built_target("seldinger")).parent_path();
  for (const char* program : {"seldinger", "seldinger-measure"}) {
    const auto ran = fixtures::run("ldd '" + (build / program).string() + "'", scratch);
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_EQ(ran.out.find("not found"), std::string::npos) << ran.out;
    for (const std::string& line : split(ran.out, "\n"))
      if (const std::size_t at = line.find(" => /"); at != std::string::npos)
        found.shared.insert(bare(split(line.substr(at + 4), " (").front()));
  }
  for (const std::string& line : split(fixtures::whole_file(build / "build.ninja"), "\n"))
    if (line.rfind("  LINK_LIBRARIES = ", 0) == 0 && line.find("libseldinger_test_places") == std::string::npos)
      for (const std::string& word : words_of(line))
        if (word.front() == '/' && word.ends_with(".a")) found.archives.insert(bare(word));
  static const std::regex kInclude(R"(\n\s*#\s*include\s*<([^>]*[./][^>]*)>)");
  for (const char* folder : {"shaders", "sim", "assessment", "casedb", "session", "reports", "web", "app"})
    for (const auto& entry : fs::recursive_directory_iterator(fixtures::source_dir() / folder)) {
      if (!Words{".cpp", ".h"}.contains(entry.path().extension())) continue;
      const std::string text = "\n" + fixtures::whole_file(entry.path());
      for (std::sregex_iterator at(text.begin(), text.end(), kInclude), end; at != end; ++at)
        found.headers.insert((*at)[1]);
    }
  EXPECT_GT(found.shared.size(), 50U);
  EXPECT_GT(found.headers.size(), 50U);
  return found;
}

// Before there was a table, CHOLMOD and SuiteSparseQR (GPL-2.0-or-later) were linked and nobody knew.
TEST(Licences, EveryLinkedLibraryIsKnownAndAllowed) {
  const auto table = table_in(fixtures::whole_file(fixtures::source_dir() / "docs" / "licences.md"));
  const Found found = found_in_the_build();
  EXPECT_THAT(faults(table, found), IsEmpty());
  for (const char* gpl : {"libcholmod", "libspqr", "libfftw3", "libgsl", "libreadline", "libpoppler"})
    EXPECT_FALSE(found.shared.contains(gpl)) << gpl;
}

TEST(Licences, WhatIsNotAllowedIsTold) {
  const std::vector<Linked> table = {{"a", "MIT AND Zlib", "static", {"liba"}, {"a/"}},
                                     {"b", "LGPL-2.1-or-later", "shared", {"libb"}, {}}};
  const Found found{{"libb"}, {"liba"}, {"a/a.h"}};
  EXPECT_THAT(faults(table, found), IsEmpty());
  EXPECT_THAT(faults(table, {{"libb", "libspqr"}, {"liba"}, {}}), ElementsAre("unknown library: libspqr"));
  EXPECT_THAT(faults(table, {{"libb"}, {"liba", "libceres"}, {}}), ElementsAre("unknown archive: libceres"));
  EXPECT_THAT(faults(table, {{"libb"}, {"liba"}, {"ceres/ceres.h"}}), ElementsAre("unknown header: ceres/ceres.h"));
  EXPECT_THAT(faults(table, {{}, {"liba"}, {}}), ElementsAre("not linked: libb"));
  const auto told = [&](const std::string& licence, const std::string& how) {
    auto changed = table;
    (how == "shared" ? changed[1] : changed[0]).licence = licence;
    return !faults(changed, found).empty();
  };
  EXPECT_TRUE(told("GPL-2.0-or-later", "shared"));
  EXPECT_TRUE(told("GPL-3.0-or-later", "shared")) << "without GCC's exception";
  EXPECT_TRUE(told("MIT AND GPL-2.0-only", "shared"));
  EXPECT_TRUE(told("LGPL-2.1-or-later", "static"));
  EXPECT_TRUE(told("AGPL-3.0-only", "shared"));
  EXPECT_TRUE(told("", "static"));
  EXPECT_FALSE(told("GPL-3.0-or-later WITH GCC-exception-3.1", "shared"));
  EXPECT_FALSE(told("BSD-3-Clause OR GPL-2.0-only", "static"));
}

}  // namespace
}  // namespace seldinger
