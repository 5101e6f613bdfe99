// Who is at which station when, on a day on which everybody goes through all of them: Latin squares in which each
// station follows each other equally often (E. J. Williams, Aust. J. Sci. Res. A 2, 1949), so that what is carried
// over from one to the next weighs on all alike.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace seldinger::assessment::study {

// Orders of stations 0 … n − 1, a row each: n where n is even, 2 n (two squares, one after the other) where it is
// odd. In every n rows from the first on each station is at each turn once. n: at least 2.
std::vector<std::vector<std::size_t>> williams_orders(std::size_t stations);

// By person, in which order they go. Squares are filled one after the other with whole rows, in an order and with
// stations in places that the seed draws: at every turn a station has as many people as another, give or take one.
std::vector<std::vector<std::size_t>> orders_of_stations(std::size_t stations, std::size_t people,
                                                         std::uint64_t seed);

// The same where nobody knows who will come: the order of who comes as the `arrival`th, from 0. Whatever number
// come, no station is ever more than one ahead of another at a turn.
std::vector<std::size_t> order_of_arrival(std::size_t stations, std::size_t arrival, std::uint64_t seed);

}  // namespace seldinger::assessment::study
