#include "app/demo/demo_library.h"

#include <algorithm>
#include <cstdlib>

#include "casedb/database/credentials.h"
#include "sim/base/failure.h"

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
    const bool there = std::any_of(accounts.begin(), accounts.end(),
                                   [&](const casedb::Account& one) { return one.login_name == name; });
    if (there) continue;
    const std::string password = casedb::random_password();
    const auto added = casedb::add_user(library, name, role, password);
    if (!added) return added.error();
    passwords.emplace_back(name, password);
  }
  return passwords;
}

}  // namespace seldinger::app
