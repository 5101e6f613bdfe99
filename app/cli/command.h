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
  bool acts = false;  // takes kActs too: somebody is behind it (app/acting/acting.h)
  const char* summary;
  int (*run)(const Arguments&);
};

// Options that many commands share.
inline constexpr Option kLibrary{"--library", "DIR", "the library's folder"};
inline constexpr Option kJson{"--json", nullptr, "one JSON document on standard output, nothing else"};
inline constexpr Option kLibraryJson[] = {kLibrary, kJson};
inline constexpr Option kJsonOnly[] = {kJson};
inline constexpr Option kLibraryOnly[] = {kLibrary};

// Who is behind a command.
inline constexpr Option kActs[] = {
    {"--by", "NAME", "in whose name; left out: the operator's, who has the library's files"},
    {"--password-file", "FILE",
     "proof: its first line is the password of --by; - is standard input. Without proof the operator acts, and it "
     "is "
     "marked so"},
    {"--token-file", "FILE", "proof: a session of `seldinger login`; default the one in the user's state folder"}};
std::vector<Option> options_of(const Command& command);  // its own, and kActs where it acts

// Prints `error: <code>: <text>` and the findings to standard error; returns kRefused.
int refuse(const base::Error& error);

}  // namespace seldinger::app
