#include "assessment/statistics/groups/pairwise.h"

#include <bit>
#include <cstdint>

#include "sim/base/check.h"

namespace seldinger::assessment::statistics {
namespace {

// Doubles as whole numbers in the same order.
std::int64_t place_of(double value) {
  const auto bits = std::bit_cast<std::int64_t>(value == 0.0 ? 0.0 : value);
  return bits >= 0 ? bits : INT64_MIN - bits;
}
double at_place(std::int64_t place) {
  return std::bit_cast<double>(place >= 0 ? place : INT64_MIN - place);
}

// The least double that at least k of the pairs do not pass, between two that hold all of them: by halving the
// doubles in between, so it is one of the pairs' own values, to the bit.
template <typename Count>
double kth(double low, double high, std::size_t k, const Count& not_above) {
  std::int64_t from = place_of(low), to = place_of(high);
  while (from < to) {
    const std::int64_t middle = (from & to) + ((from ^ to) >> 1);  // downwards, without overflow
    if (not_above(at_place(middle)) >= k)
      to = middle;
    else
      from = middle + 1;
  }
  return at_place(to);
}

}  // namespace

double kth_difference(std::span<const double> a, std::span<const double> b, std::size_t k) {
  CHECK(k >= 1 && k <= a.size() * b.size());
  const auto not_above = [&](double limit) {
    std::size_t count = 0, first = 0;  // b[first…] are large enough to keep value − b from passing the limit
    for (const double value : a) {
      while (first < b.size() && value - b[first] > limit) ++first;
      count += b.size() - first;
    }
    return count;
  };
  return kth(a.front() - b.back(), a.back() - b.front(), k, not_above);
}

double kth_walsh_average(std::span<const double> values, std::size_t k) {
  const std::size_t n = values.size();
  CHECK(k >= 1 && k <= n * (n + 1) / 2);
  const auto mean = [&](std::size_t i, std::size_t j) { return 0.5 * values[i] + 0.5 * values[j]; };
  const auto not_above = [&](double limit) {
    std::size_t count = 0, end = n;  // values[…end) whose mean with values[i] is not above the limit
    for (std::size_t i = 0; i < n; ++i) {
      while (end > 0 && mean(i, end - 1) > limit) --end;
      if (end <= i) break;
      count += end - i;
    }
    return count;
  };
  return kth(values.front(), values.back(), k, not_above);
}

}  // namespace seldinger::assessment::statistics
