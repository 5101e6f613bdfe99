// Ways to deal persons to two groups, as permutation tests go through them: all where they are few, else drawn by a
// seed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "sim/base/rng.h"

namespace seldinger::assessment::statistics {

struct Deals {
  std::size_t persons = 0, first = 0;  // as many are dealt to the first group
  std::size_t draws = 10'000;          // how many are drawn where there are more than this
  std::uint64_t seed = 1;
};

// C(persons, first), or `most` + 1 where it is more.
constexpr std::size_t ways_to_deal(std::size_t persons, std::size_t first, std::size_t most) {
  std::size_t ways = 1;
  if (first > persons - first) first = persons - first;
  for (std::size_t i = 1; i <= first; ++i) {
    ways = ways * (persons - first + i) / i;  // whole at each step
    if (ways > most) return most + 1;
  }
  return ways;
}

// How many of the deals are at least as extreme as the one that was observed, which is counted as one of them.
class Exceedances {
 public:
  explicit Exceedances(const Deals& deals)
      : deals_(deals), all_(ways_to_deal(deals.persons, deals.first, deals.draws) <= deals.draws) {}

  bool all() const noexcept { return all_; }
  // Where all are gone through the observed one is among them; where they are drawn it is added.
  double chance(std::size_t count) const noexcept {
    return all_ ? static_cast<double>(count) / static_cast<double>(gone_)
                : static_cast<double>(count + 1) / static_cast<double>(gone_ + 1);
  }

  // Calls visit(is_first), a char for each person, for each deal.
  template <typename Visit>
  void go(const Visit& visit) {
    std::vector<char> is_first(deals_.persons, 0);
    gone_ = 0;
    if (all_) {
      each(is_first, 0, deals_.first, visit);
      return;
    }
    std::vector<std::size_t> order(deals_.persons);
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    base::Rng rng(deals_.seed);
    for (; gone_ < deals_.draws; ++gone_) {
      for (std::size_t i = 0; i < deals_.first; ++i) {
        const double left = static_cast<double>(order.size() - i);
        std::swap(order[i], order[i + static_cast<std::size_t>(rng.uniform() * left)]);
      }
      for (char& one : is_first) one = 0;
      for (std::size_t i = 0; i < deals_.first; ++i) is_first[order[i]] = 1;
      visit(is_first);
    }
  }

 private:
  template <typename Visit>
  void each(std::vector<char>& is_first, std::size_t person, std::size_t left, const Visit& visit) {
    if (left == 0) {
      ++gone_;
      visit(is_first);
      return;
    }
    if (deals_.persons - person > left) each(is_first, person + 1, left, visit);
    is_first[person] = 1;
    each(is_first, person + 1, left - 1, visit);
    is_first[person] = 0;
  }

  Deals deals_;
  bool all_;
  std::size_t gone_ = 0;
};

}  // namespace seldinger::assessment::statistics
