// Wrong calls with their exact words: tests/e2e/wrong_calls.txt has an exit code, what is typed, and the first line
// of standard error, in three lines each. `lib` is a library with one case, "Built-in torso", and three attempts.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/fixtures/demo_library.h"
#include "tests/fixtures/places.h"
#include "tests/fixtures/process.h"

namespace seldinger {
namespace {

using fixtures::kProgram;

TEST(WrongCalls, AreAnsweredInTheseWords) {
  const auto folder = fixtures::fresh_folder("wrong_calls"), at = folder / "here";
  std::filesystem::create_directories(at / "empty");
  std::ofstream(at / "scene.json") << "{}";
  std::ofstream(at / "rule.json") << "[";
  const auto type = [&](const std::string& words) {
    return fixtures::run("cd '" + at.string() + "' && env -u SELDINGER_LIBRARY XDG_DATA_HOME=/nowhere '" +
                             kProgram + "' " + words + " </dev/null",
                         folder / "said");
  };
  fixtures::demo_library("", at / "lib");
  const std::string before = fixtures::fingerprint(at / "lib");
  std::ifstream table(fixtures::source_dir() / "tests" / "e2e" / "wrong_calls.txt");
  int calls = 0;
  for (std::string code, words, said;
       std::getline(table, code) && std::getline(table, words) && std::getline(table, said); ++calls) {
    SCOPED_TRACE(words);
    const auto ran = type(words);
    EXPECT_EQ(std::to_string(ran.exit_code), code) << ran.err;
    EXPECT_EQ(ran.err.substr(0, ran.err.find('\n')), said);
    if (words.find("--json") == std::string::npos) {
      EXPECT_EQ(ran.out, "");
    } else {
      EXPECT_TRUE(nlohmann::json::parse(ran.out, nullptr, false).contains("error")) << ran.out;
    }
  }
  EXPECT_GE(calls, 60);
  EXPECT_EQ(fixtures::fingerprint(at / "lib"), before) << "a wrong call changes nothing";
  EXPECT_FALSE(std::filesystem::exists(at / "libary"));
}

}  // namespace
}  // namespace seldinger
