// Simulated people in a library: persons of their own kind, without name, account or log-in, whose attempts are
// simulated ones. What was planted in them lies in a table of its own, which is asked by itself alone: nothing that
// tells of people or their attempts knows it.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "assessment/population/person.h"
#include "casedb/database/library.h"

namespace seldinger::casedb {

struct SimulatedTruth {
  std::string person_id, group;
  std::uint64_t seed = 0, number = 1;
  int people_version = 1;
  assessment::population::Abilities ability{};
  double strategy = 0.0;
};

// The same in every library.
std::string simulated_person_id(const assessment::population::Person& person);
// Whoever that seed, group and number make; the same in every library, and added where there is none yet, with the
// facts that such a person tells (casedb/people/facts.h). Answers the person's id.
std::string simulated_person(Library& library, const assessment::population::Person& person, std::uint64_t seed);
bool is_simulated(Library& library, const std::string& person_id);
std::set<std::string> simulated_people(Library& library);             // by their ids
std::vector<SimulatedTruth> list_simulated_truths(Library& library);  // by group, seed and number
// Whoever it is the truth of, with the years that this library has of them.
assessment::population::Person simulated_person_of(Library& library, const SimulatedTruth& truth);

}  // namespace seldinger::casedb
