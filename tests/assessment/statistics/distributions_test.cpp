// Distributions against R 4.2.2's, to twelve digits.
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
  expect_close(student_t_cdf(2.5, 7.3), 0.9801748826672);
  expect_close(student_t_quantile(0.975, 7.3), 2.3450667365477);
  expect_close(f_upper(4.1, 2, 27), 0.0278666561738);
  expect_close(chi_squared_upper(9.2, 4), 0.0562902801699);
  expect_close(noncentral_t_cdf(1.2, 10, 1.5), 0.3747884986966);
  expect_close(beta_quantile(0.025, 14, 3), 0.616523763150737);
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
