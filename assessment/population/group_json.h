// A group of simulated people as somebody's own file tells it: a name, and by how much its abilities are shifted.
#pragma once

#include <string>

#include "assessment/population/person.h"
#include "sim/base/result.h"

namespace seldinger::assessment::population {

// Whether an operator's file is of a group rather than of skills: it says `shift`.
bool is_group_json(const std::string& text);
// {"name", "shift": one number, or one for each of kAbilityNames, "middle_years"}. Refused: `bad_operator`.
base::Result<Group> group_from_json(const std::string& text);

}  // namespace seldinger::assessment::population
