// login, logout.
#include <unistd.h>

#include <cstdio>

#include "app/acting/acting.h"
#include "app/acting/read_password.h"
#include "app/acting/token_file.h"
#include "app/cli/command.h"
#include "casedb/database/credentials.h"
#include "casedb/people/login_session.h"
#include "casedb/people/noted_tries.h"

namespace seldinger::app {
namespace {

std::filesystem::path token_file(const Arguments& arguments, const casedb::Library& library) {
  return arguments.has("--token-file") ? std::filesystem::path(arguments.text("--token-file"))
                                       : token_file_of(library.folder());
}

int run_login(const Arguments& arguments) {
  auto library = open_library(arguments);
  if (!library) return refuse(library.error());
  auto password = read_password_of(arguments.text("--password-file", "-"));
  if (!password) return refuse(password.error());
  const auto account = casedb::log_in_by_command(*library, arguments.positional(0), *password);
  casedb::wipe(*password);
  if (!account) return refuse(account.error());
  std::string token = casedb::begin_login_session(*library, *account);
  try {
    write_token(token_file(arguments, *library), token);
  } catch (...) {
    casedb::end_login_session(*library, token);
    casedb::wipe(token);
    throw;
  }
  casedb::wipe(token);
  std::printf("logged in, role %s, for 12 hours\n", casedb::name_of(account->role).c_str());
  return kDone;
}

int run_logout(const Arguments& arguments) {
  auto library = open_library(arguments);
  if (!library) return refuse(library.error());
  const std::filesystem::path file = token_file(arguments, *library);
  auto token = read_token(file);
  if (!token) return refuse(token.error());
  if (!*token) return refuse({"no_session", "nobody is logged in here"});
  const bool ended = casedb::end_login_session(*library, **token);
  casedb::wipe(**token);
  ::unlink(file.c_str());
  std::puts(ended ? "logged out" : "the session had already ended");
  return kDone;
}

constexpr Option kLoginOptions[] = {
    kLibrary,
    {"--password-file", "FILE", "its first line is the password; default standard input"},
    {"--token-file", "FILE", "where the session is kept; default the user's state folder"}};
constexpr Option kLogoutOptions[] = {
    kLibrary, {"--token-file", "FILE", "where the session is kept; default the user's state folder"}};

}  // namespace

Command login_command() {
  return {.name = "login",
          .positionals = "NAME",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kLoginOptions,
          .summary =
              "Begins a session of 12 hours: commands with --by NAME are then that person's, not the operator's.",
          .run = &run_login};
}

Command logout_command() {
  return {.name = "logout", .options = kLogoutOptions, .summary = "Ends that session.", .run = &run_logout};
}

}  // namespace seldinger::app
