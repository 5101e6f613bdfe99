// Where the demo's library is, and who has an account in it.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "casedb/people/people.h"

namespace seldinger::app {

// seldinger/demo under the user's data folder. Throws base::Failure("disk") when there is none.
std::filesystem::path demo_library();

// Accounts that are missing get random passwords, answered by name: they are shown once.
using Passwords = std::vector<std::pair<std::string, std::string>>;
base::Result<Passwords> add_missing_accounts(casedb::Library& library,
                                             const std::vector<std::pair<const char*, casedb::Role>>& wanted);

// One cohort of the mentors and trainees among them, so that who leads it sees what the others did; made when there
// is none.
base::Result<void> make_demo_cohort(casedb::Library& library,
                                    const std::vector<std::pair<const char*, casedb::Role>>& accounts);

}  // namespace seldinger::app
