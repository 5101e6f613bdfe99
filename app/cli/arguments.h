// What was typed after a command's name, checked against the command's row of the table.
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace seldinger::app {

struct Command;

// Wrong use: the text goes to standard error with the command's synopsis, exit 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// What follows is no option, whatever it begins with (POSIX.1-2017, XBD 12.2, guideline 10).
inline constexpr const char* kEndOfOptions = "--";

// Something that has an id, as it was called on the command line: `what` is the option or the word of the synopsis,
// `place` which of the option's values it is, or which of all words.
struct TypedName {
  std::string what;
  std::string typed;
  std::size_t place = 0;
};

class Arguments {
 public:
  // `words` are those after the command's name. An option's value may begin with '-'. Throws UsageError.
  Arguments(const Command& command, const std::vector<std::string>& words);

  const std::string& positional(std::size_t i) const { return positionals_.at(i); }
  const std::string& command() const noexcept { return command_; }           // "goals haptics"
  const std::vector<std::string>& words() const noexcept { return words_; }  // as they were typed
  std::size_t positionals() const noexcept { return positionals_.size(); }
  bool has(const std::string& option) const { return values_.contains(option); }
  // What was typed as an option's value ("--rule") or as the word of that name in the synopsis ("CASE").
  const std::string& typed(const std::string& what) const;
  // What was typed where the synopsis has that word, "CASE": of the words and of options ("--case CASE").
  std::vector<TypedName> names(std::string_view kind) const;
  // From now on positional(), text() and all() give its id in the place of what was typed (app/acting/names.h).
  void settle(const TypedName& name, const std::string& id) const;
  // The option's value; `fallback` when it was not given.
  std::string text(const std::string& option, const std::string& fallback = {}) const;
  const std::vector<std::string>& all(const std::string& option) const;
  // Throws UsageError when the option must be there and is not.
  std::string required(const std::string& option) const;
  double number(const std::string& option, double fallback) const;
  double number(const std::string& option, double fallback, double min, double max) const;
  long long whole(const std::string& option, long long fallback, long long min, long long max) const;

 private:
  std::string command_;
  std::vector<std::string> words_;
  std::vector<std::string> names_;            // of the words, as the synopsis has them
  std::map<std::string, std::string> kinds_;  // what options take: "--case", "CASE"
  // A command gets its arguments as they are; what it is called becomes an id when its library is open.
  mutable std::vector<std::string> positionals_;
  mutable std::map<std::string, std::vector<std::string>> values_;
};

// "X,Y,Z" in finite numbers; throws UsageError otherwise.
glm::dvec3 point_of(const std::string& option, const std::string& typed);
// A file whose name ends in one of these (".png"); throws UsageError otherwise.
std::filesystem::path file_of(const std::string& option, const std::string& typed,
                              const std::vector<std::string>& endings);
// The whole text as a finite number; nothing otherwise. Independent of the locale.
std::optional<double> parse_number(const std::string& text);

}  // namespace seldinger::app
