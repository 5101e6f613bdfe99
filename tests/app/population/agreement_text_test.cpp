// What a check of a surrogate makes of many comparisons.
#include "app/population/agreement_text.h"

#include <gtest/gtest.h>

#include "assessment/population/streams.h"

namespace seldinger::app {
namespace {

namespace population = assessment::population;

// Of effects that are off by so many standard errors each: of the area, and nothing of d.
SurrogateAgreement effects_off_by(const std::vector<double>& errors) {
  SurrogateAgreement made;
  GroupsAgreement& groups = made.effects.emplace_back();
  for (const double one : errors)
    groups.effects.push_back({.metric = "hit", .area_error = 0.01, .area_drawn = 0.5 + 0.01 * one, .d_error = 1.0});
  return made;
}

// A hundred comparisons, each off by a standard normal number: one in twenty checks finds something, where 3
// standard errors alone find it in one of four.
TEST(AgreementVerdict, AllowsForTheNumberOfComparisons) {
  std::size_t off = 0, beyond_three = 0;
  constexpr std::size_t kChecks = 2000, kMetrics = 100;
  for (std::size_t check = 0; check < kChecks; ++check) {
    std::vector<double> errors;
    for (std::size_t m = 0; m < kMetrics; ++m)
      errors.push_back(population::normal_of(population::stream_of(check, population::Drawn::surrogate, m)));
    const auto made = effects_off_by(errors);
    off += verdict_of(made).within_chance() ? 0U : 1U;
    beyond_three += effects_off(made.effects.front()) > 0 ? 1U : 0U;
  }
  // Half of the 200 comparisons, those of d, are off by nothing: 1 − (1 − .05 / 200)^100 = 2.5 %, ± 4 errors.
  EXPECT_NEAR(static_cast<double>(off) / kChecks, 0.0247, 0.014);
  EXPECT_NEAR(static_cast<double>(beyond_three) / kChecks, 0.2368, 0.038);
}

TEST(AgreementVerdict, CountsAndNamesWhatItRestsOn) {
  SurrogateAgreement made = effects_off_by({0.5, -3.2});
  LevelAgreement& level = made.levels.emplace_back();
  level.agreement.comparisons = 96;
  level.agreement.furthest_errors = 1.0;
  const Verdict verdict = verdict_of(made);
  EXPECT_EQ(verdict.comparisons, 100U);
  EXPECT_NEAR(verdict.furthest_errors, 3.2, 1e-9);
  EXPECT_NEAR(verdict.allowed_errors, 3.4808, 1e-3);  // the normal distribution's quantile of .99975
  EXPECT_TRUE(verdict.within_chance());
  EXPECT_NE(text_of_agreement(made).find("within chance"), std::string::npos);
  made.levels.front().agreement.furthest_errors = 3.6;
  EXPECT_FALSE(verdict_of(made).within_chance());
  EXPECT_NE(text_of_agreement(made).find("the surrogate is off"), std::string::npos);
}

}  // namespace
}  // namespace seldinger::app
