// The options of `simulate` that are about simulated people: of which group, in which sessions, in which cohort,
// and which of them this call makes.
#pragma once

#include <cstdint>
#include <optional>

#include "app/cli/arguments.h"
#include "casedb/database/library.h"
#include "session/attempt/simulated_people.h"
#include "sim/base/result.h"

namespace seldinger::app {

// Nothing: --operator is no group, or --people is not there. `bad_operator`, as read_text; throws UsageError.
base::Result<std::optional<session::PeopleWish>> people_wish(const Arguments& arguments,
                                                             std::optional<std::size_t> people, std::uint64_t seed,
                                                             std::size_t count);

// These people in the library, and in the cohort of --cohort, with what is still to be made; of no wish nothing.
// `no_cohort`, `not_allowed`.
base::Result<session::StoredPeople> people_in_library(casedb::Library& library, const Arguments& arguments,
                                                      const std::optional<session::PeopleWish>& wish,
                                                      const session::Simulation& simulation);

}  // namespace seldinger::app
