// Alpha and omega against psych and factanal of R: R's `attitude`, a small questionnaire, random ones.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "assessment/statistics/reliability/alpha.h"
#include "assessment/statistics/reliability/omega.h"
#include "assessment/statistics/reliability/one_factor.h"
#include "tests/assessment/statistics/r_oracle.h"
#include "tests/assessment/statistics/reliability/score_tables.h"

namespace seldinger::assessment::statistics {
namespace {

using fixtures::number_of;

void expect_item(double got, double want, double tolerance = 1e-9) {
  fixtures::note_difference(got, want);
  EXPECT_LE(std::abs(got - want), tolerance * std::abs(want)) << got << " for " << want;
}

// R's `attitude`: Chatterjee and Price, Regression Analysis by Example, 1977.
const fixtures::Rows kAttitude = {
    {43, 51, 30, 39, 61, 92, 45}, {63, 64, 51, 54, 63, 73, 47}, {71, 70, 68, 69, 76, 86, 48},
    {61, 63, 45, 47, 54, 84, 35}, {81, 78, 56, 66, 71, 83, 47}, {43, 55, 49, 44, 54, 49, 34},
    {58, 67, 42, 56, 66, 68, 35}, {71, 75, 50, 55, 70, 66, 41}, {72, 82, 72, 67, 71, 83, 31},
    {67, 61, 45, 47, 62, 80, 41}, {64, 53, 53, 58, 58, 67, 34}, {67, 60, 47, 39, 59, 74, 41},
    {69, 62, 57, 42, 55, 63, 25}, {68, 83, 83, 45, 59, 77, 35}, {77, 77, 54, 72, 79, 77, 46},
    {81, 90, 50, 72, 60, 54, 36}, {74, 85, 64, 69, 79, 79, 63}, {65, 60, 65, 75, 55, 80, 60},
    {65, 70, 46, 57, 75, 85, 46}, {50, 58, 68, 54, 64, 78, 52}, {50, 40, 33, 34, 43, 64, 33},
    {64, 61, 52, 62, 66, 80, 41}, {53, 66, 52, 50, 63, 80, 37}, {40, 37, 42, 58, 50, 57, 49},
    {63, 54, 42, 48, 66, 75, 33}, {66, 77, 66, 63, 88, 76, 72}, {78, 75, 58, 74, 80, 78, 49},
    {48, 57, 44, 45, 51, 83, 38}, {85, 85, 71, 71, 77, 74, 55}, {82, 82, 39, 59, 64, 78, 39}};

const fixtures::Rows kQuestionnaire = {{4, 4, 5, 3}, {5, 4, 5, 5}, {3, 3, 3, 2}, {4, 5, 4, 4},
                                       {5, 5, 4, 5}, {2, 2, 2, 3}, {4, 3, 4, 4}, {5, 5, 4, 5}};

TEST(Alpha, OfAttitudeIsThatOfPsych) {
  const Answer answer = alpha(fixtures::scores(kAttitude), {});
  expect_item(*answer.estimate, .843142769565, 1e-11);
  expect_item(number_of(answer, "alpha_standardized"), .83908380303, 1e-10);
  expect_item(number_of(answer, "lambda2"), .851899713566, 1e-11);
  expect_item(number_of(answer, "lambda6"), .87521513736, 1e-10);
  EXPECT_NEAR(answer.ci95->low, .74, .005);
  EXPECT_NEAR(answer.ci95->high, .92, .005);
  expect_item(number_of(answer.rows[0], "alpha_if_dropped"), .809760206309, 1e-11);
  expect_item(number_of(answer.rows[5], "alpha_if_dropped"), .863872311446, 1e-11);
}

TEST(Alpha, OfASmallQuestionnaire) {
  const Answer answer = alpha(fixtures::scores(kQuestionnaire), {});
  expect_item(*answer.estimate, .906339468303, 1e-11);
  expect_item(answer.ci95->low, .72195650441, 1e-10);
  expect_item(answer.ci95->high, .978962345187, 1e-11);
  const double rest[] = {.963366101718, .785742517844, .695080362705, .728907044786};
  for (std::size_t j = 0; j < 4; ++j) expect_item(number_of(answer.rows[j], "item_rest_r"), rest[j], 1e-11);
}

TEST(Alpha, TurnsItemsRoundThatAreNamed) {
  fixtures::Rows turned = kQuestionnaire;
  for (auto& row : turned) row[1] = 6.0 - row[1];
  const Answer as_is = alpha(fixtures::scores(turned), {});
  EXPECT_LT(*as_is.estimate, 0.5);
  EXPECT_LT(number_of(as_is.rows[1], "item_rest_r"), 0.0);
  EXPECT_FALSE(as_is.notes.empty());
  const Answer reversed = alpha(fixtures::scores(turned), {1.0, 5.0, {"q2"}});
  expect_item(*reversed.estimate, .906339468303, 1e-11);
}

TEST(Alpha, ShowsANegativeOne) {
  const Answer answer = alpha(fixtures::scores({{1, 5}, {2, 4}, {3, 3.5}, {4, 2}, {5, 1.5}}), {});
  ASSERT_TRUE(answer.estimable());
  EXPECT_LT(*answer.estimate, -1.0);
}

TEST(Alpha, RefusesWithAReason) {
  EXPECT_EQ(alpha(fixtures::scores({{1, 2}, {2, 3}}), {}).reason, "too_few");
  EXPECT_EQ(alpha(fixtures::scores({{1}, {2}, {3}}), {}).reason, "too_few");
  EXPECT_EQ(alpha(fixtures::scores({{1, 2}, {1, 3}, {1, 5}}), {}).reason, "no_variation");
  EXPECT_EQ(alpha(fixtures::scores(kQuestionnaire), {1.0, 4.0, {}}).reason, "bad_value");
  EXPECT_EQ(alpha(fixtures::scores(kQuestionnaire), {{}, 5.0, {"q2"}}).reason, "bad_value");
  EXPECT_EQ(alpha(fixtures::scores(kQuestionnaire), {1.0, 5.0, {"q9"}}).reason, "bad_value");
}

TEST(Alpha, LeavesOutAnItemThatDoesNotVary) {
  fixtures::Rows rows = kQuestionnaire;
  for (auto& row : rows) row.push_back(3.0);
  const Answer answer = alpha(fixtures::scores(rows), {});
  expect_item(*answer.estimate, .906339468303, 1e-11);
  ASSERT_FALSE(answer.notes.empty());
  EXPECT_EQ(answer.notes.back(), "q5 does not vary and is left out.");
}

TEST(Omega, OfAttitudeIsThatOfPsych) {
  const Answer answer = omega(fixtures::scores(kAttitude), {}, 200, 1);
  expect_item(*answer.estimate, .840544816901, 1e-6);
  ASSERT_TRUE(answer.ci95);
  EXPECT_LT(answer.ci95->low, *answer.estimate);
  EXPECT_GT(answer.ci95->high, *answer.estimate);
  EXPECT_EQ(omega(fixtures::scores(kAttitude), {}, 200, 1).ci95, answer.ci95);
}

TEST(Omega, FindsTheFactorThatCorrelationsAreMadeOf) {
  // Loadings .9, .8, .7 and .6 make these correlations, exactly.
  SquareMatrix correlation(4);
  const double loadings[] = {.9, .8, .7, .6};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) correlation.at(i, j) = i == j ? 1.0 : loadings[i] * loadings[j];
  const auto factor = one_factor(correlation);
  ASSERT_TRUE(factor);
  for (std::size_t i = 0; i < 4; ++i) expect_item(factor->loadings[i], loadings[i], 1e-9);
  EXPECT_LE(factor->chi_squared_per_n, 1e-15);
}

TEST(Omega, RefusesWithAReason) {
  EXPECT_EQ(omega(fixtures::scores({{1, 2}, {2, 3}, {3, 1}, {4, 4}}), {}, 0, 1).reason, "too_few");
  EXPECT_EQ(omega(fixtures::scores({{1, 1, 2}, {2, 2, 3}, {3, 3, 1}, {4, 4, 7}}), {}, 0, 1).reason,
            "no_convergence");
}

// factanal stops early: with a small factr it goes on to where alpha and we are.
constexpr const char* kItemsOfR = R"(
suppressMessages(library(psych))
items <- function(name, m) {
  m <- as.data.frame(m[complete.cases(m), ]); p <- ncol(m)
  a <- suppressWarnings(psych::alpha(m, check.keys = FALSE, warnings = FALSE))
  say(paste0(name, 'alpha'), a$total$raw_alpha); say(paste0(name, 'std'), a$total$std.alpha)
  say(paste0(name, 'lambda6'), a$total[['G6(smc)']]); say(paste0(name, 'low'), a$feldt$lower.ci[1, 1])
  say(paste0(name, 'high'), a$feldt$upper.ci[1, 1])
  for (j in 1:p) { say(paste0(name, 'rest', j), a$item.stats$r.drop[j]); say(paste0(name, 'drop', j), a$alpha.drop$raw_alpha[j]) }
  R <- cor(m); o <- R; diag(o) <- 0
  say(paste0(name, 'lambda2'), (sum(o) + sqrt(p / (p - 1) * sum(o^2))) / sum(R))
  f <- try(factanal(m, 1, control = list(opt = list(factr = 1, pgtol = 0, maxit = 5000))), silent = TRUE)
  if (inherits(f, 'try-error')) { say(paste0(name, 'omega'), NA) } else {
    l <- f$loadings[, 1]; say(paste0(name, 'omega'), sum(l)^2 / (sum(l)^2 + sum(f$uniquenesses)))
    say(paste0(name, 'least'), min(f$uniquenesses))
    say(paste0(name, 'chi'), if (is.null(f$STATISTIC)) NA else f$STATISTIC) }
  f <- try(suppressWarnings(suppressMessages(fa(m, 1, fm = 'ml', rotate = 'none'))), silent = TRUE)
  if (inherits(f, 'try-error')) say(paste0(name, 'omega_psych'), NA) else {
    l <- f$loadings[, 1]; say(paste0(name, 'omega_psych'), sum(l)^2 / (sum(l)^2 + sum(f$uniquenesses))) }
}
)";

TEST(AlphaAndOmega, AreThoseOfR) {
  SELDINGER_NEEDS_R();
  std::string script = kItemsOfR;
  std::vector<fixtures::Rows> sets;
  for (std::size_t set = 0; set < fixtures::r_sets(); ++set) {
    base::Rng rng(fixtures::r_seed() + 2000 + set);
    const std::size_t n = 25 + static_cast<std::size_t>(60 * rng.uniform()), k = 4 + set % 5;
    sets.push_back(fixtures::random_scores(rng.bits(), n, k, 0.7 + rng.uniform(), 0.5, 1.0, set % 2 == 0));
    if (set % 3 == 0) sets.back()[2][1] = std::nan("");
    script += "m <- rbind(";
    for (std::size_t i = 0; i < n; ++i) script += (i > 0 ? "," : "") + fixtures::r_vector(sets.back()[i]);
    script += ")\nitems('s" + std::to_string(set) + "_', m)\n";
  }
  const std::map<std::string, double> want = fixtures::r_values(script);
  std::size_t omegas = 0;
  for (std::size_t set = 0; set < sets.size(); ++set) {
    SCOPED_TRACE(set);
    const std::string name = "s" + std::to_string(set) + "_";
    const Answer answer = alpha(fixtures::scores(sets[set]), {});
    expect_item(*answer.estimate, want.at(name + "alpha"));
    expect_item(answer.ci95->low, want.at(name + "low"), 1e-8);
    expect_item(answer.ci95->high, want.at(name + "high"));
    expect_item(number_of(answer, "alpha_standardized"), want.at(name + "std"));
    expect_item(number_of(answer, "lambda2"), want.at(name + "lambda2"));
    expect_item(number_of(answer, "lambda6"), want.at(name + "lambda6"));
    for (std::size_t j = 0; j < answer.rows.size(); ++j) {
      expect_item(number_of(answer.rows[j], "item_rest_r"), want.at(name + "rest" + std::to_string(j + 1)), 1e-8);
      expect_item(number_of(answer.rows[j], "alpha_if_dropped"), want.at(name + "drop" + std::to_string(j + 1)));
    }
    // An optimiser of R's that did not get there is no oracle.
    if (!std::isfinite(want.at(name + "omega"))) continue;
    ++omegas;
    const Answer one = omega(fixtures::scores(sets[set]), {}, 0, 1);
    ASSERT_TRUE(one.estimable());
    expect_item(*one.estimate, want.at(name + "omega"), 1e-6);
    if (want.at(name + "least") > 0.006) expect_item(*one.estimate, want.at(name + "omega_psych"), 1e-5);
    expect_item(*one.statistic, want.at(name + "chi"), 1e-6);
  }
  EXPECT_GE(omegas * 10, sets.size() * 9);
}

}  // namespace
}  // namespace seldinger::assessment::statistics
