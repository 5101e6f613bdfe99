// Simulated trainees at the graded cases: most experts pass, novices mostly do not, and the table of
// docs/pass-rates.sh counts them.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/e2e/simulated/simulated_trainees.h"
#include "tests/fixtures/answers.h"
#include "tests/fixtures/places.h"

namespace seldinger {
namespace {

using Json = nlohmann::json;
using fixtures::kProgram;
using fixtures::run;

const int kTimes = std::getenv("SELDINGER_REPETITIONS") == nullptr ? 2 : 10;

bool passes(const Json& attempt, const Json& criteria) {
  for (const Json& criterion : criteria) {
    const auto value = fixtures::metric(attempt, criterion.at("metric"));
    const double wanted = criterion.at("value");
    const std::string comparison = criterion.at("comparison");
    if (!value || !(comparison == "<="   ? *value <= wanted
                    : comparison == ">=" ? *value >= wanted
                                         : *value == wanted))
      return false;
  }
  return true;
}

class PassRatesTest : public SimulatedTrainees {
 protected:
  static void SetUpTestSuite() { make("pass_rates"); }
};

TEST_F(PassRatesTest, MostExpertsPassTheGradedCasesAndNovicesMostlyDoNot) {
  ASSERT_EQ(cases_.size(), 8U);
  for (const Json& one : cases_) {
    if (one.at("decision") == "defer") continue;
    const std::string id = one.at("case_id");
    const Json shown = ask("case show " + id);
    const Json& criteria = shown.at("rule");
    ASSERT_GE(criteria.size(), 6U);
    for (const bool expert : {true, false}) {
      const int count = kTimes * (expert ? 2 : 1);
      const Json ran = ask("simulate --count " + std::to_string(count) + " --no-pictures --seed 1 --operator " +
                           std::string(expert ? "expert" : "novice") + " --case " + id);
      int passed = 0;
      for (const Json& attempt : ran.at("attempts")) passed += passes(attempt, criteria) ? 1 : 0;
      // How many is nobody's promise: that most do tells that the case can be met.
      if (expert)
        EXPECT_GE(2 * passed, count) << one.at("title");
      else
        EXPECT_LE(3 * passed, count + 1) << one.at("title");
    }
  }
}

// docs/pass-rates.sh: a row for each case of the library, counted as the attempts there are graded.
TEST_F(PassRatesTest, PassRatesAreATableOfTheCases) {
  const std::string library = (scratch_ / "two").string();
  const auto answer = [&](const std::string& words) {
    const auto ran = run(kProgram + " " + words + " --json --library '" + library + "'", scratch_);
    EXPECT_EQ(ran.exit_code, 0) << words << "\n" << ran.err;
    return Json::parse(ran.out, nullptr, false);
  };
  for (const std::size_t i : {2U, 5U}) {  // of patients who do not breathe: quick
    const std::string bundle = (scratch_ / "case.sdbundle").string();
    ask("case bundle " + cases_[i].at("case_id").get<std::string>() + " --out '" + bundle + "'");
    answer("bundle import '" + bundle + (i == 2U ? "' --new-library" : "'"));
    std::filesystem::remove(bundle);
  }
  const auto ran = run("PEOPLE=2 SEED=7 SELDINGER='" + kProgram + "' '" +
                           (fixtures::source_dir() / "docs/pass-rates.sh").string() + "' '" + library + "'",
                       scratch_);
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  std::string wanted = "| | simulated novices | simulated experts |\n|---|---|---|\n";
  const Json cases = answer("case list").at("cases");
  EXPECT_EQ(cases.size(), 2U);
  for (const Json& row : cases) {
    wanted += "| " + row.at("title").get<std::string>();
    for (const char* group : {"novice", "expert"}) {
      const Json made = answer("simulate --people 2 --seed 7 --no-pictures --operator " + std::string(group) +
                               " --case " + row.at("case_id").get<std::string>());
      int passed = 0;
      for (const Json& attempt : made.at("attempts"))
        passed += attempt.at("grade").at("verdict") == "passed" ? 1 : 0;
      wanted += " | " + std::to_string(passed) + " of 2";
    }
    wanted += " |\n";
  }
  EXPECT_EQ(ran.out, wanted);
}

}  // namespace
}  // namespace seldinger
