// user add, list, passwd, invite, reset, level, role, disable, enable, unlock.
#include <cstdio>

#include "app/acting/acting.h"
#include "app/acting/read_password.h"
#include "app/attempts/answers_json.h"
#include "app/cli/command.h"
#include "casedb/database/credentials.h"
#include "casedb/people/noted_tries.h"
#include "casedb/people/password_links.h"

namespace seldinger::app {
namespace {

constexpr const char* kPagesAt = "http://127.0.0.1:8080";

std::optional<casedb::Level> level_of(const Arguments& arguments) {
  if (!arguments.has("--level")) return std::nullopt;
  const auto level = casedb::level_from(arguments.text("--level"));
  if (!level) throw UsageError("--level is student, trainee or consultant");
  return level;
}

int run_user_add(const Arguments& arguments) {
  const auto role = casedb::role_from(arguments.required("--role"));
  if (!role) throw UsageError("--role is trainee, mentor, researcher, director or admin");
  const auto level = level_of(arguments);
  // A library is not made for what is refused; where one is, nobody types a password in vain.
  const bool may_make = arguments.has("--new-library");
  const bool password_first = may_make && arguments.text("--password-file") != "-";
  std::string password = password_first ? read_password() : "";
  if (password_first)
    if (const auto fit = casedb::check_new_user(arguments.positional(0), password); !fit)
      return refuse(fit.error());
  auto library = open_acting(arguments, may_make ? WhereNone::create : WhereNone::refuse);
  if (!library) {
    base::Error error = library.error();
    if (error.code == "no_library") error.text += "; --new-library makes one";
    return refuse(error);
  }
  if (const auto by = acting(*library, arguments, casedb::Action::manage_accounts); !by) return refuse(by.error());
  if (!password_first) password = read_password();
  const auto person = casedb::add_user(*library, arguments.positional(0), *role, password);
  casedb::wipe(password);
  if (!person) return refuse(person.error());
  if (level)
    if (const auto done = casedb::set_level(*library, arguments.positional(0), *level); !done)
      return refuse(done.error());
  std::printf("added, role %s\n", casedb::name_of(*role).c_str());
  return kDone;
}

int run_user_list(const Arguments& arguments) {
  auto library = open_library(arguments);
  if (!library) return refuse(library.error());
  const auto accounts = casedb::list_users(*library);
  if (arguments.has("--json")) {
    std::fputs(json_of_users(accounts).c_str(), stdout);
    return kDone;
  }
  for (const casedb::Account& account : accounts)
    std::printf("%-24s %-10s %-10s %s\n", account.login_name.c_str(), casedb::name_of(account.role).c_str(),
                account.level ? casedb::name_of(*account.level).c_str() : "–", account.enabled ? "" : "disabled");
  return kDone;
}

int run_user_passwd(const Arguments& arguments) {
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  std::optional<std::string> whose;
  if (const auto account = casedb::open_account(*library, arguments.positional(0))) whose = account->person_id;
  if (const auto by = acting_on(*library, arguments, casedb::Action::set_password, whose); !by)
    return refuse(by.error());
  std::string password = read_password();
  const auto done = casedb::set_password(*library, arguments.positional(0), password);
  casedb::wipe(password);
  return done ? kDone : refuse(done.error());
}

int run_user_level(const Arguments& arguments) {
  const auto level = level_of(arguments);
  if (!level) throw UsageError("--level is needed");
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  if (const auto by = acting(*library, arguments, casedb::Action::manage_accounts); !by) return refuse(by.error());
  const auto done = casedb::set_level(*library, arguments.positional(0), *level);
  return done ? kDone : refuse(done.error());
}

int run_user_role(const Arguments& arguments) {
  const auto role = casedb::role_from(arguments.required("--role"));
  if (!role) throw UsageError("--role is trainee, mentor, researcher, director or admin");
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  if (const auto by = acting(*library, arguments, casedb::Action::manage_accounts); !by) return refuse(by.error());
  const auto done = casedb::set_role(*library, arguments.positional(0), *role);
  return done ? kDone : refuse(done.error());
}

int enable(const Arguments& arguments, bool enabled) {
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  if (const auto by = acting(*library, arguments, casedb::Action::manage_accounts); !by) return refuse(by.error());
  const auto done = casedb::set_enabled(*library, arguments.positional(0), enabled);
  return done ? kDone : refuse(done.error());
}

int run_user_unlock(const Arguments& arguments) {
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  if (const auto by = acting(*library, arguments, casedb::Action::let_in_again); !by) return refuse(by.error());
  const auto done = casedb::let_in_again(*library, arguments.positional(0));
  return done ? kDone : refuse(done.error());
}

int print_link(const Arguments& arguments, base::Result<casedb::PasswordLink> link) {
  if (!link) return refuse(link.error());
  std::printf("%s/password?link=%s\n", arguments.text("--at", kPagesAt).c_str(), link->secret.c_str());
  casedb::wipe(link->secret);
  return kDone;
}

int run_user_invite(const Arguments& arguments) {
  const auto role = casedb::role_from(arguments.required("--role"));
  if (!role) throw UsageError("--role is trainee, mentor, researcher, director or admin");
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  if (const auto by = acting(*library, arguments, casedb::Action::manage_accounts); !by) return refuse(by.error());
  return print_link(arguments, casedb::invite_user(*library, arguments.positional(0), *role));
}

int run_user_reset(const Arguments& arguments) {
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  if (const auto by = acting(*library, arguments, casedb::Action::manage_accounts); !by) return refuse(by.error());
  return print_link(arguments, casedb::make_password_link(*library, arguments.positional(0)));
}

constexpr Option kLevelOption{"--level", "student|trainee|consultant",
                              "who somebody is from now on: attempts of consultants set the standard"};

constexpr Option kRoleOption{"--role", "trainee|mentor|researcher|director|admin", "the role"};
constexpr Option kUserAddOptions[] = {kLibrary, kRoleOption, kLevelOption, kNewLibrary};
constexpr Option kAtOption{"--at", "URL", "where the pages are served; default http://127.0.0.1:8080"};
constexpr Option kUserInviteOptions[] = {kLibrary, kRoleOption, kAtOption};
constexpr Option kUserResetOptions[] = {kLibrary, kAtOption};
constexpr Option kUserRoleOptions[] = {kLibrary, kRoleOption};

constexpr Option kUserLevelOptions[] = {kLibrary, kLevelOption};

}  // namespace

Command user_add_command() {
  return {.name = "user add",
          .positionals = "NAME",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kUserAddOptions,
          .acts = true,
          .summary = "Adds an account; the password is read from standard input.",
          .run = &run_user_add};
}

Command user_list_command() {
  return {.name = "user list", .options = kLibraryJson, .summary = "Lists the accounts.", .run = &run_user_list};
}

Command user_passwd_command() {
  return {.name = "user passwd",
          .positionals = "NAME",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kLibraryOnly,
          .acts = true,
          .summary = "Sets a password, read from standard input.",
          .run = &run_user_passwd};
}

Command user_invite_command() {
  return {
      .name = "user invite",
      .positionals = "NAME",
      .min_positionals = 1,
      .max_positionals = 1,
      .options = kUserInviteOptions,
      .acts = true,
      .summary =
          "Adds an account without a password, and prints a link with which its owner sets one, once and within "
          "seven days.",
      .run = &run_user_invite};
}

Command user_reset_command() {
  return {
      .name = "user reset",
      .positionals = "NAME",
      .min_positionals = 1,
      .max_positionals = 1,
      .options = kUserResetOptions,
      .acts = true,
      .summary =
          "Prints a link with which somebody sets their password anew, once and within a day; the old one holds "
          "until then.",
      .run = &run_user_reset};
}

Command user_level_command() {
  return {.name = "user level",
          .positionals = "NAME",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kUserLevelOptions,
          .acts = true,
          .summary = "Sets who somebody is from now on; earlier attempts count as before.",
          .run = &run_user_level};
}

Command user_disable_command() {
  return {.name = "user disable",
          .positionals = "NAME",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kLibraryOnly,
          .acts = true,
          .summary = "Closes an account, which ends its sessions; its attempts stay. The last admin stays open.",
          .run = [](const Arguments& arguments) { return enable(arguments, false); }};
}

Command user_enable_command() {
  return {.name = "user enable",
          .positionals = "NAME",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kLibraryOnly,
          .acts = true,
          .summary = "Opens an account again.",
          .run = [](const Arguments& arguments) { return enable(arguments, true); }};
}

Command user_unlock_command() {
  return {.name = "user unlock",
          .positionals = "NAME",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kLibraryOnly,
          .acts = true,
          .summary =
              "Lets somebody whom wrong passwords delay log in again at once: here, on the dashboard and at a "
              "window.",
          .run = &run_user_unlock};
}

Command user_role_command() {
  return {.name = "user role",
          .positionals = "NAME",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kUserRoleOptions,
          .acts = true,
          .summary = "Changes a role and ends the person's sessions; the last admin stays one.",
          .run = &run_user_role};
}

}  // namespace seldinger::app
