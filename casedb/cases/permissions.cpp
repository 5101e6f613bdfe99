#include "casedb/cases/permissions.h"

#include <iterator>

namespace seldinger::casedb {
namespace {

constexpr bool rows_are_in_the_order_of_the_actions() {
  for (std::size_t i = 0; i < std::size(kPermissions); ++i)
    if (kPermissions[i].action != static_cast<Action>(i)) return false;
  return kPermissions[std::size(kPermissions) - 1].action == Action::read_audit;  // the last
}
static_assert(rows_are_in_the_order_of_the_actions());

}  // namespace

base::Result<void> allow(Role role, Action action, const Subject& subject) {
  if (may(role, action, subject)) return {};
  return base::Error{"not_allowed", std::string(kPermissions[static_cast<std::size_t>(action)].rule)};
}

base::Result<Account> open_account(Library& library, const std::string& login_name) {
  for (Account& one : list_users(library))
    if (one.login_name == login_name && one.enabled) return std::move(one);
  return base::Error{"no_user", "there is no such user, or the account is closed"};
}

base::Result<Account> acting_account(Library& library, const std::string& login_name) {
  auto account = open_account(library, login_name);
  if (!account || library.actor().is_operator()) return account;
  if (library.actor().person_id != account->person_id)
    return base::Error{"not_allowed", "decisions are made in one's own name"};
  return account;
}

base::Result<Account> account_that_may(Library& library, const std::string& login_name, Action action,
                                       const Subject& subject) {
  auto account = acting_account(library, login_name);
  if (!account) return account;
  if (const auto allowed = allow(account->role, action, subject); !allowed) return allowed.error();
  return account;
}

}  // namespace seldinger::casedb
