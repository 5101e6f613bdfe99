// Livingston and Lewis' decisions: R's integrals over a beta distribution, simulated persons, and what cannot be.
#include "assessment/statistics/standards/livingston_lewis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "assessment/statistics/distributions.h"
#include "sim/base/rng.h"
#include "tests/assessment/statistics/r_oracle.h"

namespace seldinger::assessment::statistics {
namespace {

BetaScores drawn(base::Rng& rng) {
  const double low = 10.0 * rng.normal(), range = 5.0 + 95.0 * rng.uniform();
  BetaScores of;
  of.low = low;
  of.high = low + range;
  of.mean = low + range * (0.3 + 0.4 * rng.uniform());
  of.sd = range * (0.08 + 0.1 * rng.uniform());
  of.reliability = 0.5 + 0.45 * rng.uniform();
  of.cut = of.mean + of.sd * rng.normal();
  return of;
}

TEST(LivingstonLewis, IsRsIntegralOverABetaDistribution) {
  SELDINGER_NEEDS_R();
  base::Rng rng(fixtures::r_seed() + 5);
  std::ostringstream script;
  script.precision(17);
  script << R"(
ll <- function(i, m, s, lo, hi, r, cut) {
  n <- round(((m - lo) * (hi - m) - r * s^2) / (s^2 * (1 - r)))
  mu <- (m - lo) / (hi - lo); v <- r * s^2 / (hi - lo)^2
  k <- mu * (1 - mu) / v - 1; a <- mu * k; b <- (1 - mu) * k
  c0 <- min(1, max(0, (cut - lo) / (hi - lo))); need <- ceiling(c0 * n - 1e-9)
  p <- function(t) pbinom(need - 1, n, t, lower.tail = FALSE)
  over <- function(f, from, to) if (to > from) integrate(function(t) f(t) * dbeta(t, a, b), from, to,
                                                         rel.tol = 1e-9, subdivisions = 2000)$value else 0
  say(paste0("n", i), n)
  say(paste0("pass", i), over(p, 0, c0) + over(p, c0, 1))
  say(paste0("cons", i), over(function(t) p(t)^2 + (1 - p(t))^2, 0, c0) + over(function(t) p(t)^2 + (1 - p(t))^2, c0, 1))
  say(paste0("fp", i), over(p, 0, c0))
  say(paste0("ff", i), over(function(t) 1 - p(t), c0, 1))
}
)";
  std::vector<BetaScores> all;
  for (std::size_t i = 0; i < fixtures::r_sets(); ++i) {
    const BetaScores of = drawn(rng);
    all.push_back(of);
    script << "ll(" << i << "," << of.mean << "," << of.sd << "," << of.low << "," << of.high << ","
           << of.reliability << "," << of.cut << ")\n";
  }
  auto said = fixtures::r_values(script.str());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto got = livingston_lewis_of(all[i]);
    const std::string k = std::to_string(i);
    ASSERT_TRUE(got.has_value()) << i;
    EXPECT_EQ(std::round(effective_length(all[i])), said["n" + k]);
    fixtures::note_difference(got->consistency, said["cons" + k]);
    fixtures::note_difference(got->false_pass, said["fp" + k]);
    EXPECT_NEAR(got->pass, said["pass" + k], 1e-5);
    EXPECT_NEAR(got->consistency, said["cons" + k], 1e-5);
    EXPECT_NEAR(got->false_pass, said["fp" + k], 1e-5);
    EXPECT_NEAR(got->false_fail, said["ff" + k], 1e-5);
    EXPECT_NEAR(got->accuracy + got->false_pass + got->false_fail, 1.0, 1e-12);
  }
}

// Persons drawn, each tested twice.
TEST(LivingstonLewis, IsWhatHappensToSimulatedPersons) {
  constexpr int kPersons = 100'000, kItems = 20;
  constexpr double kA = 6.0, kB = 3.0, kCut = 0.6;
  base::Rng rng(4);
  int alike = 0, falsely_passed = 0, falsely_failed = 0;
  for (int i = 0; i < kPersons; ++i) {
    const double truly = beta_quantile(rng.uniform(), kA, kB);
    const auto test = [&] {
      int right = 0;
      for (int k = 0; k < kItems; ++k) right += rng.uniform() < truly ? 1 : 0;
      return right >= 12;
    };
    const bool one = test(), other = test();
    alike += one == other ? 1 : 0;
    falsely_passed += one && truly < kCut ? 1 : 0;
    falsely_failed += !one && truly >= kCut ? 1 : 0;
  }
  // Scores are shares of the items: their variance is that of true scores and the items'.
  const double mean = kA / (kA + kB), true_variance = mean * (1.0 - mean) / (kA + kB + 1.0);
  const double variance = true_variance + (mean * (1.0 - mean) - true_variance) / kItems;
  const BetaScores of{mean, std::sqrt(variance), 0.0, 1.0, true_variance / variance, kCut};
  EXPECT_NEAR(effective_length(of), kItems, 1e-6);
  const auto got = livingston_lewis_of(of);
  ASSERT_TRUE(got.has_value());
  const auto near = [&](double share, int count) {
    EXPECT_NEAR(share, count / static_cast<double>(kPersons), 3.0 * std::sqrt(share * (1.0 - share) / kPersons));
  };
  near(got->consistency, alike);
  near(got->false_pass, falsely_passed);
  near(got->false_fail, falsely_failed);
}

TEST(LivingstonLewis, RefusesWhatCannotBe) {
  EXPECT_FALSE(livingston_lewis_of({0.5, 0.6, 0.0, 1.0, 0.8, 0.5}).has_value()) << "it varies more than can be";
  EXPECT_FALSE(livingston_lewis_of({1.5, 0.1, 0.0, 1.0, 0.8, 0.5}).has_value()) << "the mean lies outside";
  CutScores scores{{0.2, 0.9, 0.4, 0.6, 0.7, 0.5}, 0, 0.5, 0.7, true, Interval{0.0, 1.0}};
  const Answer answer = classification(scores);
  ASSERT_TRUE(answer.estimable());
  EXPECT_FALSE(answer.ci95.has_value());
  scores.ends = Interval{0.3, 1.0};
  scores.scores = {-5.0, 9.0, -7.0, 8.0, 0.5};
  EXPECT_EQ(classification(scores).reason, "no_solution");
}

// Turned round, where lower is better, decisions are the same.
TEST(LivingstonLewis, HasNoSideOfItsOwn) {
  const std::vector<double> scores = {2.0, 3.5, 4.0, 5.5, 7.0, 6.0, 8.5, 4.5};
  std::vector<double> turned;
  for (const double one : scores) turned.push_back(10.0 - one);
  const Answer lower = classification({scores, 0, 5.0, 0.8, false, Interval{0.0, 10.0}});
  const Answer higher = classification({turned, 0, 5.0, 0.8, true, Interval{0.0, 10.0}});
  EXPECT_NEAR(lower.estimate.value(), higher.estimate.value(), 1e-12);
}

}  // namespace
}  // namespace seldinger::assessment::statistics
