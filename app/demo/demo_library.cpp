#include "app/demo/demo_library.h"

#include <algorithm>
#include <cstdlib>

#include "casedb/database/credentials.h"
#include "sim/base/failure.h"

#include "casedb/people/cohorts.h"

namespace seldinger::app {

std::filesystem::path demo_library() {
  if (const char* data = std::getenv("XDG_DATA_HOME"); data != nullptr && *data == '/')
    return std::filesystem::path(data) / "seldinger" / "demo";
  const char* home = std::getenv("HOME");
  if (home == nullptr || *home != '/') throw base::Failure("disk", "there is no home folder; give --library");
  return std::filesystem::path(home) / ".local" / "share" / "seldinger" / "demo";
}

base::Result<Passwords> add_missing_accounts(casedb::Library& library,
                                             const std::vector<std::pair<const char*, casedb::Role>>& wanted) {
  Passwords passwords;
  const auto accounts = casedb::list_users(library);
  for (const auto& [name, role] : wanted) {
    const bool there =
        std::any_of(accounts.begin(), accounts.end(),
                    [wanted_name = name](const casedb::Account& one) { return one.login_name == wanted_name; });
    if (there) continue;
    const std::string password = casedb::random_password();
    const auto added = casedb::add_user(library, name, role, password);
    if (!added) return added.error();
    passwords.emplace_back(name, password);
  }
  return passwords;
}

base::Result<void> make_demo_cohort(casedb::Library& library,
                                    const std::vector<std::pair<const char*, casedb::Role>>& accounts) {
  constexpr const char* kTitle = "Demonstration";
  if (!casedb::find_cohort(library, kTitle))
    if (const auto made = casedb::add_cohort(library, kTitle, kTitle, ""); !made) return made.error();
  const auto cohort = casedb::find_cohort(library, kTitle);
  if (!cohort) return cohort.error();
  for (const casedb::Account& one : casedb::list_users(library))
    for (const auto& [name, role] : accounts) {
      if (one.login_name != name) continue;
      const auto post = role == casedb::Role::mentor ? casedb::Post::mentor : casedb::Post::learner;
      if (const auto done = casedb::enrol(library, cohort->cohort_id, one.person_id, post); !done) return done;
    }
  return {};
}

}  // namespace seldinger::app
