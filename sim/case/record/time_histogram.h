// How long something took, many times: counts by length, as a plain value of fixed size. Lengths below 16 ns have a
// bin each, longer ones 16 bins per doubling, so that a quantile is told within 1/16.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace seldinger::cases {

struct TimeHistogram {
  static constexpr std::size_t kBins = 512;  // longer than 34 s: in the last

  std::array<std::uint64_t, kBins> counts{};
  std::uint64_t n = 0;
  std::uint64_t most_ns = 0;

  void add(std::uint64_t ns) noexcept;
  void add(const TimeHistogram& others) noexcept;
  // The length that a share of all lengths (0 to 1) does not exceed: the bin's longest, at most most_ns. 0 of none.
  std::uint64_t quantile_ns(double share) const noexcept;

  bool operator==(const TimeHistogram&) const = default;
};

// The bin of a length, and the longest length of a bin.
std::size_t time_bin(std::uint64_t ns) noexcept;
std::uint64_t longest_of_time_bin_ns(std::size_t bin) noexcept;

}  // namespace seldinger::cases
