#include "sim/case/record/time_histogram.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace seldinger::cases {
namespace {

constexpr unsigned kBits = 4;  // 2^4 bins per doubling
constexpr std::uint64_t kPerDoubling = 1U << kBits;

}  // namespace

std::size_t time_bin(std::uint64_t ns) noexcept {
  if (ns < kPerDoubling) return static_cast<std::size_t>(ns);
  const unsigned shift = static_cast<unsigned>(std::bit_width(ns)) - 1U - kBits;
  const std::uint64_t bin = kPerDoubling * (shift + 1U) + ((ns >> shift) & (kPerDoubling - 1U));
  return static_cast<std::size_t>(std::min<std::uint64_t>(bin, TimeHistogram::kBins - 1));
}

std::uint64_t longest_of_time_bin_ns(std::size_t bin) noexcept {
  if (bin < kPerDoubling) return bin;
  const std::uint64_t shift = bin / kPerDoubling - 1U;
  return ((kPerDoubling + bin % kPerDoubling + 1U) << shift) - 1U;
}

void TimeHistogram::add(std::uint64_t ns) noexcept {
  ++counts[time_bin(ns)];
  ++n;
  most_ns = std::max(most_ns, ns);
}

void TimeHistogram::add(const TimeHistogram& others) noexcept {
  for (std::size_t bin = 0; bin < kBins; ++bin) counts[bin] += others.counts[bin];
  n += others.n;
  most_ns = std::max(most_ns, others.most_ns);
}

std::uint64_t TimeHistogram::quantile_ns(double share) const noexcept {
  if (n == 0) return 0;
  const auto rank = static_cast<std::uint64_t>(
      std::clamp(std::ceil(share * static_cast<double>(n)), 1.0, static_cast<double>(n)));
  std::uint64_t sum = 0;
  for (std::size_t bin = 0; bin + 1 < kBins; ++bin) {
    sum += counts[bin];
    if (sum >= rank) return std::min(longest_of_time_bin_ns(bin), most_ns);
  }
  return most_ns;
}

}  // namespace seldinger::cases
