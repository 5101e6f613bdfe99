#include "app/run_program.h"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "app/cli/version.h"
#include "app/commands.h"
#include "sim/base/failure.h"

namespace seldinger::app {
namespace {

const Command* find_command(std::span<const Command> commands, const std::vector<std::string>& words,
                            std::size_t& used) {
  for (std::size_t count : {std::size_t{2}, std::size_t{1}}) {
    if (words.size() < count) continue;
    const std::string name = count == 2 ? words[0] + " " + words[1] : words[0];
    for (const Command& command : commands)
      if (name == command.name) {
        used = count;
        return &command;
      }
  }
  return nullptr;
}

int run(std::vector<std::string> words, std::span<const Command> commands) {
  if (words.empty()) words = {"help"};
  if (words[0] == "--version") {
    std::printf("seldinger %s\n", kVersion);
    return kDone;
  }
  if (words[0] == "--help" || words[0] == "-h") words[0] = "help";
  std::size_t used = 0;
  const Command* command = find_command(commands, words, used);
  if (command == nullptr) {
    std::fputs("usage: there is no such command; `seldinger help` lists them\n", stderr);
    return kUsage;
  }
  words.erase(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(used));
  if (std::find(words.begin(), words.end(), "--help") != words.end()) {
    std::fputs(help_text(*command).c_str(), stdout);
    return kDone;
  }
  try {
    return command->run(Arguments(*command, words));
  } catch (const UsageError& error) {
    std::fprintf(stderr, "usage: %s\n%s", error.what(), help_text(*command).c_str());
    return kUsage;
  } catch (const base::Failure& failure) {
    std::fprintf(stderr, "error: %s: %s\n", failure.code().c_str(), failure.what());
    return kEnvironment;
  } catch (const std::bad_alloc&) {
    std::fputs("error: memory: there is not enough memory\n", stderr);
    return kEnvironment;
  }
}

}  // namespace

int run_program(int argc, char** argv, std::span<const Command> commands) {
  std::signal(SIGPIPE, SIG_IGN);  // a closed pipe or socket is an error to report, not a reason to die
  std::signal(SIGXFSZ, SIG_IGN);  // as is a file-size limit
  try {
    return run({argv + 1, argv + argc}, commands);
  } catch (const std::exception&) {
    // What a library says may hold a path or a value; it stays out of the error.
    std::fputs("error: internal: something unexpected went wrong\n", stderr);
    return kEnvironment;
  }
}

}  // namespace seldinger::app
