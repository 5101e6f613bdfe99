#include "app/cli/command.h"

#include <cstdio>
#include <iterator>
#include <map>
#include <sstream>

#include "app/cli/error_json.h"
#include "app/cli/words.h"

namespace seldinger::app {
namespace {

bool errors_are_json = false;  // set once, before a command runs

std::map<std::string, TypedName>& typed_of_code() {
  static std::map<std::string, TypedName> kept;
  return kept;
}

}  // namespace

std::vector<Option> options_of(const Command& command) {
  std::vector<Option> options(command.options.begin(), command.options.end());
  if (command.acts) options.insert(options.end(), std::begin(kActs), std::end(kActs));
  if (command.named) options[options.size() - std::size(kActs)].help = "in whose name: the person responsible";
  return options;
}

std::vector<std::string> words_of(const Command& command) {
  std::vector<std::string> names;
  std::istringstream words(command.positionals);
  for (std::string word; words >> word;) {
    std::erase_if(word, [](char c) { return c == '[' || c == ']'; });
    names.push_back(word);
  }
  return names;
}

void answer_errors_as_json() {
  errors_are_json = true;
}

void answer_as_json(const base::Error& error) {
  if (errors_are_json) std::fputs(json_of_error(error).c_str(), stdout);
}

void errors_are_of(const char* code, const std::string& what, const std::string& typed) {
  typed_of_code()[code] = {what, typed};
}

int fail(int exit_code, const base::Error& what_is_wrong) {
  base::Error error = what_is_wrong;
  if (const auto of = typed_of_code().find(error.code); of != typed_of_code().end())
    error = error_of(of->second.what, of->second.typed, std::move(error));
  std::fprintf(stderr, "error: %s: %s\n", error.code.c_str(), error.text.c_str());
  for (const base::Problem& finding : error.findings)
    std::fprintf(stderr, "finding: %s: %s\n", finding.code.c_str(), finding.text.c_str());
  answer_as_json(error);
  return exit_code;
}

int refuse(const base::Error& error) {
  return fail(kRefused, error);
}

}  // namespace seldinger::app
