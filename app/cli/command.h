// What a command is, and the list of them: it drives the command line, `seldinger help` and docs/commands.md.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/cli/arguments.h"
#include "sim/base/result.h"

namespace seldinger::app {

// Exit codes, as docs/commands.md tells them.
constexpr int kDone = 0, kCheckFailed = 1, kUsage = 2, kRefused = 3, kEnvironment = 4;

struct Option {
  const char* name;   // "--library"
  const char* value;  // what follows, e.g. "DIR"; nullptr: a flag
  const char* help;
  bool repeatable = false;
};

struct Command {
  const char* name;              // one or two words
  const char* positionals = "";  // as shown, e.g. "CASE"
  std::size_t min_positionals = 0, max_positionals = 0;
  std::span<const Option> options{};
  bool acts = false;   // takes kActs too: somebody is behind it (app/acting/acting.h)
  bool named = false;  // and has to be named
  const char* summary;
  int (*run)(const Arguments&);
};

// Options that many commands share.
inline constexpr Option kLibrary{
    "--library", "DIR", "the library's folder; else the environment variable SELDINGER_LIBRARY, else the demo's"};
inline constexpr Option kNewLibrary{"--new-library", nullptr, "make the library if there is none"};
inline constexpr Option kJson{"--json", nullptr, "one JSON document on standard output, nothing else"};
inline constexpr Option kLibraryJson[] = {kLibrary, kJson};
inline constexpr Option kJsonOnly[] = {kJson};
inline constexpr Option kLibraryOnly[] = {kLibrary};

// Who is behind a command.
inline constexpr Option kActs[] = {
    {"--by", "NAME", "in whose name; default: the operator, who owns the library's files"},
    {"--password-file", "FILE",
     "proof: its first line is the password of --by; - is standard input. Without proof what is done is marked as "
     "entered by the operator"},
    {"--token-file", "FILE", "proof: a session of `seldinger login`; default the one in the user's state folder"}};
std::vector<Option> options_of(const Command& command);  // its own, and kActs where it acts

// The names of its words in the synopsis, in order: "CASE", "FILE".
std::vector<std::string> words_of(const Command& command);

// From now on errors are printed to standard output too, as --json answers them.
void answer_errors_as_json();
void answer_as_json(const base::Error& error);  // where they are
// From now on an error of that code says what was typed, too.
void errors_are_of(const char* code, const std::string& what, const std::string& typed);
// Prints a line `error: <code>: <text>` and one for each finding to standard error; returns `exit_code`.
int fail(int exit_code, const base::Error& error);
int refuse(const base::Error& error);  // fail with kRefused

}  // namespace seldinger::app
