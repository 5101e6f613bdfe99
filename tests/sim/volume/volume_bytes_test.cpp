// Tests of stored volumes and labels: what goes in comes out bit for bit, and anything unsound is refused.
#include "sim/volume/volume_bytes.h"

#include <gtest/gtest.h>

#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "sim/base/codec.h"
#include "sim/base/hash.h"
#include "sim/base/rng.h"

namespace seldinger::volume {
namespace {

Volume oblique_volume() {
  const glm::dmat3 direction(glm::rotate(glm::dmat4(1.0), 0.3, glm::normalize(glm::dvec3(1.0, 2.0, -0.5))));
  Volume volume = make_volume({7, 5, 9}, {0.7, 0.8, 2.5}, direction, {-101.25, 33.0, -512.125});
  base::Rng rng(4);
  for (auto& hu : volume.hu) hu = static_cast<std::int16_t>(-1024.0 + 4000.0 * rng.uniform());
  volume.hu.front() = kAirHu;
  volume.hu.back() = std::numeric_limits<std::int16_t>::max();
  return volume;
}

LabelMap some_labels() {
  LabelMap labels;
  labels.names = {"none", "liver", "kidney"};
  for (int i = 0; i < 500; ++i) labels.label.push_back(static_cast<std::uint8_t>(i % 3));
  return labels;
}

// Writes a value into a stored header and mends the header's checksum, so that only the value itself can be
// refused.
template <typename T>
std::vector<std::byte> with_header_value(std::vector<std::byte> bytes, std::size_t header_bytes, std::size_t at,
                                         T value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
  const std::uint64_t checksum = base::hash_bytes(std::span(bytes).first(header_bytes - 8));
  std::memcpy(bytes.data() + header_bytes - 8, &checksum, sizeof checksum);
  return bytes;
}

constexpr std::size_t kVolumeHeaderBytes = 184, kLabelHeaderBytes = 32;
constexpr std::size_t kSizeAt = 8, kSpacingAt = 24, kMatrixAt = 48;

template <typename T>
void expect_damaged(const base::Result<T>& result) {
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().code, "damaged");
  EXPECT_FALSE(result.error().text.empty());
}

TEST(VolumeBytes, an_oblique_volume_comes_back_bit_for_bit) {
  const Volume volume = oblique_volume();
  const auto back = volume_from_bytes(bytes_from_volume(volume));
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(back->size_voxels, volume.size_voxels);
  EXPECT_EQ(back->spacing_mm, volume.spacing_mm);
  EXPECT_EQ(back->lps_from_voxel, volume.lps_from_voxel);
  EXPECT_EQ(back->hu, volume.hu);
}

TEST(VolumeBytes, a_left_handed_volume_and_a_single_voxel_come_back) {
  glm::dmat3 mirrored(1.0);
  mirrored[2][2] = -1.0;
  const Volume left = make_volume({2, 3, 4}, glm::dvec3(1.0), mirrored, glm::dvec3(0.0));
  const Volume one = make_volume({1, 1, 1}, glm::dvec3(1.0), glm::dmat3(1.0), glm::dvec3(5.0));
  for (const Volume& volume : {left, one}) {
    const auto back = volume_from_bytes(bytes_from_volume(volume));
    ASSERT_TRUE(back.has_value());
    EXPECT_EQ(back->lps_from_voxel, volume.lps_from_voxel);
    EXPECT_EQ(back->hu, volume.hu);
  }
}

TEST(VolumeBytes, equal_volumes_give_equal_bytes) {
  EXPECT_EQ(bytes_from_volume(oblique_volume()), bytes_from_volume(oblique_volume()));
}

TEST(VolumeBytes, every_truncation_is_refused) {
  const auto bytes = bytes_from_volume(oblique_volume());
  for (std::size_t size = 0; size < bytes.size(); ++size)
    expect_damaged(volume_from_bytes(std::span(bytes).first(size)));
}

TEST(VolumeBytes, every_flipped_bit_is_refused_or_harmless) {
  // A bit that the codec does not use (e.g. of its frame header) may flip unseen; the voxels never change.
  const Volume volume = oblique_volume();
  auto bytes = bytes_from_volume(volume);
  std::size_t refused = 0;
  for (std::size_t bit = 0; bit < bytes.size() * 8; ++bit) {
    bytes[bit / 8] ^= std::byte(1U << (bit % 8));
    const auto back = volume_from_bytes(bytes);
    if (back.has_value()) {
      EXPECT_EQ(back->hu, volume.hu);
      EXPECT_EQ(back->lps_from_voxel, volume.lps_from_voxel);
      EXPECT_GE(bit / 8, kVolumeHeaderBytes);
    } else {
      EXPECT_EQ(back.error().code, "damaged");
      ++refused;
    }
    bytes[bit / 8] ^= std::byte(1U << (bit % 8));
  }
  EXPECT_GT(refused, bytes.size() * 8 - 16);
}

TEST(VolumeBytes, trailing_bytes_are_refused) {
  const auto bytes = bytes_from_volume(oblique_volume());
  auto longer = bytes;
  longer.push_back(std::byte{0});
  expect_damaged(volume_from_bytes(longer));
  // A second, empty frame of the codec is no less a trailing byte.
  longer = bytes;
  const auto empty_frame = base::compress({});
  longer.insert(longer.end(), empty_frame.begin(), empty_frame.end());
  expect_damaged(volume_from_bytes(longer));
}

TEST(VolumeBytes, another_magic_or_version_is_refused) {
  const auto bytes = bytes_from_volume(oblique_volume());
  expect_damaged(volume_from_bytes(with_header_value<std::uint32_t>(bytes, kVolumeHeaderBytes, 0, 0x12345678)));
  expect_damaged(volume_from_bytes(with_header_value<std::uint32_t>(bytes, kVolumeHeaderBytes, 4, 2)));
  expect_damaged(volume_from_bytes(bytes_from_labels(some_labels())));
}

TEST(VolumeBytes, a_size_that_does_not_fit_is_refused) {
  const auto bytes = bytes_from_volume(oblique_volume());
  for (const std::int32_t size : {0, -7, 6, 8, 1 << 20, 1 << 30, std::numeric_limits<std::int32_t>::max(),
                                  std::numeric_limits<std::int32_t>::min()})
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (size == 6 && axis == 1) continue;
      expect_damaged(volume_from_bytes(with_header_value(bytes, kVolumeHeaderBytes, kSizeAt + 4 * axis, size)));
    }
  // The same voxel count shaped otherwise is another volume, and would be one: only the checksum tells.
  EXPECT_TRUE(volume_from_bytes(with_header_value(bytes, kVolumeHeaderBytes, kSizeAt, 7)).has_value());
}

TEST(VolumeBytes, three_large_sizes_whose_product_overflows_are_refused) {
  auto bytes = bytes_from_volume(oblique_volume());
  for (std::size_t axis = 0; axis < 3; ++axis)
    bytes = with_header_value<std::int32_t>(bytes, kVolumeHeaderBytes, kSizeAt + 4 * axis, 1 << 22);  // 2^66
  expect_damaged(volume_from_bytes(bytes));
}

TEST(VolumeBytes, unsound_geometry_is_refused) {
  const auto bytes = bytes_from_volume(oblique_volume());
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const double value : {nan, inf, -inf, 0.0, -1.0})
    expect_damaged(volume_from_bytes(with_header_value(bytes, kVolumeHeaderBytes, kSpacingAt + 8, value)));
  for (std::size_t at = 0; at < 16; ++at)
    for (const double value : {nan, inf})
      expect_damaged(volume_from_bytes(with_header_value(bytes, kVolumeHeaderBytes, kMatrixAt + 8 * at, value)));
  expect_damaged(volume_from_bytes(with_header_value(bytes, kVolumeHeaderBytes, kMatrixAt + 8 * 15, 2.0)));
  auto singular = bytes;  // the third column becomes the second
  for (std::size_t row = 0; row < 3; ++row) {
    double value = 0.0;
    std::memcpy(&value, bytes.data() + kMatrixAt + 8 * (4 + row), sizeof value);
    singular = with_header_value(singular, kVolumeHeaderBytes, kMatrixAt + 8 * (8 + row), value);
  }
  expect_damaged(volume_from_bytes(singular));
}

TEST(LabelBytes, labels_and_names_come_back) {
  const LabelMap labels = some_labels();
  const auto back = labels_from_bytes(bytes_from_labels(labels));
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(back->label, labels.label);
  EXPECT_EQ(back->names, labels.names);
  const auto empty = labels_from_bytes(bytes_from_labels({}));
  ASSERT_TRUE(empty.has_value());
  EXPECT_TRUE(empty->label.empty() && empty->names.empty());
}

TEST(LabelBytes, every_truncation_and_a_trailing_byte_are_refused) {
  auto bytes = bytes_from_labels(some_labels());
  for (std::size_t size = 0; size < bytes.size(); ++size)
    expect_damaged(labels_from_bytes(std::span(bytes).first(size)));
  bytes.push_back(std::byte{0});
  expect_damaged(labels_from_bytes(bytes));
}

TEST(LabelBytes, sizes_that_do_not_fit_are_refused) {
  const auto bytes = bytes_from_labels(some_labels());
  for (const std::uint32_t names : {0U, 2U, 4U, 257U, 0xffffffffU})
    expect_damaged(labels_from_bytes(with_header_value(bytes, kLabelHeaderBytes, 8, names)));
  for (const std::uint32_t name_bytes : {0U, 22U, 24U, 0xffffffffU})
    expect_damaged(labels_from_bytes(with_header_value(bytes, kLabelHeaderBytes, 12, name_bytes)));
  for (const std::uint64_t count :
       {std::uint64_t{499}, std::uint64_t{501}, std::uint64_t{1} << 30, ~std::uint64_t{0}})
    expect_damaged(labels_from_bytes(with_header_value(bytes, kLabelHeaderBytes, 16, count)));
}

TEST(LabelBytes, a_label_without_a_name_is_refused) {
  // Built by hand: the writer never makes one.
  const std::uint32_t header[8] = {0x4c4c4453, 1, 1, 8, 2, 0, 0, 0};
  std::vector<std::byte> bytes(sizeof header);
  std::memcpy(bytes.data(), header, sizeof header);
  const unsigned char raw[10] = {4, 0, 0, 0, 'n', 'o', 'n', 'e', 0, 1};
  const auto packed = base::compress(std::as_bytes(std::span(raw)));
  bytes.insert(bytes.end(), packed.begin(), packed.end());
  expect_damaged(labels_from_bytes(with_header_value<std::uint32_t>(bytes, kLabelHeaderBytes, 0, 0x4c4c4453)));
}

}  // namespace
}  // namespace seldinger::volume
