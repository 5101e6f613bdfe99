// The linear mixed model: lme4's sleepstudy, lmerTest on fresh unbalanced data, and what it refuses.
#include "assessment/statistics/growth/mixed_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <sstream>

#include "sim/base/rng.h"
#include "tests/assessment/statistics/growth/numbers_of.h"
#include "tests/assessment/statistics/growth/simulated_growth.h"
#include "tests/assessment/statistics/growth/sleepstudy.h"
#include "tests/assessment/statistics/r_oracle.h"

namespace seldinger::assessment::statistics {
namespace {

using fixtures::number_of;

void expect_near_share(double got, double want, double share, const std::string& what) {
  fixtures::note_difference(got, want);
  EXPECT_LE(std::abs(got - want), share * std::abs(want)) << what << ": " << got << " for " << want;
}

TEST(MixedModel, IsThatOfSleepstudy) {
  const Answer answer = mixed_model(fixtures::sleepstudy(), {});
  ASSERT_TRUE(answer.estimable());
  EXPECT_EQ(answer.n, 18u);
  expect_near_share(number_of(answer, "reml_criterion"), 1743.62827196, 1e-9, "criterion");
  expect_near_share(number_of(answer, "intercept", "estimate"), 251.4051048485, 1e-9, "intercept");
  expect_near_share(answer.estimate.value(), 10.4672859596, 1e-9, "slope");
  expect_near_share(number_of(answer, "sd_intercept"), 24.7406579950, 1e-5, "sd_intercept");
  expect_near_share(number_of(answer, "sd_slope"), 5.92213765890, 1e-5, "sd_slope");
  expect_near_share(number_of(answer, "correlation"), 0.0655512382, 1e-3, "correlation");
  expect_near_share(number_of(answer, "sd_residual"), 25.5917957217, 1e-5, "sd_residual");
  // lmerTest 3.1-3: both with 17 df, as the design is balanced.
  expect_near_share(number_of(answer, "x", "se"), 1.545790, 1e-5, "se");
  expect_near_share(answer.df.front(), 17.0, 1e-4, "df");
}

// Unbalanced, with missing values, two or three groups; each third set has too few occasions for a slope.
TEST(MixedModel, IsThatOfLmerTest) {
  SELDINGER_NEEDS_R();
  std::ostringstream script;
  script << "suppressMessages(library(lmerTest))\n"
            "tight <- lmerControl(optimizer = 'bobyqa', optCtrl = list(rhoend = 1e-10, maxfun = 1e5), "
            "calc.derivs = FALSE, check.conv.singular = 'ignore')\n";
  std::vector<DataTable> tables;
  base::Rng rng(fixtures::r_seed() + 51);
  for (std::size_t i = 0; i < fixtures::r_sets(); ++i) {
    const bool slopes = i % 3 != 2;
    tables.push_back(fixtures::unbalanced_growth(rng, 8 + rng.bits() % 20, slopes ? 9 : 3, 1 + i % 3));
    const std::string k = std::to_string(i);
    script << fixtures::r_table(tables.back()) << "m <- lmer(y ~ x" << (i % 3 > 0 ? " + g" : "") << " + ("
           << (slopes ? "1 + x" : "1") << " | s), d, control = tight)\nc <- summary(m)$coefficients\n"
           << "v <- as.data.frame(VarCorr(m))\nsay('crit" << k << "', REMLcrit(m))\nsay('singular" << k
           << "', isSingular(m))\nsay('b" << k << "', c[2, 1])\nsay('a" << k << "', c[1, 1])\nsay('se" << k
           << "', c[2, 2])\nsay('df" << k << "', c[2, 3])\nsay('p" << k << "', c[2, 5])\nsay('sd" << k
           << "', v$sdcor[1])\nsay('res" << k << "', sigma(m))\nsay('slope" << k << "', v$sdcor[2])\nsay('last" << k
           << "', c[nrow(c), 1])\nsay('last_se" << k << "', c[nrow(c), 2])\nsay('last_df" << k
           << "', c[nrow(c), 3])\n";
  }
  const auto r = fixtures::r_values(script.str());
  std::size_t whole = 0;
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const Answer answer = mixed_model(tables[i], {});
    ASSERT_TRUE(answer.estimable());
    const bool slopes = i % 3 != 2;
    const auto want = [&](const char* name) { return r.at(name + std::to_string(i)); };
    const auto expect = [&](const char* name, double got, double share) {
      expect_near_share(got, want(name), share, name + std::to_string(i));
    };
    const bool singular = want("singular") == 1.0;
    EXPECT_LE(number_of(answer, "reml_criterion"), want("crit") + 1e-6 * std::abs(want("crit")));
    if (singular) continue;  // where lme4 may stop a little short
    ++whole;
    expect("crit", number_of(answer, "reml_criterion"), 1e-6);
    // A fixed effect near 0 is held to a share of its standard error, as it has no size of its own.
    const auto expect_fixed = [&](const char* name, double got, double se) {
      fixtures::note_difference(got, want(name));
      EXPECT_LE(std::abs(got - want(name)), 1e-5 * std::max(std::abs(want(name)), se))
          << name << i << ": " << got << " for " << want(name);
    };
    expect_fixed("a", number_of(answer, "intercept", "estimate"), 0.0);
    expect_fixed("b", answer.estimate.value(), want("se"));
    expect_fixed("last", answer.rows.back().values[0].value, want("last_se"));
    expect("sd", number_of(answer, "sd_intercept"), 1e-3);
    expect("res", number_of(answer, "sd_residual"), 1e-3);
    if (slopes) expect("slope", number_of(answer, "sd_slope"), 1e-3);
    expect("se", number_of(answer, "x", "se"), 1e-4);
    expect("df", answer.df.front(), 1e-3);
    expect("last_df", answer.rows.back().values[2].value, 1e-3);
    EXPECT_NEAR(answer.p_value.value(), want("p"), 1e-3 * want("p") + 1e-12);
  }
  EXPECT_GT(2 * whole, tables.size());
}

// A model of groups without x: with complete pairs its test is the paired t-test.
TEST(MixedModel, OfTwoConditionsIsThePairedTest) {
  DataTable table;
  table.values.push_back({"y", {}});
  base::Rng rng(8);
  std::vector<double> differences;
  for (int person = 0; person < 14; ++person) {
    const double level = 5.0 * rng.normal(), first = level + rng.normal(), second = level + 1.0 + rng.normal();
    differences.push_back(second - first);
    for (const double value : {first, second}) {
      table.values.front().values.push_back(value);
      table.subject.push_back(std::to_string(person));
      table.group.push_back(value == first ? "before" : "after");
      ++table.rows;
    }
  }
  double mean = 0.0, squares = 0.0;
  for (const double one : differences) mean += one / 14.0;
  for (const double one : differences) squares += (one - mean) * (one - mean) / 13.0;
  const Answer answer = mixed_model(table, {});
  ASSERT_TRUE(answer.estimable());
  EXPECT_NEAR(answer.estimate.value(), mean, 1e-9);
  EXPECT_NEAR(answer.statistic.value(), mean / std::sqrt(squares / 14.0), 1e-6);
  EXPECT_NEAR(answer.df.front(), 13.0, 1e-4);
  EXPECT_THAT(answer.notes, testing::Contains(testing::HasSubstr("with themselves")));
}

TEST(MixedModel, IsTheSameInOtherUnits) {
  const DataTable table = fixtures::sleepstudy();
  DataTable other = table;
  for (double& one : other.values.front().values) one = 1e4 + one / 1000.0;
  for (double& one : other.x) one = 45000.0 + 24.0 * one;
  const Answer a = mixed_model(table, {}), b = mixed_model(other, {});
  ASSERT_TRUE(a.estimable() && b.estimable());
  expect_near_share(b.estimate.value(), a.estimate.value() / 24000.0, 1e-7, "slope");
  expect_near_share(b.df.front(), a.df.front(), 1e-5, "df");
  expect_near_share(b.statistic.value(), a.statistic.value(), 1e-6, "t");
}

TEST(MixedModel, TellsSlopesOfGroupsApart) {
  base::Rng rng(12);
  DataTable table = fixtures::unbalanced_growth(rng, 30, 9, 2);
  for (std::size_t i = 0; i < table.rows; ++i)
    if (table.group[i] == "g1") table.values.front().values[i] += 3.0 * table.x[i];
  const Answer answer = mixed_model(table, {RandomEffects::as_data_allow, true});
  ASSERT_TRUE(answer.estimable());
  EXPECT_NEAR(number_of(answer, "x in g1", "estimate"), 3.0, 4.0 * number_of(answer, "x in g1", "se"));
  EXPECT_LT(number_of(answer, "x in g1", "p"), 1e-3);
}

TEST(MixedModel, SaysThatAFitIsSingular) {
  DataTable table;
  table.values.push_back({"y", {}});
  base::Rng rng(3);
  for (int i = 0; i < 40; ++i) {  // persons that do not differ, and differ less than chance lets them
    table.values.front().values.push_back((i % 4) * 2.0 + rng.normal());
    table.x.push_back(i / 10);
    table.subject.push_back(std::to_string(i % 10));
    ++table.rows;
  }
  for (int person = 0; person < 10; ++person) {
    double mean = 0.0;
    for (int k = 0; k < 4; ++k) mean += table.values.front().values[person + 10 * k] / 4.0;
    for (int k = 0; k < 4; ++k) table.values.front().values[person + 10 * k] -= mean;
  }
  const Answer answer = mixed_model(table, {RandomEffects::intercept, false});
  ASSERT_TRUE(answer.estimable());
  EXPECT_THAT(answer.notes, testing::Contains(testing::HasSubstr("singular")));
  EXPECT_EQ(number_of(answer, "sd_intercept"), 0.0);
  EXPECT_NEAR(answer.df.front(), 38.0, 1e-6);
}

TEST(MixedModel, RefusesWithReasons) {
  DataTable table = fixtures::sleepstudy();
  DataTable once = table;
  for (std::size_t i = 0; i < once.rows; ++i) once.subject[i] = std::to_string(i);
  EXPECT_EQ(mixed_model(once, {}).reason, "too_few");
  DataTable same = table;
  for (double& one : same.x) one = 4.0;
  EXPECT_EQ(mixed_model(same, {}).reason, "no_variation");
  DataTable exact = table;
  for (std::size_t i = 0; i < exact.rows; ++i) exact.values.front().values[i] = 3.0 + 2.0 * exact.x[i];
  EXPECT_EQ(mixed_model(exact, {}).reason, "no_convergence");
  DataTable follows = table;
  for (double x : follows.x) follows.group.push_back(x > 4.0 ? "late" : "early");
  for (std::size_t i = 0; i < follows.rows; ++i) follows.x[i] = follows.group[i] == "late" ? 1.0 : 0.0;
  EXPECT_EQ(mixed_model(follows, {}).reason, "no_convergence");
}

TEST(MixedModel, OfFiveHundredPeopleIsQuick) {
  base::Rng rng(2);
  const DataTable table = fixtures::unbalanced_growth(rng, 500, 40, 2);
  const auto begin = std::chrono::steady_clock::now();
  const Answer answer = mixed_model(table, {});
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  ASSERT_TRUE(answer.estimable());
  EXPECT_NEAR(answer.estimate.value(), -2.0, 5.0 * number_of(answer, "x", "se"));
  RecordProperty("seconds", std::to_string(seconds));
  EXPECT_LE(seconds, 20.0);  // 2 s is the promise: tests run beside others, and under the sanitizers
}

}  // namespace
}  // namespace seldinger::assessment::statistics
