// Multiple imputation: Rubin's rules by mice and by hand, what is drawn against R's regression, and how often its
// interval holds what is true where who is missing depends on what is known.
#include "assessment/statistics/relations/imputation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "sim/base/rng.h"
#include "tests/assessment/statistics/r_oracle.h"
#include "tests/assessment/statistics/relations/missing_values.h"
#include "tests/assessment/statistics/relations/tables_of.h"

namespace seldinger::assessment::statistics {
namespace {

using fixtures::kMissing;

DataTable two_groups_of(const std::vector<double>& a, const std::vector<double>& b) {
  DataTable table;
  table.values.push_back({"v", a});
  table.values.front().values.insert(table.values.front().values.end(), b.begin(), b.end());
  table.group.assign(a.size(), "a");
  table.group.insert(table.group.end(), b.size(), "b");
  table.rows = table.group.size();
  return table;
}

// By hand: mean 2, within 0.5, between 1, so total 0.5 + 4/3 and lost 8/11.
TEST(Imputation, RubinsRulesByHand) {
  const std::vector<double> estimates{1, 2, 3}, variances{0.4, 0.5, 0.6};
  const Pooled all = pooled(estimates, variances, 20.0);
  EXPECT_DOUBLE_EQ(all.estimate, 2.0);
  EXPECT_NEAR(all.total, 0.5 + 4.0 / 3.0, 1e-15);
  const double lost = (4.0 / 3.0) / all.total, seen = 21.0 / 23.0 * 20.0 * (1.0 - lost);
  EXPECT_NEAR(all.df, 1.0 / (lost * lost / 2.0 + 1.0 / seen), 1e-12);
}

TEST(Imputation, PoolsAsMice) {
  SELDINGER_NEEDS_R();
  std::ostringstream script;
  script << "have <- requireNamespace('mice', quietly = TRUE); say('have', have)\nif (have) {\n";
  std::vector<std::vector<double>> estimates, variances;
  std::vector<double> complete;
  base::Rng rng(fixtures::r_seed() + 81);
  for (std::size_t i = 0; i < fixtures::r_sets(); ++i) {
    const std::size_t m = 2 + rng.bits() % 30;
    std::vector<double> q, u;
    for (std::size_t k = 0; k < m; ++k) {
      q.push_back(rng.normal());
      u.push_back(0.2 + rng.uniform());
    }
    complete.push_back(5.0 + 100.0 * rng.uniform());
    script.precision(17);
    script << "p <- mice::pool.scalar(" << fixtures::r_vector(q) << ", " << fixtures::r_vector(u)
           << ", n = " << complete.back() << " + 1, k = 1)\nsay('t" << i << "', p$t)\nsay('df" << i << "', p$df)\n";
    estimates.push_back(std::move(q));
    variances.push_back(std::move(u));
  }
  const auto r = fixtures::r_values(script.str() + "}\n");
  if (r.at("have") == 0.0) GTEST_SKIP() << "R has no mice (Debian: r-cran-mice): no oracle to ask";
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    const Pooled all = pooled(estimates[i], variances[i], complete[i]);
    fixtures::note_difference(all.total, r.at("t" + std::to_string(i)));
    fixtures::note_difference(all.df, r.at("df" + std::to_string(i)));
    EXPECT_NEAR(all.total / r.at("t" + std::to_string(i)), 1.0, 1e-9) << i;
    EXPECT_NEAR(all.df / r.at("df" + std::to_string(i)), 1.0, 1e-9) << i;
  }
}

// The answer is what R makes of the tables that were drawn; with nobody missing it is Welch's.
TEST(Imputation, IsWelchOfWhatWasDrawnPooled) {
  SELDINGER_NEEDS_R();
  std::ostringstream script;
  std::vector<ImputedComparison> made;
  base::Rng rng(fixtures::r_seed() + 82);
  for (std::size_t i = 0; i < fixtures::r_sets(); ++i) {
    const DataTable table = fixtures::half_missing(rng, 12 + rng.bits() % 30, i % 2 == 0, i % 4 == 3 ? 0.0 : 0.3);
    made.push_back(imputed_comparison(table, ProcedureOptions({{"draws", "12"}, {"seed", std::to_string(i)}})));
    const ImputedComparison& one = made.back();
    ASSERT_TRUE(one.answer.estimable()) << one.answer.reason;
    script << "y <- " << fixtures::r_vector(table.values.front().values)
           << "; g <- rep(c('a', 'b'), each = " << table.rows / 2 << ")\nq <- u <- df <- c()\n";
    std::vector<double> rows;
    for (const std::size_t row : one.rows) rows.push_back(static_cast<double>(row + 1));
    for (const auto& drawn : one.draws)
      script << "y[" << fixtures::r_vector(rows) << "] <- " << fixtures::r_vector(drawn)
             << "\nt <- t.test(y[g == 'a'], y[g == 'b']); q <- c(q, t$estimate[1] - t$estimate[2]); u <- c(u, "
                "t$stderr^2); df <- c(df, t$parameter)\n";
    script << "w <- mean(u); b <- var(q); total <- w + (1 + 1 / 12) * b; lost <- 1 - w / total; v <- mean(df)\n"
           << "n <- if (lost < 1e-12) v else 1 / (lost^2 / 11 + (v + 3) / ((v + 1) * v * (1 - lost)))\nsay('q" << i
           << "', mean(q)); say('low" << i << "', mean(q) - qt(.975, n) * sqrt(total)); say('p" << i
           << "', 2 * pt(-abs(mean(q)) / sqrt(total), n))\n";
  }
  const auto r = fixtures::r_values(script.str());
  for (std::size_t i = 0; i < made.size(); ++i) {
    const auto want = [&](const char* name) { return r.at(name + std::to_string(i)); };
    fixtures::note_difference(*made[i].answer.estimate, want("q"));
    fixtures::note_difference(made[i].answer.ci95->low, want("low"));
    EXPECT_NEAR(*made[i].answer.estimate, want("q"), 1e-9 * (1.0 + std::abs(want("q")))) << i;
    EXPECT_NEAR(made[i].answer.ci95->low, want("low"), 1e-9 * (1.0 + std::abs(want("low")))) << i;
    EXPECT_NEAR(*made[i].answer.p_value, want("p"), 1e-9) << i;
  }
}

// A value drawn on a line is Student's t about R's prediction, with the error that R tells of a single new value.
TEST(Imputation, DrawsWhatTheRegressionLeavesPossible) {
  SELDINGER_NEEDS_R();
  base::Rng rng(5);
  const DataTable table = fixtures::half_missing(rng, 20, true, 0.7);
  std::vector<double> sums, squares;
  std::vector<std::size_t> rows;
  double n = 0.0;
  for (int seed = 0; seed < 60; ++seed) {
    const auto made =
        imputed_comparison(table, ProcedureOptions({{"draws", "500"}, {"seed", std::to_string(seed)}}));
    rows = made.rows;
    sums.resize(rows.size());
    squares.resize(rows.size());
    for (const auto& drawn : made.draws) {
      for (std::size_t k = 0; k < rows.size(); ++k) {
        sums[k] += drawn[k];
        squares[k] += drawn[k] * drawn[k];
      }
      n += 1.0;
    }
  }
  std::ostringstream script;
  script
      << "y <- " << fixtures::r_vector(table.values.front().values) << "; x <- " << fixtures::r_vector(table.x)
      << "; g <- rep(c('a', 'b'), each = 20)\nfor (w in c('a', 'b')) { m <- lm(y ~ x, subset = g == w)\n"
         "for (i in which(is.na(y) & g == w)) { p <- predict(m, data.frame(x = x[i]), se.fit = TRUE)\n"
         "say(paste0('mean', i), p$fit); say(paste0('var', i), (p$se.fit^2 + p$residual.scale^2) * p$df / (p$df - "
         "2)) } }\n";
  const auto r = fixtures::r_values(script.str());
  ASSERT_GT(rows.size(), 3U);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const std::string row = std::to_string(rows[k] + 1);
    const double mean = sums[k] / n, variance = squares[k] / n - mean * mean;
    EXPECT_NEAR(mean, r.at("mean" + row), 5.0 * std::sqrt(variance / n)) << row;
    EXPECT_NEAR(variance / r.at("var" + row), 1.0, 0.08) << row;
  }
}

// Among those with low x half are missing: who has a value says too much, and what is drawn given x does not.
TEST(Imputation, HoldsTheTruthWhereWhoHasAValueDoesNot) {
  base::Rng rng(7);
  const fixtures::Imputed found = fixtures::imputed_coverage(rng, 30, 400);
  EXPECT_GE(found.covered, 0.95 - 3.0 * std::sqrt(0.95 * 0.05 / 400.0));
  EXPECT_LT(std::abs(found.bias), 0.05);
  EXPECT_LT(found.covered_by_present, 0.90);
}

TEST(Imputation, OfNobodyMissingIsWelch) {
  const Answer answer = imputed(two_groups_of({1, 2, 3, 4, 7}, {2, 4, 6, 9, 5}), {});
  ASSERT_TRUE(answer.estimable());
  EXPECT_NEAR(*answer.estimate, 3.4 - 5.2, 1e-12);
  const double error = std::sqrt(5.3 / 5.0 + 6.7 / 5.0);
  EXPECT_NEAR(*answer.statistic, -1.8 / error, 1e-12);
  EXPECT_THAT(answer.notes, testing::Contains("Nobody lacks a value: nothing is drawn."));
}

TEST(Imputation, RefusesWithAReason) {
  EXPECT_EQ(imputed(two_groups_of({1, 2, 3, 4, kMissing}, {2, 4, 6, 9, 5}), {}).reason, "group_too_small");
  EXPECT_EQ(imputed(two_groups_of({1, 1, 1, 1, 1, kMissing}, {2, 4, 6, 9, 5}), {}).reason, "no_variation_within");
  EXPECT_EQ(imputed(two_groups_of({1, 2, 3, 4, 7}, {2, 4, 6, 9, 5}),
                    ProcedureOptions(std::map<std::string, std::string>{{"draws", "9"}}))
                .reason,
            "bad_value");
  // Whose x is not known is drawn from the group's level, and the answer says how many.
  DataTable table = two_groups_of({1, 2, 3, 4, 7, kMissing, kMissing}, {2, 4, 6, 9, 5, 6, 7});
  table.x = {1, 2, 3, 4, 7, 5, kMissing, 1, 2, 3, 4, 5, 6, 7};
  EXPECT_THAT(imputed(table, {}).notes, testing::Contains(testing::HasSubstr("1 of those without a value")));
}

}  // namespace
}  // namespace seldinger::assessment::statistics
