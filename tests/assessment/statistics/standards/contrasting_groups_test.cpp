// The crossing of two normals against its closed form and R, and what contrasting groups refuse.
#include "assessment/statistics/standards/contrasting_groups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "sim/base/rng.h"
#include "tests/assessment/statistics/r_oracle.h"

namespace seldinger::assessment::statistics {
namespace {

void expect_cut(double got, double want, double tolerance = 1e-9) {
  fixtures::note_difference(got, want);
  EXPECT_LE(std::abs(got - want), tolerance * std::max(1.0, std::abs(want))) << got << " for " << want;
}

double of_answer(const Answer& answer, const std::string& name) {
  for (const Named& one : answer.more)
    if (one.name == name) return one.value;
  return std::nan("");
}

ContrastingGroups two_groups(std::vector<double> without, std::vector<double> competent, bool higher = true) {
  return {{"novice", without.size()},
          {"expert", competent.size()},
          std::move(without),
          std::move(competent),
          higher,
          0};
}

const std::vector<double> kNovices = {40, 35, 38, 43, 44, 41, 52}, kExperts = {48, 60, 45, 63, 56, 64};

TEST(ContrastingGroups, CrossesBetweenTheMeans) {
  const auto cut = normal_crossing({60, 10}, {80, 6});
  ASSERT_TRUE(cut);
  expect_cut(*cut, 71.0255004345306, 1e-13);
  const WrongDecisions wrong = wrong_decisions({60, 10}, {80, 6}, *cut, true);
  expect_cut(wrong.false_pass, .135111307449, 1e-11);
  expect_cut(wrong.false_fail, .067359417118, 1e-11);
}

TEST(ContrastingGroups, OfEqualSpreadIsTheMidpoint) {
  EXPECT_EQ(*normal_crossing({60, 10}, {80, 10}), 70.0);
  const WrongDecisions wrong = wrong_decisions({60, 10}, {80, 10}, 70.0, true);
  expect_cut(wrong.false_pass, .158655253931, 1e-11);
  expect_cut(wrong.false_fail, .158655253931, 1e-11);
  // Nearly the same spread is nearly the midpoint: no cancellation.
  expect_cut(*normal_crossing({60, 10}, {80, 10 * (1 + 1e-13)}), 70.0, 1e-10);
}

TEST(ContrastingGroups, MirrorsWhereLowerIsBetter) {
  std::vector<double> without = kNovices, competent = kExperts;
  for (auto* scores : {&without, &competent})
    for (double& score : *scores) score = 100.0 - score;
  const Answer up = contrasting_groups(two_groups(kNovices, kExperts), 500, 3);
  const Answer down = contrasting_groups(two_groups(without, competent, false), 500, 3);
  expect_cut(*down.estimate, 100.0 - *up.estimate, 1e-12);
  for (const char* name :
       {"false_pass_theoretical", "false_fail_theoretical", "false_pass_observed", "false_fail_observed"})
    expect_cut(of_answer(down, name), of_answer(up, name), 1e-12);
  ASSERT_TRUE(up.ci95 && down.ci95);
  expect_cut(down.ci95->low, 100.0 - up.ci95->high, 1e-10);
}

TEST(ContrastingGroups, CountsWhoIsDecidedWrongly) {
  const Answer answer = contrasting_groups(two_groups(kNovices, kExperts), 0, 1);
  ASSERT_TRUE(answer.estimable());
  EXPECT_GT(*answer.estimate, 45.0);
  EXPECT_LT(*answer.estimate, 52.0);
  expect_cut(of_answer(answer, "false_pass_observed"), 1.0 / 7.0);
  EXPECT_FALSE(answer.ci95);
  EXPECT_EQ(answer.n, 13u);
  ASSERT_EQ(answer.groups.size(), 2u);
  EXPECT_EQ(answer.groups[0].n, 7u);
}

TEST(ContrastingGroups, DrawsTheSamePersonsFromTheSameSeed) {
  const auto interval = [](std::uint64_t seed) {
    return *contrasting_groups(two_groups(kNovices, kExperts), 400, seed).ci95;
  };
  EXPECT_EQ(interval(9), interval(9));
  EXPECT_FALSE(interval(9) == interval(10));
  EXPECT_LT(interval(9).low, interval(9).high);
}

TEST(ContrastingGroups, RefusesWithAReason) {
  EXPECT_EQ(contrasting_groups(two_groups({1, 2, 3, 4}, kExperts), 0, 1).reason, "group_too_small");
  EXPECT_EQ(contrasting_groups(two_groups(kNovices, {1, 2, 3, 4}), 0, 1).reason, "group_too_small");
  EXPECT_EQ(contrasting_groups(two_groups(kExperts, kNovices), 0, 1).reason, "no_crossing");
  // One group so wide that its density is below the other's from mean to mean.
  EXPECT_EQ(contrasting_groups(two_groups({-20, -10, 0, 10, 20}, {-0.05, 0, 0.05, 0.1, 0.15}), 0, 1).reason,
            "no_crossing");
  EXPECT_EQ(contrasting_groups(two_groups({1, 1, 1, 1, 1}, {2, 2, 2, 2, 2}), 0, 1).reason, "no_variation_within");
  EXPECT_EQ(contrasting_groups(two_groups({1, 1, 1, 1, 1}, kExperts), 0, 1).reason, "no_variation");
}

// The roots of the quadratic, of which the one between the means is kept.
constexpr const char* kCrossingOfR = R"(
crossing <- function(name, x, y) {
  a <- 1 / (2 * var(x)) - 1 / (2 * var(y)); b <- mean(y) / var(y) - mean(x) / var(x)
  c <- mean(x)^2 / (2 * var(x)) - mean(y)^2 / (2 * var(y)) - log(sd(y) / sd(x))
  r <- (-b + c(-1, 1) * sqrt(b^2 - 4 * a * c)) / (2 * a); r <- r[r > mean(x) & r < mean(y)]
  cut <- if (length(r) == 1) r else NA; say(paste0(name, 'cut'), cut)
  say(paste0(name, 'pass'), pnorm(cut, mean(x), sd(x), lower.tail = FALSE)); say(paste0(name, 'fail'), pnorm(cut, mean(y), sd(y)))
}
)";

TEST(ContrastingGroups, IsThatOfR) {
  SELDINGER_NEEDS_R();
  std::string script = kCrossingOfR;
  std::vector<ContrastingGroups> sets;
  for (std::size_t set = 0; set < fixtures::r_sets(); ++set) {
    base::Rng rng(fixtures::r_seed() + 5000 + set);
    std::vector<double> without(5 + set % 11), competent(5 + set % 7);
    const double spread = 0.4 + 2.0 * rng.uniform(), apart = 4.0 * rng.uniform();
    for (double& one : without) one = rng.normal();
    for (double& one : competent) one = apart + spread * rng.normal();
    sets.push_back(two_groups(without, competent));
    script += "crossing('s" + std::to_string(set) + "_', " + fixtures::r_vector(without) + ", " +
              fixtures::r_vector(competent) + ")\n";
  }
  const std::map<std::string, double> want = fixtures::r_values(script);
  std::size_t cuts = 0;
  for (std::size_t set = 0; set < sets.size(); ++set) {
    SCOPED_TRACE(set);
    const std::string name = "s" + std::to_string(set) + "_";
    const Answer answer = contrasting_groups(sets[set], 0, 1);
    ASSERT_EQ(answer.estimable(), std::isfinite(want.at(name + "cut")));
    if (!answer.estimable()) continue;
    ++cuts;
    expect_cut(*answer.estimate, want.at(name + "cut"));
    expect_cut(of_answer(answer, "false_pass_theoretical"), want.at(name + "pass"));
    expect_cut(of_answer(answer, "false_fail_theoretical"), want.at(name + "fail"));
  }
  EXPECT_GT(cuts * 2, sets.size());
}

}  // namespace
}  // namespace seldinger::assessment::statistics
