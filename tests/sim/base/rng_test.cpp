// Tests of the counter-based random numbers: uniform, normal, independent of the order in which they are drawn.
#include "sim/base/rng.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace seldinger::base {
namespace {

constexpr int kNumbers = 400000;

// Bounds of five standard errors: a sound generator fails once in two million tries, and the seeds are fixed.
constexpr double kSigmas = 5.0;

TEST(Rng, uniform_numbers_lie_in_the_unit_interval_and_fill_it_evenly) {
  constexpr std::size_t kBins = 100;
  for (const std::uint64_t seed : {0ULL, 1ULL, 2ULL, 0xffffffffffffffffULL}) {
    std::array<int, kBins> bins{};
    double sum = 0.0;
    for (std::uint64_t n = 0; n < kNumbers; ++n) {
      const double u = uniform_at(seed, n);
      ASSERT_TRUE(u >= 0.0 && u < 1.0);
      ++bins[static_cast<std::size_t>(u * kBins)];
      sum += u;
    }
    double chi2 = 0.0;
    constexpr double kExpected = static_cast<double>(kNumbers) / kBins;
    for (const int count : bins) chi2 += (count - kExpected) * (count - kExpected) / kExpected;
    EXPECT_NEAR(chi2, kBins - 1.0, kSigmas * std::sqrt(2.0 * (kBins - 1.0)));
    EXPECT_NEAR(sum / kNumbers, 0.5, kSigmas / std::sqrt(12.0 * kNumbers));
  }
}

// A function, as a lambda would be constexpr and worked out by the compiler, for half a minute.
template <class A, class B>
double correlation(A a, B b) {
  double sum = 0.0;
  for (std::uint64_t n = 0; n < kNumbers; ++n) sum += (a(n) - 0.5) * (b(n) - 0.5);
  return 12.0 * sum / kNumbers;
}

TEST(Rng, successive_numbers_and_neighbouring_seeds_are_uncorrelated) {
  const auto of = [](std::uint64_t seed, std::uint64_t step) {
    return [=](std::uint64_t n) { return uniform_at(seed, n + step); };
  };
  const double bound = kSigmas / std::sqrt(static_cast<double>(kNumbers));
  EXPECT_NEAR(correlation(of(1, 0), of(1, 1)), 0.0, bound);
  EXPECT_NEAR(correlation(of(1, 0), of(1, 2)), 0.0, bound);
  EXPECT_NEAR(correlation(of(1, 0), of(2, 0)), 0.0, bound);
  EXPECT_NEAR(correlation(of(0, 0), of(1ULL << 63, 0)), 0.0, bound);
}

TEST(Rng, normal_numbers_have_the_moments_and_tails_of_the_standard_normal) {
  double sum = 0.0, squares = 0.0, cubes = 0.0, fourths = 0.0;
  int beyond_one = 0, beyond_three = 0;
  for (std::uint64_t n = 0; n < kNumbers; ++n) {
    const double x = normal_at(7, n);
    ASSERT_TRUE(std::isfinite(x));
    sum += x;
    squares += x * x;
    cubes += x * x * x;
    fourths += x * x * x * x;
    beyond_one += std::abs(x) > 1.0 ? 1 : 0;
    beyond_three += std::abs(x) > 3.0 ? 1 : 0;
  }
  const double root = std::sqrt(static_cast<double>(kNumbers));
  EXPECT_NEAR(sum / kNumbers, 0.0, kSigmas / root);
  EXPECT_NEAR(squares / kNumbers, 1.0, kSigmas * std::sqrt(2.0) / root);
  EXPECT_NEAR(cubes / kNumbers, 0.0, kSigmas * std::sqrt(15.0) / root);
  EXPECT_NEAR(fourths / kNumbers, 3.0, kSigmas * std::sqrt(96.0) / root);
  const auto bound = [&](double p) { return kSigmas * std::sqrt(p * (1.0 - p)) / root; };
  const double p1 = std::erfc(1.0 / std::sqrt(2.0)), p3 = std::erfc(3.0 / std::sqrt(2.0));
  EXPECT_NEAR(static_cast<double>(beyond_one) / kNumbers, p1, bound(p1));
  EXPECT_NEAR(static_cast<double>(beyond_three) / kNumbers, p3, bound(p3));
}

TEST(Rng, a_number_does_not_depend_on_which_were_drawn_before) {
  std::vector<double> forwards, backwards;
  for (std::uint64_t n = 0; n < 1000; ++n) forwards.push_back(normal_at(3, n));
  for (std::uint64_t n = 1000; n > 0; --n) backwards.push_back(normal_at(3, n - 1));
  EXPECT_TRUE(std::equal(forwards.begin(), forwards.end(), backwards.rbegin()));
  static_assert(uniform_at(3, 500) == uniform_at(3, 500));
}

TEST(Rng, two_generators_of_one_seed_agree_and_of_two_seeds_do_not) {
  Rng a(5), b(5), c(6);
  int equal = 0;
  for (int n = 0; n < 1000; ++n) {
    const double from_a = n % 3 == 0 ? a.normal() : a.uniform();
    const double from_b = n % 3 == 0 ? b.normal() : b.uniform();
    const double from_c = n % 3 == 0 ? c.normal() : c.uniform();
    EXPECT_EQ(from_a, from_b);
    equal += from_a == from_c ? 1 : 0;
  }
  EXPECT_EQ(equal, 0);
}

TEST(Rng, uniform_and_normal_draws_of_one_generator_are_uncorrelated) {
  Rng rng(8);
  double sum = 0.0;
  for (int n = 0; n < kNumbers; ++n) {
    const double u = rng.uniform();
    sum += (u - 0.5) * rng.normal();
  }
  EXPECT_NEAR(sum * std::sqrt(12.0) / kNumbers, 0.0, kSigmas / std::sqrt(static_cast<double>(kNumbers)));
}

TEST(Rng, every_bit_is_set_half_of_the_time) {
  Rng rng(9);
  std::array<int, 64> set{};
  constexpr int kWords = 100000;
  for (int n = 0; n < kWords; ++n) {
    const std::uint64_t bits = rng.bits();
    for (unsigned bit = 0; bit < 64; ++bit) set[bit] += static_cast<int>((bits >> bit) & 1U);
  }
  for (const int count : set)
    EXPECT_NEAR(static_cast<double>(count) / kWords, 0.5, kSigmas * 0.5 / std::sqrt(kWords));
}

}  // namespace
}  // namespace seldinger::base
