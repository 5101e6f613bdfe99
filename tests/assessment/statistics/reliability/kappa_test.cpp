// Kappa against psych of R: a published table, and random ratings.
#include "assessment/statistics/reliability/kappa.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/assessment/statistics/r_oracle.h"
#include "tests/assessment/statistics/reliability/score_tables.h"

namespace seldinger::assessment::statistics {
namespace {

using fixtures::number_of;

void expect_kappa(double got, double want, double tolerance) {
  fixtures::note_difference(got, want);
  EXPECT_LE(std::abs(got - want), tolerance) << got << " for " << want;
}

// Fleiss, Cohen and Everitt's shares of 200 subjects, as so many rows.
fixtures::Rows published_ratings() {
  const int counts[3][3] = {{88, 14, 18}, {10, 40, 10}, {2, 6, 12}};
  fixtures::Rows rows;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) rows.insert(rows.end(), static_cast<std::size_t>(counts[i][j]), {i + 1.0, j + 1.0});
  return rows;
}

TEST(Kappa, IsThatOfThePublishedTable) {
  const CompleteTable table = fixtures::scores(published_ratings());
  const Answer plain = kappa(table, KappaWeights::kNone), quadratic = kappa(table, KappaWeights::kQuadratic);
  expect_kappa(*plain.estimate, .491525423729, 1e-12);
  expect_kappa(plain.ci95->low, .391563702054, 1e-12);
  expect_kappa(plain.ci95->high, .591487145404, 1e-12);
  expect_kappa(*quadratic.estimate, .454545454545, 1e-12);
  // By the delta method in R, with numerical derivatives; psych 2.2.9 has .0643 here, from another formula.
  expect_kappa(number_of(quadratic, "se"), .06645348, 1e-6);
  EXPECT_EQ(plain.n, 200u);
  EXPECT_LT(*plain.p_value, 1e-12);
}

TEST(Kappa, OfTwoCategoriesHasOneValueForAllWeights) {
  const CompleteTable table = fixtures::scores({{0, 0}, {1, 1}, {0, 1}, {1, 1}, {1, 0}, {0, 0}, {1, 1}});
  const double plain = *kappa(table, KappaWeights::kNone).estimate;
  EXPECT_EQ(plain, *kappa(table, KappaWeights::kLinear).estimate);
  EXPECT_EQ(plain, *kappa(table, KappaWeights::kQuadratic).estimate);
}

TEST(Kappa, WeighsByTheCategoriesNumbers) {
  // 1 and 5 are four apart though nobody says 2, 3 or 4.
  const Answer gap = kappa(fixtures::scores({{1, 1}, {5, 5}, {1, 2}, {5, 5}, {1, 1}}), KappaWeights::kLinear);
  const Answer even = kappa(fixtures::scores({{1, 1}, {3, 3}, {1, 2}, {3, 3}, {1, 1}}), KappaWeights::kLinear);
  EXPECT_GT(*gap.estimate, *even.estimate);
}

TEST(Kappa, OfSeveralRatersIsLightsMean) {
  const Answer answer =
      kappa(fixtures::scores({{1, 1, 1}, {2, 2, 1}, {3, 3, 3}, {1, 2, 1}, {3, 3, 2}}), KappaWeights::kNone);
  ASSERT_EQ(answer.rows.size(), 3u);
  const double mean = (number_of(answer.rows[0], "kappa") + number_of(answer.rows[1], "kappa") +
                       number_of(answer.rows[2], "kappa")) /
                      3.0;
  expect_kappa(*answer.estimate, mean, 1e-15);
  ASSERT_TRUE(answer.ci95);
  EXPECT_LT(answer.ci95->low, mean);
  EXPECT_GT(answer.ci95->high, mean);
  // Who agree throughout differ from nobody: no subject's absence changes anything.
  EXPECT_FALSE(kappa(fixtures::scores({{1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {1, 1, 1}}), KappaWeights::kNone).ci95);
}

// Four raters who are right with a probability of .8, else any of three categories: a pair's kappa is .64.
TEST(Kappa, OfSeveralRatersLiesInItsInterval) {
  base::Rng rng(31);
  constexpr int kSets = 300;
  int covered = 0;
  for (int set = 0; set < kSets; ++set) {
    fixtures::Rows rows;
    for (int i = 0; i < 60; ++i) {
      const auto any = [&] { return std::floor(3.0 * rng.uniform()); };
      const double truth = any();
      auto& row = rows.emplace_back();
      for (int rater = 0; rater < 4; ++rater) row.push_back(rng.uniform() < 0.8 ? truth : any());
    }
    const Answer answer = kappa(fixtures::scores(rows), KappaWeights::kNone);
    covered += answer.ci95->low <= 0.64 && 0.64 <= answer.ci95->high ? 1 : 0;
  }
  EXPECT_NEAR(covered / static_cast<double>(kSets), 0.95, 3.0 * std::sqrt(0.95 * 0.05 / kSets) + 0.01);
}

// The jackknife in R, of psych's kappas.
TEST(Kappa, OfSeveralRatersHasRsJackknife) {
  SELDINGER_NEEDS_R();
  base::Rng rng(fixtures::r_seed() + 77);
  std::string script = R"(
suppressMessages(library(psych))
light <- function(m) { k <- ncol(m); v <- c()
  for (i in 1:(k - 1)) for (j in (i + 1):k) v <- c(v, cohen.kappa(m[, c(i, j)])$kappa); mean(v) }
)";
  std::vector<Answer> answers;
  for (int set = 0; set < 5; ++set) {
    fixtures::Rows rows;
    std::vector<double> flat;
    for (int i = 0; i < 30; ++i) {
      const double truth = std::floor(3.0 * rng.uniform());
      auto& row = rows.emplace_back();
      for (int rater = 0; rater < 3; ++rater)
        flat.push_back(row.emplace_back(rng.uniform() < 0.6 ? truth : std::floor(3.0 * rng.uniform())));
    }
    answers.push_back(kappa(fixtures::scores(rows), KappaWeights::kNone));
    const std::string k = std::to_string(set);
    script += "m <- matrix(" + fixtures::r_vector(flat) + ", ncol = 3, byrow = TRUE); n <- nrow(m)\n" +
              "j <- sapply(1:n, function(i) light(m[-i, ])); say(\"k" + k + "\", light(m))\n" + "say(\"s" + k +
              "\", sqrt((n - 1) / n * sum((j - mean(j))^2)))\n";
  }
  auto said = fixtures::r_values(script);
  for (std::size_t i = 0; i < answers.size(); ++i) {
    expect_kappa(*answers[i].estimate, said["k" + std::to_string(i)], 1e-9);
    expect_kappa(number_of(answers[i], "se"), said["s" + std::to_string(i)], 1e-9);
  }
}

TEST(Kappa, RefusesWithAReason) {
  EXPECT_EQ(kappa(fixtures::scores({{1, 1}, {1, 1}}), KappaWeights::kNone).reason, "no_variation");
  EXPECT_EQ(kappa(fixtures::scores({{1, 1.5}, {1, 1}}), KappaWeights::kNone).reason, "bad_value");
  EXPECT_EQ(kappa(fixtures::scores({{1, 1}}), KappaWeights::kNone).reason, "too_few");
  const Answer perfect = kappa(fixtures::scores({{1, 1}, {2, 2}, {3, 3}}), KappaWeights::kNone);
  EXPECT_EQ(*perfect.estimate, 1.0);
  EXPECT_FALSE(perfect.ci95);
}

// psych has estimate and interval of the unweighted and the quadratic kappa; the rest is Fleiss's formulas, in R.
constexpr const char* kKappaOfR = R"(
suppressMessages(library(psych))
ours <- function(a, b, power) {
  levels <- min(a, b):max(a, b); k <- length(levels); n <- length(a)
  p <- table(factor(a, levels), factor(b, levels)) / n
  w <- if (power == 0) diag(k) else 1 - (abs(outer(1:k, 1:k, '-')) / (k - 1))^power
  r <- rowSums(p); s <- colSums(p); e <- outer(r, s); po <- sum(w * p); pe <- sum(w * e)
  mean <- outer(as.vector(w %*% s), as.vector(t(w) %*% r), '+')
  v <- (sum(p * (w * (1 - pe) - mean * (1 - po))^2) - (po * pe - 2 * pe + po)^2) / (n * (1 - pe)^4)
  v0 <- (sum(e * (w - mean)^2) - pe^2) / (n * (1 - pe)^2)
  kappa <- (po - pe) / (1 - pe)
  c(kappa, sqrt(v), 2 * pnorm(-abs(kappa / sqrt(v0))))
}
)";

TEST(Kappa, IsThatOfR) {
  SELDINGER_NEEDS_R();
  std::string script = kKappaOfR;
  std::vector<fixtures::Rows> sets;
  for (std::size_t set = 0; set < fixtures::r_sets(); ++set) {
    base::Rng rng(fixtures::r_seed() + 1000 + set);
    sets.push_back(fixtures::random_scores(rng.bits(), 12 + set * 3, 2, 1.2 * rng.uniform(), 0.3, 0.8, true));
    std::vector<double> a, b;
    for (const auto& row : sets.back()) a.push_back(row[0]), b.push_back(row[1]);
    const std::string name = "s" + std::to_string(set) + "_";
    script += "a <- " + fixtures::r_vector(a) + "; b <- " + fixtures::r_vector(b) +
              "\nfor (power in 0:2) { o <- ours(a, b, power); for (i in 1:3) say(paste0('" + name +
              "', power, '_', i), o[i]) }\nk <- cohen.kappa(cbind(a, b), levels = min(a, b):max(a, b))\n" +
              "say('" + name + "plain', k$kappa); say('" + name + "quadratic', k$weighted.kappa); say('" + name +
              "low', k$confid[1, 1]); say('" + name + "var', k$var.kappa)\n";
  }
  const std::map<std::string, double> want = fixtures::r_values(script);
  for (std::size_t set = 0; set < sets.size(); ++set) {
    SCOPED_TRACE(set);
    const std::string name = "s" + std::to_string(set) + "_";
    const CompleteTable table = fixtures::scores(sets[set]);
    const KappaWeights weights[] = {KappaWeights::kNone, KappaWeights::kLinear, KappaWeights::kQuadratic};
    for (int power = 0; power < 3; ++power) {
      const Answer answer = kappa(table, weights[power]);
      const std::string of = name + std::to_string(power) + "_";
      expect_kappa(*answer.estimate, want.at(of + "1"), 1e-9);
      expect_kappa(number_of(answer, "se"), want.at(of + "2"), 1e-9);
      expect_kappa(*answer.p_value, want.at(of + "3"), 1e-9);
    }
    const Answer plain = kappa(table, KappaWeights::kNone);
    expect_kappa(*plain.estimate, want.at(name + "plain"), 1e-9);
    expect_kappa(*kappa(table, KappaWeights::kQuadratic).estimate, want.at(name + "quadratic"), 1e-9);
    expect_kappa(std::pow(number_of(plain, "se"), 2.0), want.at(name + "var"), 1e-9);
  }
}

}  // namespace
}  // namespace seldinger::assessment::statistics
