// Quantum noise is Poisson's in mean, variance and every probability, independent between pixels, frames and seeds,
// and the same in any order.
#include "sim/imaging/noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>
#include <vector>

#include "sim/base/hash.h"

namespace seldinger::imaging {
namespace {

constexpr int kPixels = 1'000'000;

std::vector<float> counts_of(float mean, std::uint64_t seed = 7, std::uint64_t frame = 3, float electronic = 0.0F) {
  const std::vector<float> means(kPixels, mean);
  std::vector<float> counts(kPixels);
  noisy_counts(means.data(), kPixels, noise_key(seed, frame), 0, electronic, counts.data());
  return counts;
}

struct Moments {
  double mean = 0.0, variance = 0.0;
};
Moments moments_of(const std::vector<float>& values) {
  Moments m;
  for (const float v : values) m.mean += static_cast<double>(v);
  m.mean /= static_cast<double>(values.size());
  for (const float v : values) m.variance += (static_cast<double>(v) - m.mean) * (static_cast<double>(v) - m.mean);
  m.variance /= static_cast<double>(values.size());
  return m;
}

TEST(Noise, MeanAndVarianceArePoissons) {
  for (const float mean : {0.0F, 0.1F, 1.0F, 5.0F, 15.9F, 16.0F, 50.0F, 300.0F, 1e5F, 1e7F}) {
    const Moments m = moments_of(counts_of(mean));
    const double l = static_cast<double>(mean);
    EXPECT_NEAR(m.mean, l, 3.0 * std::sqrt(l / kPixels)) << mean;
    // Fourth central moment λ + 3λ².
    EXPECT_NEAR(m.variance, l, 3.0 * std::sqrt((l + 2.0 * l * l) / kPixels)) << mean;
  }
}

TEST(Noise, ElectronicNoiseAddsItsVariance) {
  for (const float mean : {0.0F, 3.0F, 30.0F, 1000.0F}) {
    const Moments m = moments_of(counts_of(mean, 7, 3, 2.0F));
    const double l = static_cast<double>(mean), variance = l + 4.0;
    EXPECT_NEAR(m.mean, l, 3.0 * std::sqrt(variance / kPixels)) << mean;
    EXPECT_NEAR(m.variance, variance, 3.0 * std::sqrt((l + 2.0 * variance * variance) / kPixels)) << mean;
  }
}

// χ² of all counts that are expected at least 20 times; both ways of drawing.
TEST(Noise, EveryCountHasPoissonsProbability) {
  for (const float mean : {0.5F, 5.0F, 15.0F, 17.0F, 40.0F}) {
    std::vector<double> histogram(400, 0.0);
    for (const float count : counts_of(mean)) {
      ASSERT_GE(count, 0.0F);
      ASSERT_EQ(count, std::floor(count));
      ASSERT_LT(count, 400.0F);
      ++histogram[static_cast<std::size_t>(count)];
    }
    double chi2 = 0.0;
    int cells = 0;
    for (std::size_t k = 0; k < histogram.size(); ++k) {
      const double l = static_cast<double>(mean), n = static_cast<double>(k);
      const double expected = kPixels * std::exp(n * std::log(l) - l - std::lgamma(n + 1.0));
      if (expected < 20.0) continue;
      chi2 += (histogram[k] - expected) * (histogram[k] - expected) / expected;
      ++cells;
    }
    // The expansion is not exact just above its border: 1e6 draws begin to see it, a picture does not.
    const double slack = mean >= kInversionMean ? 2.0 : 1.0;
    EXPECT_LT(chi2, slack * (cells + 4.0 * std::sqrt(2.0 * cells))) << mean << ' ' << cells;
  }
}

double correlation(const std::vector<float>& a, const std::vector<float>& b, int shift) {
  const Moments ma = moments_of(a), mb = moments_of(b);
  double sum = 0.0;
  const int n = kPixels - shift;
  for (int i = 0; i < n; ++i)
    sum += (static_cast<double>(a[static_cast<std::size_t>(i)]) - ma.mean) *
           (static_cast<double>(b[static_cast<std::size_t>(i + shift)]) - mb.mean);
  return sum / n / std::sqrt(ma.variance * mb.variance);
}

TEST(Noise, PixelsFramesAndSeedsAreIndependent) {
  constexpr double kThreeSigma = 3.0 / 1000.0;
  const auto base = counts_of(200.0F), next_frame = counts_of(200.0F, 7, 4), next_seed = counts_of(200.0F, 8, 3);
  for (const int shift : {1, 2, 511, 512, 513, 4096})
    EXPECT_NEAR(correlation(base, base, shift), 0.0, kThreeSigma) << shift;
  for (const int shift : {0, 1, 512}) {
    EXPECT_NEAR(correlation(base, next_frame, shift), 0.0, kThreeSigma) << shift;
    EXPECT_NEAR(correlation(base, next_seed, shift), 0.0, kThreeSigma) << shift;
  }
}

TEST(Noise, TheSameInAnyPieces) {
  std::vector<float> means(5000), whole(5000), pieces(5000);
  for (std::size_t i = 0; i < means.size(); ++i) means[i] = static_cast<float>(i % 97) * 0.7F;
  const NoiseKey key = noise_key(11, 22);
  for (const float electronic : {0.0F, 1.5F}) {
    noisy_counts(means.data(), 5000, key, 100, electronic, whole.data());
    for (int first = 0, size = 1; first < 5000; first += size, size = size % 611 + 7)
      noisy_counts(means.data() + first, std::min(size, 5000 - first), key,
                   100U + static_cast<std::uint32_t>(first), electronic, pieces.data() + first);
    EXPECT_EQ(std::memcmp(whole.data(), pieces.data(), whole.size() * sizeof(float)), 0) << electronic;
  }
}

// The bits themselves, so that another machine or compiler that differs is seen.
TEST(Noise, BitsAreTheSameEverywhere) {
  std::vector<float> means(4096), counts(4096);
  for (std::size_t i = 0; i < means.size(); ++i) means[i] = 0.05F * static_cast<float>(i);
  noisy_counts(means.data(), 4096, noise_key(1, 2), 0, 0.0F, counts.data());
  EXPECT_EQ(base::hash_bytes(std::as_bytes(std::span(counts))), 9985278171265858556U);
  noisy_counts(means.data(), 4096, noise_key(1, 2), 0, 2.0F, counts.data());
  EXPECT_EQ(base::hash_bytes(std::as_bytes(std::span(counts))), 14190267365307160282U);
}

// Rounding may leave the sum of all probabilities below the largest u: no count may run away there.
TEST(Noise, NoCountRunsAway) {
  for (const float mean : {0.01F, 0.1F, 1.0F, 8.0F}) {
    float largest = 0.0F;
    for (std::uint64_t frame = 0; frame < 30; ++frame)
      for (const float count : counts_of(mean, 99, frame)) largest = std::max(largest, count);
    // 3e7 draws; 2e-10 of probability lies beyond.
    double beyond = 1.0;
    float bound = -1.0F;
    for (double k = 0.0, l = static_cast<double>(mean); beyond > 2e-10; k += 1.0) {
      beyond -= std::exp(k * std::log(l) - l - std::lgamma(k + 1.0));
      bound = static_cast<float>(k);
    }
    EXPECT_LE(largest, bound) << mean;
  }
}

TEST(Noise, NothingAndNaN) {
  const float means[] = {0.0F, -1.0F, NAN, INFINITY, 1e30F};
  float counts[5];
  noisy_counts(means, 5, noise_key(1, 1), 0, 0.0F, counts);
  EXPECT_EQ(counts[0], 0.0F);
  EXPECT_EQ(counts[1], 0.0F);
  EXPECT_TRUE(std::isnan(counts[2]));
  EXPECT_FALSE(std::isfinite(counts[3]));
  EXPECT_NEAR(counts[4] / 1e30F, 1.0F, 1e-6F);
}

}  // namespace
}  // namespace seldinger::imaging
