// Tolerance factors against published tables.
#include "assessment/grading/tolerance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/rng.h"

namespace seldinger::assessment {
namespace {

TEST(ToleranceTest, FactorsAreThoseOfTheTables) {
  // The handbook's example: n = 43, 90 %, 99 %.
  EXPECT_NEAR(tolerance_factor(43, 0.90, 0.99), 2.217, 1e-3);
  // Two-sided, 90 % with 95 %: Eisenhart, Hastay and Wallis, Techniques of Statistical Analysis, 1947, table 2.1.
  const std::pair<std::size_t, double> table[] = {{8, 3.136},  {9, 2.967},  {10, 2.839}, {12, 2.655}, {15, 2.480},
                                                  {20, 2.310}, {30, 2.140}, {50, 1.996}, {100, 1.874}};
  for (const auto& [n, k] : table) EXPECT_NEAR(tolerance_factor(n, 0.9, 0.95), k, 0.002) << n;
}

TEST(ToleranceTest, TheIntervalHoldsWhatItPromises) {
  // 20,000 standards of eight consultants each: in 95 % of them 90 % of a normal population lie within mean ± k sd.
  constexpr std::size_t kPeople = 8;
  constexpr int kStandards = 20'000;
  const double k = tolerance_factor(kPeople, 0.9, 0.95);
  base::Rng rng(1);
  int held = 0;
  for (int i = 0; i < kStandards; ++i) {
    double sum = 0.0, squares = 0.0;
    for (std::size_t person = 0; person < kPeople; ++person) {
      const double value = rng.normal();
      sum += value;
      squares += value * value;
    }
    const double mean = sum / kPeople, sd = std::sqrt((squares - sum * mean) / (kPeople - 1.0));
    const auto below = [](double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); };
    held += below(mean + k * sd) - below(mean - k * sd) >= 0.9 ? 1 : 0;
  }
  EXPECT_NEAR(held / double{kStandards}, 0.95, 0.01);
}

TEST(ToleranceTest, OfManyItIsTheNormalQuantile) {
  EXPECT_NEAR(tolerance_factor(1'000'000, 0.9, 0.95), 1.64485, 0.003);
  EXPECT_GT(tolerance_factor(2, 0.9, 0.95), 18.0) << "two people tell next to nothing";
}

}  // namespace
}  // namespace seldinger::assessment
