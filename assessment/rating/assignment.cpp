#include "assessment/rating/assignment.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <tuple>
#include <utility>

#include "sim/base/check.h"
#include "sim/base/hash.h"
#include "sim/base/rng.h"

namespace seldinger::assessment::rating {
namespace {

std::size_t below(base::Rng& rng, std::size_t n) {
  return static_cast<std::size_t>(rng.uniform() * static_cast<double>(n));
}

template <typename T>
void shuffle(std::vector<T>& all, base::Rng& rng) {
  for (std::size_t i = all.size(); i > 1; --i) std::swap(all[i - 1], all[below(rng, i)]);  // Fisher and Yates
}

std::vector<std::size_t> shuffled(std::size_t n, base::Rng& rng) {
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  shuffle(order, rng);
  return order;
}

// Which raters a replay gets, one bit each: of all that are possible the one after which loads, then meetings of
// pairs, are most even; chance decides between equals.
class Dealer {
 public:
  Dealer(const Design& design, base::Rng& rng)
      : design_(design), rng_(rng), loads_(design.raters), meetings_(design.raters * design.raters) {
    for (unsigned set = 0; set < (1U << design.raters); ++set)
      if (static_cast<std::size_t>(std::popcount(set)) == design.each) sets_.push_back(set);
  }

  unsigned next() {
    unsigned best = 0;
    std::tuple<std::size_t, std::size_t, double> least{SIZE_MAX, SIZE_MAX, 1.0};
    for (const unsigned set : sets_) {
      const std::tuple cost{loads_of(set), meetings_of(set), rng_.uniform()};
      if (cost < least) least = cost, best = set;
    }
    for (std::size_t a = 0; a < design_.raters; ++a) {
      if (!has(best, a)) continue;
      ++loads_[a];
      for (std::size_t b = 0; b < design_.raters; ++b)
        if (has(best, b)) ++meetings_[a * design_.raters + b];
    }
    return best;
  }
  static bool has(unsigned set, std::size_t rater) { return (set >> rater & 1U) != 0; }

 private:
  std::size_t loads_of(unsigned set) const {
    std::size_t sum = 0;
    for (std::size_t a = 0; a < design_.raters; ++a) sum += has(set, a) ? loads_[a] : 0;
    return sum;
  }
  std::size_t meetings_of(unsigned set) const {
    std::size_t sum = 0;
    for (std::size_t a = 0; a < design_.raters; ++a)
      for (std::size_t b = 0; b < a; ++b)
        sum += has(set, a) && has(set, b) ? 2 * meetings_[a * design_.raters + b] + 1 : 0;
    return sum;
  }

  const Design& design_;
  base::Rng& rng_;
  std::vector<unsigned> sets_;
  std::vector<std::size_t> loads_, meetings_;
};

}  // namespace

std::vector<std::vector<Assigned>> assigned(const Design& design) {
  CHECK(design.raters >= 1 && design.raters <= kMostRaters && design.each >= 1 && design.each <= design.raters);
  base::Rng deal(design.seed);
  std::vector<std::vector<std::size_t>> replays(design.raters);
  Dealer dealer(design, deal);
  for (const std::size_t view : shuffled(design.replays, deal)) {
    const unsigned set = dealer.next();
    for (std::size_t rater = 0; rater < design.raters; ++rater)
      if (Dealer::has(set, rater)) replays[rater].push_back(view);
  }
  std::vector<std::vector<Assigned>> all(design.raters);
  for (std::size_t rater = 0; rater < design.raters; ++rater) {
    base::Rng own(base::hash_combine(design.seed, rater + 1));
    for (const std::size_t view : shuffled(design.calibration, own))
      all[rater].push_back({view, Part::calibration});
    std::vector<std::size_t>& mine = replays[rater];
    shuffle(mine, own);
    const std::size_t third = mine.size() / 3;
    std::vector<Assigned> first, last;
    for (std::size_t i = 0; i < mine.size(); ++i)
      (i < mine.size() - third ? first : last).push_back({mine[i], Part::rated});
    const std::vector<std::size_t> again = shuffled(third, own);
    for (std::size_t i = 0; i < std::min(design.repeats, third); ++i)
      last.push_back({mine[again[i]], Part::repeated});
    shuffle(last, own);
    all[rater].insert(all[rater].end(), first.begin(), first.end());
    all[rater].insert(all[rater].end(), last.begin(), last.end());
  }
  return all;
}

}  // namespace seldinger::assessment::rating
