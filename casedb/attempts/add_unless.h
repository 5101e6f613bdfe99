// An attempt that another program may be storing, too.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "casedb/attempts/attempts.h"

namespace seldinger::casedb {

// As add_attempt, but nothing is stored, and no id answered, where the attempt is there: that is asked in the
// transaction that would store it, so of two programs that bring the same one does.
base::Result<std::optional<std::string>> add_attempt_unless(Library& library, const NewAttempt& attempt,
                                                            const std::function<bool()>& is_there);

// A person's attempts of that seed, without metrics: there are few, however many the person has.
std::vector<AttemptRow> list_attempts_of_seed(Library& library, const std::string& person_id, std::uint64_t seed);

}  // namespace seldinger::casedb
