// Attempts of simulated people with a known law, and a surrogate that was fitted to them.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "assessment/population/streams.h"
#include "assessment/population/surrogate.h"

namespace seldinger::assessment::population {

constexpr std::uint32_t kStep = 7;
inline SurrogateMark known_mark() {
  return mark_of_today(kStep, "case-1", "Ball", "x");
}

// Metrics of the registry with a law, a count of chance, and that it was performed; all others null. Distance:
// exp(.5 − .4 θ + noise). Time: 60 + 10 noise', of strategy alone; null for one in ten, and then the distance is
// null, too.
constexpr double kNullShare = 0.1;
inline SimulatedPoint attempt_of(const SurrogateMark& mark, const Person& person, const Occasion& occasion) {
  SimulatedPoint made;
  made.place = place_of(person, occasion);
  made.values.resize(mark.metrics.size());
  const auto noise = [&](std::uint64_t which) { return stream_of(person.key, Drawn::attempt, 99, which); };
  const bool none = uniform_of(noise(2)) < kNullShare;
  for (std::size_t m = 0; m < mark.metrics.size(); ++m) {
    if (mark.metrics[m].id == "procedure_performed") made.values[m] = 1.0;
    if (none) continue;
    if (mark.metrics[m].id == "tip_target_dist")
      made.values[m] = std::exp(0.5 - 0.4 * made.place[1] + 0.6 * normal_of(noise(0)));
    if (mark.metrics[m].id == "time_total")
      made.values[m] = 60.0 - 8.0 * made.place[kAbilities] + 10.0 * normal_of(noise(1)) + 5.0 * normal_of(noise(0));
    if (mark.metrics[m].id == "withdrawals_full") made.values[m] = uniform_of(noise(3)) < 0.7 ? 0.0 : 1.0;
  }
  return made;
}

inline std::vector<SimulatedPoint> attempts_of(const std::vector<double>& shifts, std::uint64_t seed,
                                               std::size_t count) {
  const SurrogateMark mark = known_mark();
  std::vector<SimulatedPoint> points;
  for (std::size_t number = 1; number <= count; ++number)
    points.push_back(
        attempt_of(mark, drawn_person(shifted_group(shifts[number % shifts.size()]), seed, number), {5, 0, 0.0}));
  return points;
}

inline const Surrogate& fitted() {
  static const Surrogate kFitted =
      std::move(Surrogate::fit(known_mark(), attempts_of({-0.6, 0.0, 0.6, 1.2, 1.8}, 1, 2000))).value();
  return kFitted;
}

}  // namespace seldinger::assessment::population
