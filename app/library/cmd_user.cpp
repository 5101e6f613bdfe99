// user add, list, passwd, level, disable.
#include <termios.h>
#include <unistd.h>

#include <cstdio>
#include <iostream>

#include "app/attempts/answers_json.h"
#include "app/cli/command.h"
#include "casedb/database/credentials.h"

namespace seldinger::app {
namespace {

// One line of standard input; not echoed on a terminal.
std::string read_password() {
  const bool terminal = ::isatty(STDIN_FILENO) != 0;
  termios before{};
  if (terminal) {
    std::fputs("Password: ", stderr);
    ::tcgetattr(STDIN_FILENO, &before);
    termios silent = before;
    silent.c_lflag &= ~static_cast<tcflag_t>(ECHO);
    ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &silent);
  }
  std::string line;
  std::getline(std::cin, line);
  if (terminal) {
    ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &before);
    std::fputs("\n", stderr);
  }
  if (!line.empty() && line.back() == '\r') line.pop_back();
  return line;
}

std::optional<casedb::Level> level_of(const Arguments& arguments) {
  if (!arguments.has("--level")) return std::nullopt;
  const auto level = casedb::level_from(arguments.text("--level"));
  if (!level) throw UsageError("--level is student, trainee or consultant");
  return level;
}

int run_user_add(const Arguments& arguments) {
  const std::string folder = arguments.required("--library");
  const auto role = casedb::role_from(arguments.required("--role"));
  if (!role) throw UsageError("--role is trainee, mentor, researcher, director or admin");
  const auto level = level_of(arguments);
  std::string password = read_password();
  if (const auto fit = casedb::check_new_user(arguments.positional(0), password); !fit) return refuse(fit.error());
  auto library = casedb::Library::open_or_create(folder);
  if (!library) return refuse(library.error());
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
  auto library = casedb::Library::open(arguments.required("--library"));
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
  const std::string folder = arguments.required("--library");
  std::string password = read_password();
  auto library = casedb::Library::open(folder);
  if (!library) return refuse(library.error());
  const auto done = casedb::set_password(*library, arguments.positional(0), password);
  casedb::wipe(password);
  return done ? kDone : refuse(done.error());
}

int run_user_level(const Arguments& arguments) {
  const auto level = level_of(arguments);
  if (!level) throw UsageError("--level is needed");
  auto library = casedb::Library::open(arguments.required("--library"));
  if (!library) return refuse(library.error());
  const auto done = casedb::set_level(*library, arguments.positional(0), *level);
  return done ? kDone : refuse(done.error());
}

int run_user_disable(const Arguments& arguments) {
  auto library = casedb::Library::open(arguments.required("--library"));
  if (!library) return refuse(library.error());
  const auto done = casedb::set_enabled(*library, arguments.positional(0), false);
  return done ? kDone : refuse(done.error());
}

constexpr Option kLevelOption{"--level", "student|trainee|consultant",
                              "who somebody is from now on: attempts of consultants set the standard"};

constexpr Option kUserAddOptions[] = {
    kLibrary, {"--role", "trainee|mentor|researcher|director|admin", "the role"}, kLevelOption};

constexpr Option kUserLevelOptions[] = {kLibrary, kLevelOption};

}  // namespace

Command user_add_command() {
  return {.name = "user add",
          .positionals = "NAME",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kUserAddOptions,
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
          .summary = "Sets a password, read from standard input.",
          .run = &run_user_passwd};
}

Command user_level_command() {
  return {.name = "user level",
          .positionals = "NAME",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kUserLevelOptions,
          .summary = "Sets who somebody is from now on; earlier attempts count as before.",
          .run = &run_user_level};
}

Command user_disable_command() {
  return {.name = "user disable",
          .positionals = "NAME",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kLibraryOnly,
          .summary = "Closes an account; its attempts stay.",
          .run = &run_user_disable};
}

}  // namespace seldinger::app
