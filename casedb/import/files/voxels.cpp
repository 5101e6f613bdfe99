#include "casedb/import/files/voxels.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "sim/volume/volume.h"

namespace seldinger::casedb {
namespace {

static_assert(std::endian::native == std::endian::little);

template <typename T>
std::int16_t hu_from(T value) {
  constexpr std::int16_t kMostHu = 32767;
  if constexpr (std::is_floating_point_v<T>)
    return static_cast<std::int16_t>(
        std::lround(std::clamp(static_cast<double>(value), double{volume::kAirHu}, double{kMostHu})));
  else if constexpr (std::is_signed_v<T>)
    return static_cast<std::int16_t>(
        std::clamp<std::int64_t>(static_cast<std::int64_t>(value), volume::kAirHu, kMostHu));
  else
    return static_cast<std::int16_t>(std::min<std::uint64_t>(static_cast<std::uint64_t>(value), kMostHu));
}

template <typename T>
T number_at(const std::byte* at, bool big_endian) {
  std::array<std::byte, sizeof(T)> raw;
  std::memcpy(raw.data(), at, sizeof(T));
  if (big_endian) std::reverse(raw.begin(), raw.end());
  return std::bit_cast<T>(raw);
}

}  // namespace

template <typename T>
void VoxelSink::convert_as(std::span<const std::byte> whole) {
  using Scaled = std::conditional_t<std::is_same_v<T, double>, double, float>;
  const std::size_t count = whole.size() / sizeof(T);
  const std::span<std::int16_t> into = hu_.subspan(done_, count);
  done_ += count;
  const bool scaled = format_.slope != 1.0 || format_.intercept != 0.0;
  if constexpr (std::is_same_v<T, std::int16_t>) {
    if (!scaled && !format_.big_endian) {  // the usual case
      std::memcpy(into.data(), whole.data(), whole.size());
      for (std::int16_t& hu : into) hu = std::max(hu, volume::kAirHu);
      return;
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    const T stored = number_at<T>(whole.data() + i * sizeof(T), format_.big_endian);
    if (!scaled && !std::is_floating_point_v<T>) {
      into[i] = hu_from(stored);
      continue;
    }
    const Scaled value =
        scaled ? static_cast<Scaled>(static_cast<double>(static_cast<Scaled>(stored)) * format_.slope +
                                     format_.intercept)
               : static_cast<Scaled>(stored);
    if (!std::isfinite(value)) {
      finite_ = false;
      continue;
    }
    into[i] = hu_from(value);
  }
}

void VoxelSink::convert(std::span<const std::byte> whole) {
  switch (format_.scalar) {
    case Scalar::none:
      return;
    case Scalar::int8:
      return convert_as<std::int8_t>(whole);
    case Scalar::uint8:
      return convert_as<std::uint8_t>(whole);
    case Scalar::int16:
      return convert_as<std::int16_t>(whole);
    case Scalar::uint16:
      return convert_as<std::uint16_t>(whole);
    case Scalar::int32:
      return convert_as<std::int32_t>(whole);
    case Scalar::uint32:
      return convert_as<std::uint32_t>(whole);
    case Scalar::int64:
      return convert_as<std::int64_t>(whole);
    case Scalar::uint64:
      return convert_as<std::uint64_t>(whole);
    case Scalar::float32:
      return convert_as<float>(whole);
    case Scalar::float64:
      return convert_as<double>(whole);
  }
}

void VoxelSink::take(std::span<const std::byte> bytes) {
  const auto size = static_cast<std::size_t>(bytes_of(format_.scalar));
  if (size == 0) return;
  if (cut_bytes_ > 0 && !full()) {
    const std::size_t more = std::min(size - cut_bytes_, bytes.size());
    std::copy_n(bytes.begin(), more, cut_.begin() + static_cast<std::ptrdiff_t>(cut_bytes_));
    cut_bytes_ += more;
    bytes = bytes.subspan(more);
    if (cut_bytes_ < size) return;
    cut_bytes_ = 0;
    convert(std::span(cut_).first(size));
  }
  const std::size_t count = std::min(bytes.size() / size, hu_.size() - done_);
  convert(bytes.first(count * size));
  if (full()) return;
  const auto rest = bytes.subspan(count * size);
  std::copy(rest.begin(), rest.end(), cut_.begin());
  cut_bytes_ = rest.size();
}

}  // namespace seldinger::casedb
