// Tests of the 64-bit hash: published values of SplitMix64, avalanche, order, length, the signs of zero.
#include "sim/base/hash.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <vector>

namespace seldinger::base {
namespace {

std::vector<std::byte> bytes_of(std::initializer_list<int> values) {
  std::vector<std::byte> bytes;
  for (const int value : values) bytes.push_back(static_cast<std::byte>(value));
  return bytes;
}

TEST(Hash, mix64_gives_the_published_sequence_of_splitmix64) {
  // Seed 0: the generator adds the golden ratio and mixes.
  constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15ULL;
  static_assert(mix64(0) == 0xe220a8397b1dcdafULL);
  static_assert(mix64(kGolden) == 0x6e789e6aa1b965f4ULL);
  static_assert(mix64(2 * kGolden) == 0x06c45d188009454fULL);
  static_assert(mix64(3 * kGolden) == 0xf88bb8a8724c81ecULL);
  EXPECT_EQ(mix64(4 * kGolden), 0x1b39896a51a8749bULL);
}

TEST(Hash, every_input_bit_flips_each_output_bit_half_of_the_time) {
  constexpr int kTries = 2000;
  for (unsigned in = 0; in < 64; ++in) {
    int flips[64] = {};
    for (std::uint64_t n = 0; n < kTries; ++n) {
      const std::uint64_t changed = hash_combine(n, n * 77) ^ hash_combine(n, (n * 77) ^ (std::uint64_t{1} << in));
      for (unsigned out = 0; out < 64; ++out) flips[out] += static_cast<int>((changed >> out) & 1U);
    }
    for (const int count : flips) EXPECT_NEAR(static_cast<double>(count) / kTries, 0.5, 0.08);  // 7 sigma
  }
}

TEST(Hash, zeros_of_either_sign_hash_equally_and_other_doubles_by_their_bits) {
  EXPECT_EQ(hash_combine(1, 0.0), hash_combine(1, -0.0));
  EXPECT_NE(hash_combine(1, 1.0), hash_combine(1, -1.0));
  EXPECT_NE(hash_combine(1, 1.0), hash_combine(1, std::nextafter(1.0, 2.0)));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(hash_combine(1, nan), hash_combine(1, nan));
}

TEST(Hash, combining_depends_on_the_order) {
  EXPECT_NE(hash_combine(hash_combine(0, 1.0), 2.0), hash_combine(hash_combine(0, 2.0), 1.0));
}

TEST(Hash, bytes_of_every_length_and_each_changed_bit_hash_differently) {
  std::set<std::uint64_t> hashes;
  std::vector<std::byte> zeros;
  for (int n = 0; n < 40; ++n, zeros.push_back(std::byte{0})) hashes.insert(hash_bytes(zeros));
  EXPECT_EQ(hashes.size(), 40U);
  for (std::size_t bit = 0; bit < zeros.size() * 8; ++bit) {
    zeros[bit / 8] ^= static_cast<std::byte>(1U << (bit % 8));
    hashes.insert(hash_bytes(zeros));
    zeros[bit / 8] ^= static_cast<std::byte>(1U << (bit % 8));
  }
  EXPECT_EQ(hashes.size(), 40U + 320U);
}

TEST(Hash, bytes_are_read_as_little_endian_words) {
  const auto bytes = bytes_of({1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
  std::uint64_t expected = hash_combine(5, std::uint64_t{10});
  expected = hash_combine(expected, std::uint64_t{0x0807060504030201});
  expected = hash_combine(expected, std::uint64_t{0x0a09});
  EXPECT_EQ(hash_bytes(bytes, 5), expected);
}

TEST(Hash, the_seed_changes_the_hash) {
  const auto bytes = bytes_of({1, 2, 3});
  EXPECT_NE(hash_bytes(bytes, 0), hash_bytes(bytes, 1));
  EXPECT_EQ(hash_bytes(bytes), hash_bytes(bytes, 0));
}

}  // namespace
}  // namespace seldinger::base
