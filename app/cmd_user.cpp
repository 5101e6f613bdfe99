// user add, list, passwd, disable.
#include <termios.h>
#include <unistd.h>

#include <cstdio>
#include <iostream>

#include "app/answers_json.h"
#include "app/command.h"
#include "casedb/credentials.h"

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

}  // namespace

int run_user_add(const Arguments& arguments) {
  const std::string folder = arguments.required("--library");
  const auto role = casedb::role_from(arguments.required("--role"));
  if (!role) throw UsageError("--role is trainee, mentor, researcher, director or admin");
  std::string password = read_password();
  if (const auto fit = casedb::check_new_user(arguments.positional(0), password); !fit) return refuse(fit.error());
  auto library = casedb::Library::open_or_create(folder);
  if (!library) return refuse(library.error());
  const auto person = casedb::add_user(*library, arguments.positional(0), *role, password);
  casedb::wipe(password);
  if (!person) return refuse(person.error());
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
    std::printf("%-24s %-10s %s\n", account.login_name.c_str(), casedb::name_of(account.role).c_str(),
                account.enabled ? "" : "disabled");
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

int run_user_disable(const Arguments& arguments) {
  auto library = casedb::Library::open(arguments.required("--library"));
  if (!library) return refuse(library.error());
  const auto done = casedb::set_enabled(*library, arguments.positional(0), false);
  return done ? kDone : refuse(done.error());
}

}  // namespace seldinger::app
