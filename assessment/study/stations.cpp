#include "assessment/study/stations.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "sim/base/check.h"
#include "sim/base/rng.h"

namespace seldinger::assessment::study {
namespace {

std::vector<std::size_t> drawn_order(std::size_t n, base::Rng& rng) {
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = n; i > 1; --i)  // Fisher and Yates
    std::swap(order[i - 1], order[static_cast<std::size_t>(rng.uniform() * static_cast<double>(i))]);
  return order;
}

// Squares one after the other, the rows of each as they are drawn: the first so many.
std::vector<std::vector<std::size_t>> dealt_orders(std::size_t stations, std::size_t people, base::Rng& rng) {
  const auto rows = williams_orders(stations);
  const std::vector<std::size_t> names = drawn_order(stations, rng);
  std::vector<std::vector<std::size_t>> dealt;
  for (std::size_t square = 0; dealt.size() < people; ++square) {
    const std::size_t from = square * stations % rows.size();
    for (const std::size_t row : drawn_order(stations, rng)) {
      if (dealt.size() == people) break;
      dealt.push_back(rows[from + row]);
      for (std::size_t& one : dealt.back()) one = names[one];
    }
  }
  return dealt;
}

}  // namespace

std::vector<std::vector<std::size_t>> williams_orders(std::size_t n) {
  CHECK(n >= 2);
  // 0, 1, n − 1, 2, n − 2 …: neighbours differ by every amount once.
  std::vector<std::size_t> first;
  for (std::size_t i = 0; i < n; ++i) first.push_back(i % 2 == 1 ? (i + 1) / 2 : (n - i / 2) % n);
  std::vector<std::vector<std::size_t>> rows;
  for (std::size_t shift = 0; shift < n; ++shift) {
    rows.push_back(first);
    for (std::size_t& one : rows.back()) one = (one + shift) % n;
  }
  if (n % 2 == 1)
    for (std::size_t i = 0; i < n; ++i) rows.emplace_back(rows[i].rbegin(), rows[i].rend());
  return rows;
}

std::vector<std::vector<std::size_t>> orders_of_stations(std::size_t stations, std::size_t people,
                                                         std::uint64_t seed) {
  base::Rng rng(seed);
  const auto dealt = dealt_orders(stations, people, rng);
  std::vector<std::vector<std::size_t>> orders;
  for (const std::size_t place : drawn_order(people, rng)) orders.push_back(dealt[place]);
  return orders;
}

std::vector<std::size_t> order_of_arrival(std::size_t stations, std::size_t arrival, std::uint64_t seed) {
  base::Rng rng(seed);
  return dealt_orders(stations, arrival + 1, rng).back();
}

}  // namespace seldinger::assessment::study
