// Tests that the generated documents are what their tables say. To renew one: seldinger help --commands >
// docs/commands.md
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "app/cli/error_codes.h"
#include "app/commands.h"
#include "app/statistics/procedures.h"
#include "assessment/grading/worthwhile.h"
#include "assessment/operators/profile.h"
#include "assessment/procedure/steps.h"
#include "assessment/registry.h"
#include "casedb/import/dicom/allow_list.h"
#include "tests/fixtures/files.h"
#include "tests/fixtures/places.h"
#include "web/routes/routes.h"

namespace {

std::string file(const std::string& name) {
  return seldinger::fixtures::whole_file(seldinger::fixtures::source_dir() / name);
}

TEST(Docs, CommandsAreTheTable) {
  EXPECT_EQ(file("docs/commands.md"), seldinger::app::commands_markdown());
}

TEST(Docs, MetricsAreTheRegistry) {
  EXPECT_EQ(file("docs/metrics.md"), seldinger::assessment::metrics_markdown());
}

TEST(Docs, DifferencesAreTheTable) {
  EXPECT_EQ(file("docs/differences.md"), seldinger::assessment::worthwhile_markdown());
}

TEST(Docs, StepsAreTheTables) {
  EXPECT_EQ(file("docs/steps.md"), seldinger::assessment::steps_markdown());
}

TEST(Docs, OperatorsAreTheTable) {
  EXPECT_EQ(file("docs/operators.md"), seldinger::assessment::operators_markdown());
}

TEST(Docs, StatisticsAreTheTables) {
  EXPECT_EQ(file("docs/statistics.md"), seldinger::app::procedures_markdown());
}

TEST(Docs, RoutesAreTheRegistry) {
  EXPECT_EQ(file("docs/routes.md"), seldinger::web::routes_markdown());
}

TEST(Docs, AttributesAreTheAllowList) {
  EXPECT_EQ(file("docs/attributes.md"), seldinger::casedb::allow_list_markdown());
}

TEST(Docs, ErrorsAreTheTable) {
  EXPECT_EQ(file("docs/errors.md"), seldinger::app::errors_markdown());
}

TEST(Docs, HelpNamesEveryCommandAndOption) {
  const std::string all = seldinger::app::help_text();
  for (const auto& command : seldinger::app::commands()) {
    const std::string name = command.name, noun = name.substr(0, name.find(' '));
    EXPECT_NE(all.find("\n  " + noun), std::string::npos) << name << " is in no group";
    if (name != noun) {
      EXPECT_NE(seldinger::app::help_text_of_noun(noun).find("  " + name), std::string::npos) << name;
      EXPECT_NE(all.find(name.substr(noun.size() + 1)), std::string::npos) << name;
    }
    EXPECT_NE(seldinger::app::help_text(command).find("Examples\n  seldinger " + name), std::string::npos)
        << name << " has no example";
    for (const auto& option : command.options)
      EXPECT_NE(seldinger::app::help_text(command).find(option.name), std::string::npos) << option.name;
  }
}

TEST(Docs, HelpFitsATerminalOfEightyColumns) {
  std::string all = seldinger::app::help_text();
  for (const auto& command : seldinger::app::commands()) {
    std::istringstream lines(seldinger::app::help_text(command));
    for (std::string line; std::getline(lines, line);)
      if (line.rfind("  seldinger ", 0) != 0 && line.find('|') == std::string::npos) all += line + "\n";
    all += seldinger::app::help_text_of_noun(command.name);
  }
  std::istringstream lines(all);
  for (std::string line; std::getline(lines, line);) {
    const auto columns = std::count_if(line.begin(), line.end(),
                                       [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80; });
    EXPECT_LE(columns, 80) << line;
  }
}

TEST(Docs, TheReadmeNamesOnlyCommandsThatExist) {
  const std::string readme = file("README.md");
  ASSERT_FALSE(readme.empty());
  for (std::size_t at = readme.find("`seldinger "); at != std::string::npos;
       at = readme.find("`seldinger ", at + 1)) {
    const std::string rest = readme.substr(at + 11, 40);
    bool known = false;
    for (const auto& command : seldinger::app::commands()) known = known || rest.rfind(command.name, 0) == 0;
    EXPECT_TRUE(known) << rest;
  }
}

TEST(Docs, TheReadmesLinksLeadSomewhere) {
  const std::string readme = file("README.md");
  int links = 0;
  for (std::size_t at = readme.find("]("); at != std::string::npos; at = readme.find("](", at + 1), ++links) {
    const std::string target = readme.substr(at + 2, readme.find(')', at) - at - 2);
    EXPECT_TRUE(std::filesystem::exists(seldinger::fixtures::source_dir().string() + "/" + target)) << target;
  }
  EXPECT_GT(links, 5);
}

// The words of a shell's line up to what leads on to another program; quotes hold spaces together.
std::vector<std::string> words_of_line(const std::string& line) {
  std::vector<std::string> words;
  std::string word;
  bool inside = false;
  char quote = 0;
  for (const char c : line + " ") {
    if (quote != 0 || c == '"' || c == '\'') {
      if (quote == 0)
        quote = c, inside = true;
      else if (c == quote)
        quote = 0;
      else
        word += c;
    } else if (c == ' ' || c == '\n') {
      if (inside && (word == "&&" || word == ">" || word == "|" || word == "#")) break;
      if (inside) words.push_back(word);
      word.clear();
      inside = false;
    } else {
      word += c;
      inside = true;
    }
  }
  return words;
}

// Commands in `…` and in the lines of ``` blocks, without the program's name.
std::vector<std::string> commands_in(const std::string& page) {
  std::vector<std::string> found;
  const auto keep = [&](const std::string& line) {
    if (line.rfind("seldinger ", 0) == 0) found.push_back(line.substr(10));
  };
  for (std::size_t at = page.find('`'); at != std::string::npos; at = page.find('`', at)) {
    const std::string fence = page.compare(at, 3, "```") == 0 ? "```" : "`";
    const std::size_t to = page.find(fence, at + fence.size());
    if (to == std::string::npos) break;
    const std::string text = page.substr(at + fence.size(), to - at - fence.size());
    std::istringstream lines(text);
    if (fence == "`")
      keep(text);
    else
      for (std::string line; std::getline(lines, line);) keep(line);
    at = to + fence.size();
  }
  return found;
}

// What is typed in a page is a command of this program, with options and choices that it has. That they run:
// readme_examples_test, and in tests/e2e examples_test, mentor_page_test and first_hour_test.
TEST(Docs, EveryCommandOfEveryPageIsOne) {
  namespace app = seldinger::app;
  std::vector<std::string> pages = {"README.md", "CONTRIBUTING.md", "SECURITY.md", "docs/scenes/README.md"};
  for (const auto& entry : std::filesystem::directory_iterator(seldinger::fixtures::source_dir() / "docs"))
    if (entry.path().extension() == ".md") pages.push_back("docs/" + entry.path().filename().string());
  int typed = 0;
  for (const std::string& page : pages)
    for (const std::string& line : commands_in(file(page))) {
      SCOPED_TRACE(page + ": seldinger " + line);
      std::vector<std::string> words = words_of_line(line);
      if (words.empty() || words[0] == "--version") continue;
      ++typed;
      const app::Command* found = nullptr;
      std::size_t used = 0;
      for (const app::Command& command : app::commands())
        for (const std::size_t count : {std::size_t{1}, std::size_t{2}})
          if (words.size() >= count && (count == 1 ? words[0] : words[0] + " " + words[1]) == command.name)
            found = &command, used = count;
      if (found == nullptr) {
        EXPECT_TRUE(words.size() == 1 && !app::help_text_of_noun(words[0]).empty()) << "there is no such command";
        continue;
      }
      words.erase(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(used));
      try {
        const app::Arguments arguments(*found, words);
      } catch (const app::UsageError& error) {
        const std::string said = error.what();  // a page may leave out, and say beside it, what it does not talk of
        EXPECT_TRUE(said.ends_with(" is missing") || said.ends_with(" is one word too many") ||
                    said.find(" needs a value") != std::string::npos || line.find("[options]") != std::string::npos)
            << said;
      }
    }
  EXPECT_GT(typed, 200);
}

}  // namespace
