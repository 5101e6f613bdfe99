// Tests of our own sin, cos, exp, log, atan, acos against libm, with the errors that the header claims.
#include "sim/base/exact_math.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "sim/base/exact_sines.h"
#include "sim/base/rng.h"

namespace seldinger::base {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kDraws = 200000;

double between(std::uint64_t seed, int n, double low, double high) {
  return low + (high - low) * uniform_at(seed, static_cast<std::uint64_t>(n));
}

// The largest error over draws in [low, high]; NaN as soon as one is NaN.
template <typename Ours, typename Theirs, typename Scale>
double worst(Ours ours, Theirs theirs, double low, double high, Scale scale) {
  double worst_error = 0.0;
  for (int n = 0; n < kDraws; ++n) {
    const double x = between(1, n, low, high);
    const double error = std::abs(ours(x) - theirs(x)) / scale(x);
    if (!(error <= worst_error)) worst_error = error;
    if (std::isnan(worst_error)) return worst_error;
  }
  return worst_error;
}

constexpr auto kAbsolute = [](double) { return 1.0; };
double libm_sin(double x) {
  return std::sin(x);
}
double libm_cos(double x) {
  return std::cos(x);
}
double libm_exp(double x) {
  return std::exp(x);
}
double libm_log(double x) {
  return std::log(x);
}
double libm_atan(double x) {
  return std::atan(x);
}
double libm_acos(double x) {
  return std::acos(x);
}

TEST(ExactMath, sine_and_cosine_are_within_1e_13_up_to_a_thousand_radians) {
  EXPECT_TRUE(worst(exact_sin, libm_sin, -1e3, 1e3, kAbsolute) < 1e-13);
  EXPECT_TRUE(worst(exact_cos, libm_cos, -1e3, 1e3, kAbsolute) < 1e-13);
  EXPECT_TRUE(worst(exact_sin, libm_sin, -kPi, kPi, kAbsolute) < 1e-15);
}

TEST(ExactMath, sine_and_cosine_hold_to_a_million_radians) {
  EXPECT_TRUE(worst(exact_sin, libm_sin, -1e6, 1e6, kAbsolute) < 1e-12);
  EXPECT_TRUE(worst(exact_cos, libm_cos, -1e6, 1e6, kAbsolute) < 1e-12);
}

// However many there are, and whichever quarter turns lie beside each other.
TEST(ExactMath, many_sines_have_the_bits_of_each) {
  for (const std::size_t count : {1U, 7U, 8U, 9U, 15U, 64U})
    for (int draw = 0; draw < 2000; ++draw) {
      std::vector<double> x, sines(count);
      for (std::size_t i = 0; i < count; ++i)
        x.push_back(between(9, draw * 64 + static_cast<int>(i), -1e3, 1e3) * (i % 3 == 0 ? 1e3 : 1.0));
      if (draw == 0) x[0] = 0.0;
      exact_sines(x, sines);
      for (std::size_t i = 0; i < count; ++i)
        ASSERT_EQ(std::bit_cast<std::uint64_t>(sines[i]), std::bit_cast<std::uint64_t>(exact_sin(x[i]))) << x[i];
    }
}

TEST(ExactMath, sine_and_cosine_hold_next_to_multiples_of_half_pi) {
  for (int n = -600; n <= 600; ++n)
    for (const double off : {0.0, 1e-300, 1e-12, -1e-12, 1e-5, kPi / 4, -kPi / 4}) {
      const double x = n * (kPi / 2) + off;
      EXPECT_TRUE(std::abs(exact_sin(x) - std::sin(x)) < 1e-13) << x;
      EXPECT_TRUE(std::abs(exact_cos(x) - std::cos(x)) < 1e-13) << x;
    }
}

TEST(ExactMath, sine_is_odd_cosine_is_even_and_their_squares_add_to_one) {
  for (int n = 0; n < 2000; ++n) {
    const double x = between(2, n, 0.0, 1e3);
    EXPECT_TRUE(std::abs(exact_sin(-x) + exact_sin(x)) < 1e-15);
    EXPECT_TRUE(std::abs(exact_cos(-x) - exact_cos(x)) < 1e-15);
    EXPECT_TRUE(std::abs(exact_sin(x) * exact_sin(x) + exact_cos(x) * exact_cos(x) - 1.0) < 1e-14);
  }
  EXPECT_EQ(exact_sin(0.0), 0.0);
  EXPECT_EQ(exact_cos(0.0), 1.0);
}

TEST(ExactMath, exponential_is_within_1e_14_of_its_value_over_its_range) {
  EXPECT_TRUE(worst(exact_exp, libm_exp, -700.0, 700.0, libm_exp) < 1e-14);
  EXPECT_TRUE(worst(exact_exp, libm_exp, -1.0, 1.0, libm_exp) < 1e-15);
  EXPECT_EQ(exact_exp(0.0), 1.0);
}

TEST(ExactMath, exponential_is_clamped_outside_its_range) {
  EXPECT_EQ(exact_exp(-1e6), exact_exp(-700.0));
  EXPECT_EQ(exact_exp(1e6), exact_exp(700.0));
  EXPECT_TRUE(std::isnormal(exact_exp(-1e300)) && std::isnormal(exact_exp(1e300)));
}

TEST(ExactMath, logarithm_is_within_1e_14_for_every_normal_number) {
  const auto scale = [](double x) { return std::max(1.0, std::abs(std::log(x))); };
  EXPECT_TRUE(worst(exact_log, libm_log, 0.1, 10.0, scale) < 1e-14);
  EXPECT_TRUE(worst(exact_log, libm_log, 1.0 - 1e-6, 1.0 + 1e-6, scale) < 1e-15);
  const auto of_any = [&](double exponent) { return std::exp2(exponent); };
  double worst_error = 0.0;
  for (int n = 0; n < kDraws; ++n) {
    const double x = of_any(between(3, n, -1021.9, 1023.9));
    const double error = std::abs(exact_log(x) - std::log(x)) / scale(x);
    if (!(error <= worst_error)) worst_error = error;
  }
  EXPECT_TRUE(worst_error < 1e-14);
  EXPECT_EQ(exact_log(1.0), 0.0);
  EXPECT_TRUE(std::abs(exact_log(std::numeric_limits<double>::min()) + 708.3964185322641) < 1e-11);
  EXPECT_TRUE(std::abs(exact_log(std::numeric_limits<double>::max()) - 709.782712893384) < 1e-11);
}

TEST(ExactMath, logarithm_undoes_the_exponential) {
  for (int n = 0; n < 2000; ++n) {
    const double x = between(4, n, -690.0, 690.0);
    EXPECT_TRUE(std::abs(exact_log(exact_exp(x)) - x) < 1e-13 * std::max(1.0, std::abs(x)));
  }
}

TEST(ExactMath, arc_tangent_is_within_1e_14_everywhere) {
  EXPECT_TRUE(worst(exact_atan, libm_atan, -3.0, 3.0, kAbsolute) < 1e-14);
  EXPECT_TRUE(worst(exact_atan, libm_atan, -1e5, 1e5, kAbsolute) < 1e-14);
  EXPECT_TRUE(std::abs(exact_atan(1.0) - kPi / 4) < 1e-15);
  EXPECT_TRUE(std::abs(exact_atan(1e308) - kPi / 2) < 1e-15);
  EXPECT_EQ(exact_atan(0.0), 0.0);
}

TEST(ExactMath, arc_cosine_is_within_1e_14_and_clamped) {
  EXPECT_TRUE(worst(exact_acos, libm_acos, -1.0, 1.0, kAbsolute) < 1e-14);
  for (double near = 1e-1; near > 1e-16; near *= 0.5) {
    EXPECT_TRUE(std::abs(exact_acos(1.0 - near) - std::acos(1.0 - near)) < 1e-14) << near;
    EXPECT_TRUE(std::abs(exact_acos(near - 1.0) - std::acos(near - 1.0)) < 1e-14) << near;
  }
  EXPECT_EQ(exact_acos(1.0), 0.0);
  EXPECT_EQ(exact_acos(1.5), 0.0);
  EXPECT_EQ(exact_acos(-1.0), kPi);
  EXPECT_EQ(exact_acos(-7.0), kPi);
}

// The point of these functions: the bits are known. A compiler or flag that changes them breaks every replay.
TEST(ExactMath, the_bits_are_those_of_every_machine) {
  std::uint64_t hash = 0;
  for (int n = 0; n < 1000; ++n) {
    const double x = between(5, n, -20.0, 20.0);
    for (const double value : {exact_sin(x), exact_cos(x), exact_exp(x), exact_log(std::abs(x) + 0.1),
                               exact_atan(x), exact_acos(x / 20.0)})
      hash = hash_combine(hash, value);
  }
  EXPECT_EQ(hash, 14415692039285708454ULL);
}

}  // namespace
}  // namespace seldinger::base
