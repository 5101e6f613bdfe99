#include "app/acting/acting.h"

#include <sys/stat.h>

#include <algorithm>

#include "app/acting/names.h"
#include "app/acting/read_password.h"
#include "app/acting/token_file.h"
#include "app/cli/library_place.h"
#include "app/cli/words.h"
#include "casedb/database/credentials.h"
#include "casedb/people/login_session.h"
#include "casedb/people/noted_tries.h"

namespace seldinger::app {
namespace {

using casedb::Account;
using casedb::Actor;
using casedb::ActorKind;

bool owns(const casedb::Library& library, uid_t uid) {
  struct stat about {};
  const bool known = ::stat((library.folder() / casedb::kDatabaseFile).c_str(), &about) == 0;
  return uid == 0 || (known && about.st_uid == uid);
}

std::optional<Account> account_of(casedb::Library& library, const Arguments& arguments) {
  if (!arguments.has("--by")) return std::nullopt;
  auto account = casedb::open_account(library, arguments.text("--by"));
  return account ? std::optional(std::move(*account)) : std::nullopt;
}

// By the password that is given; none when none is.
base::Result<std::optional<Account>> by_password(casedb::Library& library, const Arguments& arguments) {
  if (!arguments.has("--password-file")) return std::optional<Account>();
  auto password = read_password_of(arguments.text("--password-file"));
  if (!password) return error_of("--password-file", arguments.text("--password-file"), password.error());
  auto account = casedb::log_in_by_command(library, arguments.required("--by"), *password);
  casedb::wipe(*password);
  if (!account) return account.error();
  return std::optional(std::move(*account));
}

// By a session: of the file that is named, or of the usual one where that is the session of --by. Whoever does not
// own the library needs not name themselves beside their session.
base::Result<std::optional<Account>> by_session(casedb::Library& library, const Arguments& arguments,
                                                const std::optional<Account>& named, bool owner) {
  const bool told = arguments.has("--token-file");
  if (!told && !named && owner) return std::optional<Account>();
  auto token =
      read_token(told ? std::filesystem::path(arguments.text("--token-file")) : token_file_of(library.folder()));
  if (!token) return told ? error_of("--token-file", arguments.text("--token-file"), token.error()) : token.error();
  std::optional<Account> account;
  if (*token) {
    account = casedb::account_of_login_session(library, **token);
    casedb::wipe(**token);
  }
  const bool fits = account && (!arguments.has("--by") || (named && named->person_id == account->person_id));
  if (told && !fits)
    return base::Error{"no_session",
                       "the session has ended, or belongs to somebody else; log in with `seldinger login`"};
  return fits ? account : std::nullopt;
}

base::Result<casedb::Library> with_names(base::Result<casedb::Library> library, const Arguments& arguments) {
  if (library)
    if (const auto settled = settle_names(*library, arguments); !settled) return settled.error();
  return library;
}

base::Result<casedb::Library> open_for(const Arguments& arguments, WhereNone where_none, uid_t uid) {
  const std::filesystem::path folder = library_folder(arguments);
  if (arguments.has("--password-file")) arguments.required("--by");
  // Nobody is known to a library that is only being made.
  const bool create = where_none == WhereNone::create && !arguments.has("--by") && !arguments.has("--token-file");
  auto library = create ? casedb::Library::open_or_create(folder) : casedb::Library::open(folder);
  if (!library) return error_of_library(arguments, library.error());
  const bool owner = owns(*library, uid);
  auto proven = by_password(*library, arguments);
  if (!proven) return proven.error();
  const std::optional<Account> named = *proven ? *proven : account_of(*library, arguments);
  if (!*proven) {
    proven = by_session(*library, arguments, named, owner);
    if (!proven) return proven.error();
  }
  if (*proven) {
    library->act_for(Actor::person((*proven)->person_id));
    return library;
  }
  const std::optional<std::string> person_id = named ? std::optional(named->person_id) : std::nullopt;
  if (!owner) {
    casedb::audit_alone(*library, Actor::nobody(), casedb::Act::unproven,
                        person_id ? casedb::Object{"person", *person_id} : casedb::Object{},
                        casedb::Outcome::refused);
    return base::Error{"not_proven",
                       "the library belongs to another account of this machine: log in with `seldinger login`, or "
                       "give --by and --password-file"};
  }
  library->act_for({ActorKind::library_operator, person_id});
  return library;
}

}  // namespace

base::Result<casedb::Library> open_library(const Arguments& arguments) {
  auto library = casedb::Library::open(library_folder(arguments));
  if (!library) return error_of_library(arguments, library.error());
  return with_names(std::move(library), arguments);
}

base::Result<casedb::Library> open_acting(const Arguments& arguments, WhereNone where_none, uid_t uid) {
  return with_names(open_for(arguments, where_none, uid), arguments);
}

base::Result<std::optional<std::string>> acting(casedb::Library& library, const Arguments& arguments,
                                                casedb::Action action, const casedb::Subject& subject) {
  std::string name = arguments.text("--by");
  if (!arguments.has("--by")) {
    if (library.actor().is_operator()) return std::optional<std::string>();
    for (const Account& one : casedb::list_users(library))  // of --token-file
      if (one.person_id == library.actor().person_id) name = one.login_name;
  }
  const auto account = casedb::account_that_may(library, name, action, subject);
  if (account) return std::optional(account->person_id);
  if (account.error().code == "not_allowed")
    casedb::audit_alone(library, casedb::Act::not_allowed,
                        {"action", casedb::kPermissions[static_cast<std::size_t>(action)].name},
                        casedb::Outcome::refused);
  return account.error();
}

base::Result<std::optional<std::string>> acting_on(casedb::Library& library, const Arguments& arguments,
                                                   casedb::Action action,
                                                   const std::optional<std::string>& person_id) {
  casedb::Subject subject;
  if (library.actor().person_id) subject = casedb::relation_to(library, *library.actor().person_id, person_id);
  return acting(library, arguments, action, subject);
}

base::Result<std::optional<std::string>> may_work_on(casedb::Library& library, const Arguments& arguments) {
  const auto row = casedb::find_case(library, arguments.positional(0));
  if (!row) return std::optional<std::string>();
  return acting(library, arguments, casedb::Action::work_on_case, row->state);
}

int refuse_act(casedb::Library& library, casedb::Act act, const base::Error& error) {
  if (error.code == "not_allowed") casedb::audit_alone(library, act, {}, casedb::Outcome::refused);
  return refuse(error);
}

}  // namespace seldinger::app
