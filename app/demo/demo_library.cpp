#include "app/demo/demo_library.h"

#include <algorithm>
#include <cstdio>
#include <system_error>

#include "casedb/database/credentials.h"
#include "casedb/database/library.h"
#include "casedb/people/cohorts.h"

namespace seldinger::app {

MadeFolder::MadeFolder(const std::filesystem::path& folder) : path_(std::filesystem::absolute(folder)) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  if (path_.filename().empty()) path_ = path_.parent_path();  // it was given with a slash at its end
  was_empty_ = fs::is_directory(path_, ignored) && fs::is_empty(path_, ignored) && !ignored;
  for (fs::path above = path_; !above.empty() && !fs::exists(fs::symlink_status(above, ignored));
       above = above.parent_path())
    first_made_ = above;
}

MadeFolder::~MadeFolder() {
  namespace fs = std::filesystem;
  std::error_code ignored;
  if (kept_) return;
  if (!first_made_.empty()) fs::remove_all(first_made_, ignored);
  if (was_empty_)
    for (fs::directory_iterator it(path_, ignored), end; !ignored && it != end; it.increment(ignored))
      fs::remove_all(it->path(), ignored);
}

bool MadeFolder::holds_a_library() const {
  return std::filesystem::exists(path_ / casedb::kDatabaseFile);
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

void print_accounts(const Passwords& passwords) {
  if (passwords.empty()) return;
  std::printf("Accounts, shown once:\n");
  for (const auto& [name, password] : passwords) std::printf("  %-14s %s\n", name.c_str(), password.c_str());
  std::puts("");
  std::fflush(stdout);
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
      if (role == casedb::Role::director) {
        if (const auto done = casedb::appoint_director(library, kTitle, one.person_id); !done) return done;
        continue;
      }
      const auto post = role == casedb::Role::mentor ? casedb::Post::mentor : casedb::Post::learner;
      if (const auto done = casedb::enrol(library, cohort->cohort_id, one.person_id, post); !done) return done;
    }
  return {};
}

}  // namespace seldinger::app
