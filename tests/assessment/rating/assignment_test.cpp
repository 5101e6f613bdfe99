// Who rates what: every replay by as many as were asked, raters alike, calibration first, repeats far from the
// first time, and nothing but the seed decides.
#include "assessment/rating/assignment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

namespace seldinger::assessment::rating {
namespace {

std::vector<Design> designs() {
  std::vector<Design> all;
  std::uint64_t seed = 0;
  for (const std::size_t replays : {1U, 2U, 7U, 12U, 30U, 101U})
    for (const std::size_t raters : {1U, 2U, 3U, 5U, 7U, 12U})
      for (std::size_t each = 1; each <= raters; each += 2) all.push_back({replays, 3, raters, each, 4, ++seed});
  return all;
}

TEST(Assigned, EachReplayByAsManyAsAskedAndRatersAlike) {
  for (const Design& design : designs()) {
    std::map<std::size_t, std::size_t> times;
    std::vector<std::size_t> loads;
    for (const auto& mine : assigned(design)) {
      std::set<std::size_t> once;
      for (const Assigned& one : mine)
        if (one.part == Part::rated) {
          EXPECT_TRUE(once.insert(one.view).second);
          ++times[one.view];
        }
      loads.push_back(once.size());
    }
    ASSERT_EQ(times.size(), design.replays);
    for (const auto& [view, n] : times) EXPECT_EQ(n, design.each);
    const auto [least, most] = std::minmax_element(loads.begin(), loads.end());
    EXPECT_LE(*most - *least, 1U) << design.replays << " " << design.raters << " " << design.each;
  }
}

// 60 replays by two of five raters: ten pairs, six replays each.
TEST(Assigned, PairsOfRatersMeetEvenly) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const auto all = assigned({60, 0, 5, 2, 0, seed});
    std::map<std::pair<std::size_t, std::size_t>, int> met;
    for (std::size_t a = 0; a < 5; ++a)
      for (std::size_t b = 0; b < a; ++b)
        for (const Assigned& one : all[a])
          met[{a, b}] += std::find(all[b].begin(), all[b].end(), one) != all[b].end() ? 1 : 0;
    ASSERT_EQ(met.size(), 10U);
    for (const auto& [pair, n] : met) EXPECT_NEAR(n, 6, 1) << "60 replays, 10 pairs";
  }
}

TEST(Assigned, CalibrationComesFirstAndRepeatsAreOfTheFirstThirdInTheLast) {
  for (const Design& design : designs())
    for (const auto& mine : assigned(design)) {
      std::size_t rated = 0, repeats = 0;
      for (const Assigned& one : mine) rated += one.part == Part::rated ? 1U : 0U;
      for (std::size_t i = 0; i < mine.size(); ++i) {
        EXPECT_EQ(mine[i].part == Part::calibration, i < design.calibration);
        if (mine[i].part != Part::repeated) continue;
        ++repeats;
        const auto first = std::find(mine.begin(), mine.end(), Assigned{mine[i].view, Part::rated});
        ASSERT_NE(first, mine.end());
        EXPECT_GE(static_cast<std::size_t>(&mine[i] - &*first), rated / 3) << "others lie between";
      }
      EXPECT_EQ(repeats, std::min(design.repeats, rated / 3));
    }
}

TEST(Assigned, EachRaterHasAnOrderOfTheirOwnFromTheSeedAlone) {
  const Design design{40, 4, 4, 4, 5, 9};
  const auto all = assigned(design);
  EXPECT_EQ(assigned(design), all);
  std::set<std::vector<std::size_t>> orders;
  for (const auto& mine : all) {
    std::vector<std::size_t> order;
    for (const Assigned& one : mine) order.push_back(one.view);
    orders.insert(order);
  }
  EXPECT_EQ(orders.size(), 4U);
  Design other = design;
  other.seed = 10;
  EXPECT_NE(assigned(other), all);
}

// Where a replay stands tells nothing of which one it is: over many seeds each is as often at each place.
TEST(Assigned, APlaceTellsNothingOfTheReplay) {
  constexpr std::size_t kSeeds = 6'000, kReplays = 6;
  std::array<std::array<double, kReplays>, kReplays> counts{};
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const auto mine = assigned({kReplays, 0, 2, 2, 0, seed}).front();
    for (std::size_t i = 0; i < kReplays; ++i) counts[mine[i].view][i] += 1.0;
  }
  const double expected = static_cast<double>(kSeeds) / kReplays;
  double chi_squared = 0.0;
  for (const auto& row : counts)
    for (const double n : row) chi_squared += (n - expected) * (n - expected) / expected;
  EXPECT_LT(chi_squared, 52.6) << "of 25 degrees of freedom, one in a thousand is more";
}

}  // namespace
}  // namespace seldinger::assessment::rating
