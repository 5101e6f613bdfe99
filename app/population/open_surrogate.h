// A surrogate from a file, and what it must be of to be used today.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/cli/arguments.h"
#include "app/cli/shard.h"
#include "assessment/population/surrogate.h"
#include "session/attempt/simulation.h"
#include "sim/base/result.h"

namespace seldinger::app {

// Of a case as it is now, and of this program.
assessment::population::SurrogateMark mark_of_case(casedb::Library& library, const session::Simulation& simulation);

// The file of --surrogate: `bad_surrogate`, and `other_surrogate` where it is of other metrics, people or
// simulation than this program's.
base::Result<assessment::population::Surrogate> surrogate_of(const Arguments& arguments);
// The same of a file that another option names.
base::Result<assessment::population::Surrogate> surrogate_in(const char* option, const std::string& file);

constexpr double kMostShift = 5.0;  // standard deviations
// "novice", "intermediate", "expert" or by how many standard deviations every ability is shifted.
std::optional<assessment::population::Group> group_from(const std::string& text);

// Of the people of a seed, who are dealt to the groups in turn, those of these numbers, from 1.
struct Numbered {
  std::size_t first = 1, count = 0;
};
// A shard's of so many: people in a row, so that every shard has all groups.
Numbered numbered(const Shard& shard, std::size_t people) noexcept;

// Everybody's place among abilities, and what the attempt measured: attempts that are simulated whole and not
// stored.
base::Result<std::vector<assessment::population::SimulatedPoint>> simulated_points(
    const session::Simulation& simulation, const std::vector<assessment::population::Group>& groups,
    std::uint64_t seed, Numbered people, std::size_t jobs);

}  // namespace seldinger::app
