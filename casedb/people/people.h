// People of a library: accounts, roles, levels. One function per question, its SQL beside it in sql/. Ids are
// UUIDv7 text, times microseconds since 1970 UTC. Every write is one transaction: it is stored whole and
// acknowledged, or not at all.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "casedb/database/library.h"
#include "sim/base/result.h"

namespace seldinger::casedb {

enum class Role { trainee, mentor, researcher, director, admin };
std::string name_of(Role role);
std::optional<Role> role_from(const std::string& name);

// Who somebody is beside a role: what consultants do sets the standard (assessment/grading/standard.h).
enum class Level { student, trainee, consultant };
std::string name_of(Level level);
std::optional<Level> level_from(const std::string& name);

struct Account {
  std::string person_id, login_name;
  Role role = Role::trainee;
  bool enabled = true;
  // Another one after each change of password or role, and once the account was closed: ends what was begun with
  // it. Says nothing about the password.
  std::string password_mark{};
  std::optional<Level> level{};  // in list_users: what is known last
};

// What add_user would refuse in any library: `bad_name`, `weak_password`.
base::Result<void> check_new_user(const std::string& name, const std::string& password);

// `bad_name` (1–64 printable characters, no leading or trailing space), `name_taken`, `weak_password`
// (password_rules.h). Names compare without regard to ASCII case.
base::Result<std::string> add_user(Library& library, const std::string& name, Role role,
                                   const std::string& password);
// `no_person`: there is no such one, or they were erased.
base::Result<void> check_person(Library& library, const std::string& person_id);
std::vector<Account> list_users(Library& library);  // oldest first; those who have a name
std::optional<Account> find_user(Library& library, const std::string& person_id);  // as list_users has them
base::Result<void> set_password(Library& library, const std::string& name,
                                const std::string& password);  // `no_user`, `weak_password`
// In these two the last admin whose account is open stays one: `last_admin`. Whoever is logged in is logged out.
base::Result<void> set_enabled(Library& library, const std::string& name, bool enabled);  // `no_user`
base::Result<void> set_role(Library& library, const std::string& name, Role role);        // `no_user`
// From now on; what was before stays, and with it what earlier attempts count as. `no_user`.
base::Result<void> set_level(Library& library, const std::string& name, Level level);
// The account when name and password fit and it is enabled; takes the same time whether or not the name exists.
// Kept in the audit log, either way, when it can be written; of names that nobody has once a minute.
std::optional<Account> log_in(Library& library, const std::string& name, const std::string& password);
void log_out(Library& library, const std::string& person_id);  // only keeps that somebody did

}  // namespace seldinger::casedb
