#include <array>
#include <span>
#include <unordered_map>

#include "casedb/database/audit.h"
#include "casedb/database/credentials.h"
#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/uuid.h"
#include "casedb/people/login_name.h"
#include "casedb/people/password_rules.h"
#include "casedb/people/people.h"
#include "sim/base/check.h"
#include "sim/base/names.h"

namespace seldinger::casedb {
namespace {

constexpr auto kRoles = base::names<Role>({{Role::trainee, "trainee"},
                                           {Role::mentor, "mentor"},
                                           {Role::researcher, "researcher"},
                                           {Role::director, "director"},
                                           {Role::admin, "admin"}});

const base::Error kNoUser{"no_user", "there is no such user"};
const base::Error kNameTaken{"name_taken", "there is already a user of that name"};

Role stored_role(const Statement& from) {
  const auto role = role_from(from.text("role"));
  CHECK(role.has_value());  // the schema takes no other
  return *role;
}

struct Identity {
  std::string person_id, name;
};

std::optional<Identity> find_identity(Library& library, const std::string& name) {
  Statement identity = question(library.identities(), "identity_by_name");
  if (!identity.bind("name", name).step()) return std::nullopt;
  return Identity{identity.text("person_id"), identity.text("name")};
}

constexpr auto kLevels = base::names<Level>(
    {{Level::student, "student"}, {Level::trainee, "trainee"}, {Level::consultant, "consultant"}});

std::string mark_of(const std::string& password_hash, std::int64_t epoch) {
  const std::string both = password_hash + '\n' + std::to_string(epoch);
  return sha256_hex(std::as_bytes(std::span(both))).substr(0, 16);
}

Account account_of(const Statement& stored, const std::string& name) {
  return {stored.text("person_id"),
          name,
          stored_role(stored),
          stored.integer("enabled") != 0,
          mark_of(stored.text("password_hash"), stored.integer("epoch")),
          level_from(stored.text("level"))};
}

void add_account(Library& library, const std::string& person_id, Role role, const std::string& hash) {
  Sqlite& database = library.database();
  std::array<std::byte, 5> random{};
  fill_random(random);
  const std::string pseudonym = "P-" + sha256_hex(random).substr(0, 10);
  const std::int64_t created_us = now_us();
  Transaction transaction(database);
  question(database, "add_person")
      .bind("person_id", person_id)
      .bind("pseudonym", pseudonym)
      .bind("created_us", created_us)
      .run();
  question(database, "add_account")
      .bind("person_id", person_id)
      .bind("role", name_of(role))
      .bind("password_hash", hash)
      .bind("enabled", 1)
      .bind("created_us", created_us)
      .run();
  audit(library, Act::add_account, {"person", person_id});
  transaction.commit();
}

void remove_account(Library& library, const std::string& person_id) {
  Transaction transaction(library.database());
  question(library.database(), "remove_account").bind("person_id", person_id).run();
  question(library.database(), "remove_person").bind("person_id", person_id).run();
  audit(library, Act::add_account, {"person", person_id}, Outcome::refused);
  transaction.commit();
}

// Within a transaction. False when somebody else has the name.
bool add_identity(Sqlite& identities, const std::string& person_id, const std::string& name) {
  Statement insert = question(identities, "add_identity");
  insert.bind("person_id", person_id).bind("name", name).bind("created_us", now_us());
  if (!insert.step()) return false;
  CHECK(!insert.step());
  return true;
}

void store_hash(Library& library, const std::string& person_id, const std::string& hash,
                const std::optional<std::string>& old_hash) {
  Transaction transaction(library.database());
  question(library.database(), "set_password_hash")
      .bind("person_id", person_id)
      .bind("password_hash", hash)
      .bind("old_hash", old_hash)
      .run();
  if (!old_hash) audit(library, Act::set_password, {"person", person_id});
  transaction.commit();
}

constexpr std::int64_t kUnknownNamesApart_us = 60 * 1000000LL;

// Names that nobody has are kept once a minute: whoever tries them would else write as fast as passwords are
// hashed.
bool is_told_already(Library& library) {
  Statement row = question(library.database(), "last_log_in_of_nobody");
  if (!row.step()) return false;
  const std::int64_t ago_us = now_us() - row.integer("at_us");
  return ago_us >= 0 && ago_us < kUnknownNamesApart_us;
}

// As much to write as a row, and nothing new: the time it takes does not tell which names there are.
void write_as_before(Sqlite& database) {
  if (database.read_only()) return;
  Transaction transaction(database);
  database.run("PRAGMA user_version = " + std::to_string(database.integer("PRAGMA user_version")));
  transaction.commit();
}

// A log-in that cannot be kept, on a full disk or beside a program that writes, is one all the same: whoever may
// read what is there gets in to see what is wrong (docs/decisions/0046).
void audit_log_in(Library& library, const Actor& actor, const Object& of_whom, Outcome outcome) {
  try {
    if (of_whom.id.empty() && is_told_already(library)) return write_as_before(library.database());
    audit_alone(library, actor, Act::log_in, of_whom, outcome);
  } catch (const base::Failure&) {
  }
}

// Within the transaction that takes an admin away.
base::Result<void> check_admin_is_left(Library& library, const std::string& person_id) {
  Statement row = question(library.database(), "is_last_admin");
  CHECK(row.bind("person_id", person_id).step());
  if (row.integer("last") == 0) return {};
  return base::Error{"last_admin", "this is the only admin; make another one first"};
}

}  // namespace

base::Result<void> check_person(Library& library, const std::string& person_id) {
  Statement row = question(library.database(), "person_exists");
  CHECK(row.bind("person_id", person_id).step());
  if (row.integer("found") == 0) return base::Error{"no_person", "there is no such person"};
  return {};
}

std::string name_of(Role role) {
  return std::string(base::name_of(kRoles, role));
}

std::optional<Role> role_from(const std::string& name) {
  return base::from_name(kRoles, name);
}

std::string name_of(Level level) {
  return std::string(base::name_of(kLevels, level));
}

std::optional<Level> level_from(const std::string& name) {
  return base::from_name(kLevels, name);
}

base::Result<void> check_new_user(const std::string& name, const std::string& password) {
  if (!is_login_name(name))
    return base::Error{"bad_name", "a user name has 1 to 64 printable characters and no space at its ends"};
  return check_password(password, name);
}

base::Result<std::string> add_user(Library& library, const std::string& name, Role role,
                                   const std::string& password) {
  if (const auto fit = check_new_user(name, password); !fit) return fit.error();
  if (find_identity(library, name)) return kNameTaken;
  std::string person_id = new_uuid();
  const std::string hash = hash_password(password);
  // Nothing is done of a name that cannot be stored. The account is committed first: one without a name can never
  // log in, a name without an account would be taken for ever.
  Transaction name_taken(library.identities());
  if (!add_identity(library.identities(), person_id, name)) return kNameTaken;  // another process was faster
  add_account(library, person_id, role, hash);
  try {
    name_taken.commit();
  } catch (const base::Failure&) {
    try {
      remove_account(library, person_id);
    } catch (const base::Failure&) {
      // It stays without a name; what went wrong first is what the caller hears.
    }
    throw;
  }
  return person_id;
}

std::vector<Account> list_users(Library& library) {
  std::unordered_map<std::string, std::string> names;
  for (Statement all = question(library.identities(), "identities"); all.step();)
    names.emplace(all.text("person_id"), all.text("name"));
  std::vector<Account> users;
  Statement all = question(library.database(), "accounts");
  for (all.bind("now_us", now_us()); all.step();)
    if (const auto name = names.find(all.text("person_id")); name != names.end())  // not erased, not half made
      users.push_back(account_of(all, name->second));
  return users;
}

std::optional<Account> find_user(Library& library, const std::string& person_id) {
  Statement identity = question(library.identities(), "identity_of_person");
  if (!identity.bind("person_id", person_id).step()) return std::nullopt;
  Statement stored = question(library.database(), "account");
  if (!stored.bind("person_id", person_id).bind("now_us", now_us()).step()) return std::nullopt;
  return account_of(stored, identity.text("name"));
}

base::Result<void> set_password(Library& library, const std::string& name, const std::string& password) {
  const auto identity = find_identity(library, name);
  if (!identity) return kNoUser;
  if (const auto fit = check_password(password, identity->name); !fit) return fit.error();
  store_hash(library, identity->person_id, hash_password(password), std::nullopt);
  return {};
}

base::Result<void> set_enabled(Library& library, const std::string& name, bool enabled) {
  const auto identity = find_identity(library, name);
  if (!identity) return kNoUser;
  Transaction transaction(library.database());
  if (!enabled)
    if (const auto fit = check_admin_is_left(library, identity->person_id); !fit) return fit.error();
  question(library.database(), "set_enabled")
      .bind("person_id", identity->person_id)
      .bind("enabled", enabled ? 1 : 0)
      .run();
  audit(library, enabled ? Act::enable_account : Act::disable_account, {"person", identity->person_id});
  transaction.commit();
  return {};
}

base::Result<void> set_role(Library& library, const std::string& name, Role role) {
  const auto identity = find_identity(library, name);
  if (!identity) return kNoUser;
  Transaction transaction(library.database());
  if (role != Role::admin)
    if (const auto fit = check_admin_is_left(library, identity->person_id); !fit) return fit.error();
  question(library.database(), "set_role").bind("person_id", identity->person_id).bind("role", name_of(role)).run();
  audit(library, Act::set_role, {"person", identity->person_id});
  transaction.commit();
  return {};
}

base::Result<void> set_level(Library& library, const std::string& name, Level level) {
  const auto identity = find_identity(library, name);
  if (!identity) return kNoUser;
  Transaction transaction(library.database());
  const std::int64_t now = now_us();
  question(library.database(), "remove_levels_to_come")
      .bind("person_id", identity->person_id)
      .bind("now_us", now)
      .run();
  question(library.database(), "add_level")
      .bind("person_id", identity->person_id)
      .bind("now_us", now)
      .bind("level", name_of(level))
      .run();
  audit(library, Act::set_level, {"person", identity->person_id});
  transaction.commit();
  return {};
}

std::optional<Account> log_in(Library& library, const std::string& name, const std::string& password) {
  Account account;
  std::string hash = unmatchable_hash();
  std::int64_t epoch = 0;
  if (const auto identity = find_identity(library, name)) {
    Statement stored = question(library.database(), "account");
    if (stored.bind("person_id", identity->person_id).bind("now_us", now_us()).step()) {
      account = {identity->person_id, identity->name, stored_role(stored), stored.integer("enabled") != 0, {}, {}};
      hash = stored.text("password_hash");
      epoch = stored.integer("epoch");
    }
  }
  const bool fits = verify_password(hash, password);
  const Object of_whom = account.person_id.empty() ? Object{} : Object{"person", account.person_id};
  if (!fits || account.person_id.empty() || !account.enabled) {
    const Actor tried = library.actor().is_operator() ? library.actor() : Actor::nobody();
    audit_log_in(library, tried, of_whom, Outcome::refused);
    return std::nullopt;
  }
  if (needs_rehash(hash)) {
    const std::string better = hash_password(password);
    try {
      store_hash(library, account.person_id, better, hash);
      hash = better;
    } catch (const base::Failure&) {
      // Next time.
    }
  }
  account.password_mark = mark_of(hash, epoch);
  audit_log_in(library, Actor::person(account.person_id), of_whom, Outcome::done);
  return account;
}

void log_out(Library& library, const std::string& person_id) {
  audit_alone(library, Actor::person(person_id), Act::log_out, {"person", person_id}, Outcome::done);
}

}  // namespace seldinger::casedb
