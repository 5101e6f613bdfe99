// Who is at which station when: every station once for each person and balanced for what it follows.
#include "assessment/study/stations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

namespace seldinger::assessment::study {
namespace {

TEST(Williams, EveryStationFollowsEveryOtherEquallyOften) {
  for (std::size_t n = 2; n <= 12; ++n) {
    const auto rows = williams_orders(n);
    ASSERT_EQ(rows.size(), n % 2 == 0 ? n : 2 * n);
    std::map<std::pair<std::size_t, std::size_t>, int> follows;
    for (const auto& row : rows) {
      EXPECT_EQ(std::set<std::size_t>(row.begin(), row.end()).size(), n);
      for (std::size_t i = 0; i + 1 < n; ++i) ++follows[{row[i], row[i + 1]}];
    }
    ASSERT_EQ(follows.size(), n * (n - 1)) << n;
    for (const auto& [pair, times] : follows) EXPECT_EQ(times, n % 2 == 0 ? 1 : 2) << n;
    for (std::size_t from = 0; from < rows.size(); from += n)
      for (std::size_t turn = 0; turn < n; ++turn) {
        std::set<std::size_t> at;
        for (std::size_t i = 0; i < n; ++i) at.insert(rows[from + i][turn]);
        EXPECT_EQ(at.size(), n) << "a Latin square";
      }
  }
}

TEST(OrdersOfStations, NobodyWaitsAndOnlyTheSeedDecides) {
  for (std::size_t stations = 2; stations <= 7; ++stations)
    for (const std::size_t people : {1U, 2U, 5U, 12U, 23U}) {
      const auto orders = orders_of_stations(stations, people, 3);
      ASSERT_EQ(orders.size(), people);
      EXPECT_EQ(orders, orders_of_stations(stations, people, 3));
      for (std::size_t turn = 0; turn < stations; ++turn) {
        std::vector<std::size_t> at(stations);
        for (const auto& order : orders) ++at[order[turn]];
        const auto [least, most] = std::minmax_element(at.begin(), at.end());
        EXPECT_LE(*most - *least, 1U) << stations << " stations, " << people << " people, turn " << turn;
      }
    }
  EXPECT_NE(orders_of_stations(4, 12, 3), orders_of_stations(4, 12, 4));
}

// Who comes first has no better chance of the first station than who comes last.
TEST(OrdersOfStations, APlaceInTheListTellsNoStation) {
  std::map<std::size_t, int> first;
  for (std::uint64_t seed = 0; seed < 4'000; ++seed) ++first[orders_of_stations(4, 6, seed).front().front()];
  for (const auto& [station, times] : first) EXPECT_NEAR(times, 1'000, 110) << station;
}

// As people come: after each the table is as even as it can be, and who came keeps their order.
TEST(OrderOfArrival, IsEvenAfterEverybodyWhoComes) {
  for (std::size_t stations = 2; stations <= 7; ++stations) {
    std::vector<std::vector<std::size_t>> at(stations, std::vector<std::size_t>(stations));
    for (std::size_t arrival = 0; arrival < 30; ++arrival) {
      const auto order = order_of_arrival(stations, arrival, 3);
      EXPECT_EQ(std::set<std::size_t>(order.begin(), order.end()).size(), stations);
      for (std::size_t turn = 0; turn < stations; ++turn) {
        ++at[turn][order[turn]];
        const auto [least, most] = std::minmax_element(at[turn].begin(), at[turn].end());
        EXPECT_LE(*most - *least, 1U) << stations << " stations, arrival " << arrival << ", turn " << turn;
      }
    }
  }
  EXPECT_NE(order_of_arrival(5, 3, 3), order_of_arrival(5, 3, 4));
}

}  // namespace
}  // namespace seldinger::assessment::study
