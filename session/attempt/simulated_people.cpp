#include "session/attempt/simulated_people.h"

#include <map>

#include "casedb/database/uuid.h"
#include "casedb/people/simulated_people.h"

namespace seldinger::session {
namespace {

namespace population = assessment::population;

constexpr double kDayUs = 86400e6;

void add_trials(const PeopleWish& wish, const population::Person& person, std::uint64_t case_key,
                std::int64_t first_day_us, std::vector<SimulatedTrial>& trials) {
  std::vector<double> days_before;
  for (std::size_t session = 0; session < wish.days.size(); ++session) {
    if (!population::comes_to(person, session)) return;
    for (std::size_t i = 0; i < wish.count; ++i) {
      const double day = wish.days[session];
      population::Occasion occasion{case_key, session * wish.count + i, 0.0};
      occasion.gain = population::gain_of(person.practice, days_before, day);
      days_before.push_back(day);
      SimulatedTrial& trial = trials.emplace_back();
      trial.profile = population::profile_on(person, occasion);
      trial.seed = population::attempt_seed(person, occasion);
      trial.person = person.number;
      trial.number = occasion.attempt;
      trial.started_us = first_day_us + static_cast<std::int64_t>(day * kDayUs);
      trial.mishaps = population::mishaps_on(person, occasion);
    }
  }
}

template <typename Told>
void each_person(const PeopleWish& wish, const Told& told) {
  for (std::size_t number = 1; number <= wish.people; ++number)
    if ((number - 1) % wish.shards + 1 == wish.shard) told(population::drawn_person(wish.group, wish.seed, number));
}

}  // namespace

std::vector<SimulatedTrial> people_trials(const PeopleWish& wish, std::uint64_t case_key) {
  std::vector<SimulatedTrial> trials;
  each_person(wish, [&](const population::Person& person) { add_trials(wish, person, case_key, 0, trials); });
  return trials;
}

StoredPeople people_trials(casedb::Library& library, const PeopleWish& wish, const Task& task) {
  StoredPeople stored;
  const std::int64_t now_us = casedb::now_us();
  each_person(wish, [&](const population::Person& person) {
    const std::string person_id = casedb::simulated_person(library, person, wish.seed);
    std::map<std::uint64_t, casedb::AttemptRow> by_seed;
    for (casedb::AttemptRow& row : casedb::list_attempts_of(library, person_id))
      if (was_made_at(row, task)) by_seed.emplace(row.seed, std::move(row));
    std::vector<SimulatedTrial> own;
    add_trials(wish, person, population::case_key_of(task.row.title), now_us, own);
    for (SimulatedTrial& trial : own) {
      if (const auto row = by_seed.find(trial.seed); row != by_seed.end()) {
        stored.there.push_back({row->second.attempt_id, row->second.operator_name, trial.seed,
                                std::move(row->second.metrics), trial.person, trial.number});
        continue;
      }
      trial.person_id = person_id;
      stored.trials.push_back(std::move(trial));
    }
    stored.person_ids.push_back(person_id);
  });
  return stored;
}

}  // namespace seldinger::session
