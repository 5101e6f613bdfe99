// What was typed after a command's name, checked against the command's row of the table.
#pragma once

#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace seldinger::app {

struct Command;

// Wrong use: the text goes to standard error with the command's synopsis, exit 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
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
  // The option's value; `fallback` when it was not given.
  std::string text(const std::string& option, const std::string& fallback = {}) const;
  const std::vector<std::string>& all(const std::string& option) const;
  // Throws UsageError when the option must be there and is not.
  std::string required(const std::string& option) const;
  double number(const std::string& option, double fallback) const;
  long long whole(const std::string& option, long long fallback, long long min, long long max) const;

 private:
  std::string command_;
  std::vector<std::string> words_;
  std::vector<std::string> positionals_;
  std::map<std::string, std::vector<std::string>> values_;
};

// "X,Y,Z" in finite numbers; nothing otherwise.
std::optional<glm::dvec3> parse_point(const std::string& text);
// The whole text as a finite number; nothing otherwise. Independent of the locale.
std::optional<double> parse_number(const std::string& text);

}  // namespace seldinger::app
