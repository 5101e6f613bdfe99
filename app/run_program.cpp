#include "app/run_program.h"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "app/cli/version.h"
#include "app/cli/words.h"
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

// What is wrong with a command's name: of a noun alone, or one beside the mark.
std::string no_such_command(const std::vector<std::string>& words, std::span<const Command> commands) {
  std::vector<std::string> names = {"--version"}, of_noun;
  for (const Command& command : commands) {
    const std::string name = command.name, noun = name.substr(0, name.find(' '));
    names.push_back(name);
    if (name != noun && noun == words[0]) of_noun.push_back(name.substr(noun.size() + 1));
  }
  if (!of_noun.empty()) {
    if (words.size() == 1 || words[1].starts_with("-")) return words[0] + " what? It goes with " + one_of(of_noun);
    return words[0] + " goes with " + one_of(of_noun) + ", not " + shown(words[1]) +
           did_you_mean(words[1], of_noun);
  }
  const std::string both = words.size() > 1 ? words[0] + " " + words[1] : words[0];
  const std::string meant = did_you_mean(both, names);
  return "there is no command " + shown(words[0]) + (meant.empty() ? did_you_mean(words[0], names) : meant);
}

// A word after a command that takes none: "simulate study" is meant for "study simulate".
std::string one_too_many(const std::string& word, const Command& command, std::span<const Command> commands) {
  const std::string turned = word + " " + command.name;
  for (const Command& one : commands)
    if (turned == one.name)
      return "there is no command " + shown(std::string(command.name) + " " + word) + "; did you mean " + turned +
             "?";
  return shown(word) + " is one word too many";
}

int misused(const std::string& text, const std::string& where_to_look) {
  std::fprintf(stderr, "usage: %s\n%s\n", text.c_str(), where_to_look.c_str());
  answer_as_json(base::Error{"usage", text});
  return kUsage;
}

int run(std::vector<std::string> words, std::span<const Command> commands) {
  if (std::find(words.begin(), words.end(), "--json") != words.end()) answer_errors_as_json();
  if (words.empty()) words = {"help"};
  if (words[0] == "--version") {
    std::printf("seldinger %s\n", kVersion);
    return kDone;
  }
  if (words[0] == "--help" || words[0] == "-h") words[0] = "help";
  std::size_t used = 0;
  const Command* command = find_command(commands, words, used);
  if (command == nullptr) {
    const bool noun = !help_text_of_noun(words[0]).empty();
    return misused(no_such_command(words, commands), noun ? "`seldinger help " + words[0] + "` tells what each does"
                                                          : "`seldinger help` lists the commands");
  }
  words.erase(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(used));
  const std::string where_to_look = std::string("`seldinger help ") + command->name + "` tells what it takes";
  if (command->max_positionals == 0 && !words.empty() && !words[0].starts_with("-"))
    return misused(one_too_many(words[0], *command, commands), where_to_look);
  const auto end_of_options = std::find(words.begin(), words.end(), kEndOfOptions);
  if (std::find(words.begin(), end_of_options, "--help") != end_of_options) {
    std::fputs(help_text(*command).c_str(), stdout);
    return kDone;
  }
  try {
    return command->run(Arguments(*command, words));
  } catch (const UsageError& error) {
    return misused(error.what(), where_to_look);
  } catch (const base::Failure& failure) {
    return fail(kEnvironment, {failure.code(), failure.what()});
  } catch (const std::bad_alloc&) {
    return fail(kEnvironment, base::Error{"memory", "there is not enough memory"});
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
    return fail(kEnvironment, base::Error{"internal", "something unexpected went wrong"});
  }
}

}  // namespace seldinger::app
