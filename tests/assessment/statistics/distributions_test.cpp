// Distributions against R 4.2.2's, printed with seventeen digits, to twelve.
#include "assessment/statistics/distributions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace seldinger::assessment::statistics {
namespace {

void expect_close(double got, double want) {
  EXPECT_LE(std::abs(got - want), 1e-12 * std::abs(want)) << got;
}

TEST(Distributions, AreThoseOfR) {
  expect_close(student_t_cdf(2.5, 7.3), 0.98017488266719976);
  expect_close(student_t_quantile(0.975, 7.3), 2.3450667365477025);
  expect_close(f_upper(4.1, 2, 27), 0.027866656173847062);
  expect_close(chi_squared_upper(9.2, 4), 0.056290280169948102);
  expect_close(noncentral_t_cdf(1.2, 10, 1.5), 0.37478849869654757);
  expect_close(beta_quantile(0.025, 14, 3), 0.61652376315073654);
}

TEST(Distributions, QuantilesAreThoseOfTheTables) {
  // Abramowitz and Stegun, Handbook of Mathematical Functions, tables 26.5 and 26.8.
  EXPECT_NEAR(normal_quantile_of(0.95), 1.64485, 5e-6);
  EXPECT_NEAR(normal_quantile_of(0.025), -1.95996, 5e-6);
  EXPECT_NEAR(chi_squared_quantile_of(0.05, 1.0), 0.00393214, 5e-9);
  EXPECT_NEAR(chi_squared_quantile_of(0.05, 9.0), 3.32511, 5e-6);
  EXPECT_NEAR(chi_squared_quantile_of(0.95, 30.0), 43.773, 5e-4);
  // NIST/SEMATECH e-Handbook of Statistical Methods, 7.2.6.3.
  EXPECT_NEAR(chi_squared_quantile_of(0.01, 42.0), 23.650, 5e-4);
}

TEST(Distributions, AnswerNaNWhereTheyAreNotDefined) {
  EXPECT_TRUE(std::isnan(student_t_cdf(1.0, -1.0)));
  EXPECT_TRUE(std::isnan(f_quantile(2.0, 3.0, 4.0)));
  EXPECT_TRUE(std::isnan(normal_quantile_of(std::nan(""))));
}

TEST(Distributions, HypergeometricSharesAddUp) {
  double sum = 0.0;
  for (int k = 0; k <= 7; ++k) sum += hypergeometric_pdf(k, 12, 7, 30);
  EXPECT_NEAR(sum, 1.0, 1e-12);
}

}  // namespace
}  // namespace seldinger::assessment::statistics
