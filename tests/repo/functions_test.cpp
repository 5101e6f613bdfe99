// Tests of the repository: a function fits on a screen, or its comments tell its blocks apart.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "tests/fixtures/places.h"

namespace {

namespace fs = std::filesystem;
const fs::path kRoot = seldinger::fixtures::source_dir();

constexpr int kMostLines = 80;
constexpr int kLinesPerComment = 12;  // of a longer function: at least one comment line for so many

// Folders of sources: the product's, and its tests.
constexpr std::array<const char*, 9> kFolders = {"shaders", "sim", "assessment", "casedb", "session",
                                                 "reports", "web", "app",        "tests"};

// Longer, and not yet split or commented. An entry that is no longer needed fails the test.
const std::set<std::string> kStillLong = {};

struct Function {
  std::string name;
  int first_line = 0;  // of the body
  int lines = 0;       // of the body, with its braces
  int comments = 0;    // lines that hold nothing else
  bool readable() const { return lines <= kMostLines || comments * kLinesPerComment >= lines; }
};

// A C++ or GLSL source without comments, literals and preprocessor lines; everything else stays in its line.
std::string bare(const std::string& source) {
  std::string out;
  const auto blank = [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < std::min(to, source.size()); ++i) out += source[i] == '\n' ? '\n' : ' ';
    return to;
  };
  bool line_begins = true;
  for (std::size_t i = 0; i < source.size();) {
    const char c = source[i];
    const std::string_view rest = std::string_view(source).substr(i);
    const bool in_word =
        i > 0 && (std::isalnum(static_cast<unsigned char>(source[i - 1])) != 0 || source[i - 1] == '_');
    if (c == '#' && line_begins) {
      std::size_t end = source.find('\n', i);
      while (end != std::string::npos && source[end - 1] == '\\') end = source.find('\n', end + 1);
      i = blank(i, std::min(end, source.size()));
    } else if (rest.starts_with("//")) {
      i = blank(i, std::min(source.find('\n', i), source.size()));
    } else if (rest.starts_with("/*")) {
      i = blank(i, std::min(source.find("*/", i), source.size() - 2) + 2);
    } else if (rest.starts_with("R\"") && !in_word) {
      const std::size_t open = source.find('(', i);
      const std::string close = ")" + source.substr(i + 2, open - i - 2) + "\"";
      i = blank(i, source.find(close, open) + close.size());
    } else if (c == '"' || (c == '\'' && !in_word)) {  // within a number ' separates digits
      std::size_t end = i + 1;
      while (end < source.size() && source[end] != c) end += source[end] == '\\' ? 2 : 1;
      i = blank(i, end + 1);
    } else {
      out += c;
      ++i;
    }
    if (c == '\n')
      line_begins = true;
    else if (c != ' ')
      line_begins = false;
  }
  return out;
}

std::vector<std::string> lines_of(const std::string& source) {
  std::vector<std::string> lines;
  std::istringstream stream(source);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

bool holds_word(const std::string& text, const std::string& word) {
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    const auto is_word = [&](std::size_t i) {
      return i < text.size() && (std::isalnum(static_cast<unsigned char>(text[i])) != 0 || text[i] == '_');
    };
    if ((at == 0 || !is_word(at - 1)) && !is_word(at + word.size())) return true;
  }
  return false;
}

// What a brace opens, from the statement before it.
enum class Opens { names, type, function, other };
Opens opened_by(const std::string& statement) {
  if (holds_word(statement, "namespace")) return Opens::names;
  if (statement.find('(') != std::string::npos) {
    // Not a value: "… = f(x, {".
    const std::size_t equals = statement.find('=');
    const bool value = equals != std::string::npos && equals < statement.find('(') &&
                       statement.find('[', equals) == std::string::npos && !holds_word(statement, "operator=") &&
                       statement.find("operator") == std::string::npos;
    return value ? Opens::other : Opens::function;
  }
  for (const char* word : {"struct", "class", "union", "enum", "extern"})
    if (holds_word(statement, word) && statement.find('=') == std::string::npos) return Opens::type;
  return Opens::other;
}

std::string name_in(const std::string& statement) {
  const std::size_t end = statement.find_last_not_of(" \n", statement.find('(') - 1) + 1;
  const std::size_t begin = statement.find_last_of(" \n*&", end - 1) + 1;
  return statement.substr(begin, end - begin);
}

std::vector<Function> functions_of(const std::string& source) {
  const std::string code = bare(source);
  const std::vector<std::string> lines = lines_of(source);
  std::vector<Function> functions;
  std::vector<Opens> open;
  std::string statement;
  int line = 1;
  const auto outside = [&] {
    return std::all_of(open.begin(), open.end(),
                       [](Opens one) { return one == Opens::names || one == Opens::type; });
  };
  for (std::size_t i = 0; i < code.size(); ++i) {
    const char c = code[i];
    if (c == '{') {
      const bool at_top = outside();
      const Opens what = at_top ? opened_by(statement) : Opens::other;
      if (what == Opens::function) functions.push_back({name_in(statement), line});
      open.push_back(what);
      if (at_top && what != Opens::function) statement.clear();  // a function's may go on: see below
    } else if (c == '}') {
      if (open.empty()) ADD_FAILURE() << "a brace closes nothing in line " << line;
      if (open.empty()) return functions;
      const Opens what = open.back();
      open.pop_back();
      if (what == Opens::function) {
        Function& function = functions.back();
        function.lines = line - function.first_line + 1;
        for (int number = function.first_line; number <= line; ++number) {
          const std::string& text = lines[static_cast<std::size_t>(number) - 1];
          const std::size_t begin = text.find_first_not_of(' ');
          if (begin != std::string::npos && text.compare(begin, 2, "//") == 0) ++function.comments;
        }
      }
      // A brace of a constructor's member is no body; the statement goes on after it.
      const std::size_t next = code.find_first_not_of(" \n", i + 1);
      const bool member =
          what == Opens::function && next != std::string::npos && (code[next] == ',' || code[next] == '{');
      if (member) functions.pop_back();
      if (outside() && !member) statement.clear();
    } else if (outside()) {
      if (c == ';')
        statement.clear();
      else
        statement += c;
    }
    if (c == '\n') ++line;
  }
  EXPECT_TRUE(open.empty()) << "a brace is not closed";
  return functions;
}

std::vector<fs::path> sources() {
  const std::set<std::string> extensions = {".h", ".cpp", ".glsl", ".comp", ".frag", ".vert"};
  std::vector<fs::path> files;
  for (const char* folder : kFolders) {
    if (!fs::exists(kRoot / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder))
      if (entry.is_regular_file() && extensions.contains(entry.path().extension())) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

TEST(Functions, AreShortOrCommentedBlockByBlock) {
  std::size_t found = 0;
  std::set<std::string> still_long;
  for (const fs::path& file : sources()) {
    SCOPED_TRACE(fs::relative(file, kRoot).string());
    for (const Function& function : functions_of(text_of(file))) {
      ++found;
      if (!function.readable() && kStillLong.contains(function.name)) {
        still_long.insert(function.name);
        continue;
      }
      EXPECT_TRUE(function.readable()) << function.name << " in line " << function.first_line << " has "
                                       << function.lines << " lines and " << function.comments
                                       << " of comments: split it, or say above each block what it does";
    }
  }
  EXPECT_GT(found, 10000U);
  EXPECT_EQ(still_long, kStillLong) << "strike what is no longer long off the list";
}

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

TEST(FunctionsScan, FindsALongFunction) {
  const std::string begin = "namespace a {\nstruct B {\n  int c{1};\n  int f(int x = 1) const {\n";
  const std::string end = "  }\n};\n}\n";
  const auto bare_one = functions_of(begin + repeated("    if (x) { g(); }\n", 79) + end);
  ASSERT_EQ(bare_one.size(), 1U);
  EXPECT_EQ(bare_one[0].name, "f");
  EXPECT_EQ(bare_one[0].first_line, 4);
  EXPECT_EQ(bare_one[0].lines, 81);
  EXPECT_FALSE(bare_one[0].readable());
  EXPECT_TRUE(functions_of(begin + repeated("    g();\n", 78) + end)[0].readable());

  // 84 lines with 7 comments, and 85 with 7.
  const std::string commented = begin + repeated("    // Steps.\n" + repeated("    g();\n", 10), 7);
  EXPECT_TRUE(functions_of(commented + repeated("    g();\n", 5) + end)[0].readable());
  EXPECT_FALSE(functions_of(commented + repeated("    g();\n", 6) + end)[0].readable());
}

TEST(FunctionsScan, IsNotMisledByBracesThatOpenNoBlock) {
  const auto found = functions_of(R"code(
#define BLOCK {
const char* kText = "{{{";
constexpr char kOpen = '{';
constexpr int kMany = 50'000;  // a { in a comment
constexpr int kTable[] = {
    1, 2,
};
const Thing kThing = make(1, {2, 3});
Maker::Maker(int a) : a_(a), b_{2}, c_(3) {
  /* { */
  const char c = '\'';
}
template <typename T>
T* raw(const T& t) {
  return R"x({ ")x";
}
bool operator==(const A& a, const A& b) {
  return true;
}
)code");
  std::vector<std::string> names;
  for (const Function& function : found) names.push_back(function.name + ":" + std::to_string(function.lines));
  EXPECT_EQ(names, (std::vector<std::string>{"Maker::Maker:4", "raw:3", "operator==:3"}));
}

}  // namespace
