// The attempts of simulated people (assessment/population/person.h) at a case: who comes to which session, as whom,
// and what is still to be made of it. The same wish makes the same people and attempts in every library and every
// shard.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "assessment/population/person.h"
#include "casedb/database/library.h"
#include "session/attempt/simulation.h"

namespace seldinger::session {

struct PeopleWish {
  assessment::population::Group group;
  std::uint64_t seed = 1;
  std::size_t people = 1;
  std::size_t count = 1;              // attempts of each in a session
  std::vector<double> days{0.0};      // of the sessions, rising
  std::size_t shard = 1, shards = 1;  // of the people those whose number falls to this shard
};

// Without a library: `person` is the number, `number` the attempt's. Who drops out is in no later session.
std::vector<SimulatedTrial> people_trials(const PeopleWish& wish, std::uint64_t case_key);
// Of people who are added to the library where they are not in it; those whose attempt is stored already are left
// out. A session's attempts begin as many days from now.
struct StoredPeople {
  std::vector<std::string> person_ids;  // of this shard, by number
  std::vector<SimulatedTrial> trials;
  std::vector<SimulatedAttempt> there;  // what is stored already, as it is there
};
StoredPeople people_trials(casedb::Library& library, const PeopleWish& wish, const Task& task);

}  // namespace seldinger::session
