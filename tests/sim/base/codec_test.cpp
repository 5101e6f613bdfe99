// Tests of the lossless codec: round trips, and refusal of everything that is not one whole sound frame.
#include "sim/base/codec.h"

#include <gtest/gtest.h>

#include "sim/base/rng.h"

namespace seldinger::base {
namespace {

using Bytes = std::vector<std::byte>;

Bytes random_bytes(std::size_t size, std::uint64_t seed) {
  Rng rng(seed);
  Bytes bytes;
  for (std::size_t n = 0; n < size; ++n) bytes.push_back(static_cast<std::byte>(rng.bits() & 0xffU));
  return bytes;
}

Bytes repeating_bytes(std::size_t size) {
  Bytes bytes;
  for (std::size_t n = 0; n < size; ++n) bytes.push_back(static_cast<std::byte>(n % 7));
  return bytes;
}

void expect_damaged(const Bytes& packed, std::size_t max_bytes) {
  const auto result = decompress(packed, max_bytes);
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().code, "damaged");
}

TEST(Codec, what_goes_in_comes_out) {
  for (const Bytes& bytes : {Bytes{}, Bytes{std::byte{1}}, random_bytes(100000, 1), repeating_bytes(1000000)}) {
    const auto back = decompress(compress(bytes), bytes.size());
    ASSERT_TRUE(back.has_value());
    EXPECT_EQ(*back, bytes);
  }
}

TEST(Codec, repetition_becomes_small_and_noise_hardly_grows) {
  EXPECT_LT(compress(repeating_bytes(1000000)).size(), 1000U);
  EXPECT_LT(compress(random_bytes(100000, 2)).size(), 100100U);
}

TEST(Codec, the_same_bytes_give_the_same_frame) {
  EXPECT_EQ(compress(repeating_bytes(5000)), compress(repeating_bytes(5000)));
}

TEST(Codec, more_than_the_bound_is_refused) {
  const Bytes packed = compress(repeating_bytes(5000));
  EXPECT_TRUE(decompress(packed, 5000).has_value());
  expect_damaged(packed, 4999);
  expect_damaged(packed, 0);
}

TEST(Codec, every_truncation_is_refused) {
  const Bytes packed = compress(random_bytes(300, 3));
  for (std::size_t size = 0; size < packed.size(); ++size)
    expect_damaged(Bytes(packed.begin(), packed.begin() + static_cast<std::ptrdiff_t>(size)), 1000000);
}

TEST(Codec, anything_behind_the_frame_is_refused) {
  const Bytes packed = compress(random_bytes(300, 4));
  const Bytes skippable{std::byte{0x50}, std::byte{0x2a}, std::byte{0x4d}, std::byte{0x18},  // RFC 8878 §3.1.2
                        std::byte{0},    std::byte{0},    std::byte{0},    std::byte{0}};
  for (const Bytes& behind : {Bytes{std::byte{0}}, compress({}), skippable, packed}) {
    Bytes longer = packed;
    longer.insert(longer.end(), behind.begin(), behind.end());
    expect_damaged(longer, 1000000);
  }
}

TEST(Codec, a_flipped_bit_never_changes_the_content_unseen) {
  for (const Bytes& bytes : {random_bytes(300, 5), repeating_bytes(3000)}) {
    Bytes packed = compress(bytes);
    std::size_t refused = 0;
    for (std::size_t bit = 0; bit < packed.size() * 8; ++bit) {
      packed[bit / 8] ^= static_cast<std::byte>(1U << (bit % 8));
      const auto back = decompress(packed, 1000000);
      EXPECT_TRUE(!back.has_value() || *back == bytes);
      refused += back.has_value() ? 0 : 1;
      packed[bit / 8] ^= static_cast<std::byte>(1U << (bit % 8));
    }
    EXPECT_GT(refused, packed.size() * 8 - 16);  // a few bits of the frame's header say nothing
  }
}

TEST(Codec, bytes_of_another_kind_are_refused) {
  expect_damaged({}, 100);
  expect_damaged(random_bytes(100, 6), 1000000);
  expect_damaged(Bytes(100, std::byte{0}), 1000000);
}

}  // namespace
}  // namespace seldinger::base
