#include "app/cli/arguments.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "app/cli/command.h"

namespace seldinger::app {

std::optional<double> parse_number(const std::string& text) {
  double value = 0.0;
  const char* first = text.data();
  const char* last = first + text.size();
  if (first != last && *first == '+') ++first;
  const auto [end, error] = std::from_chars(first, last, value);
  if (error != std::errc() || end != last || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<glm::dvec3> parse_point(const std::string& text) {
  glm::dvec3 point(0.0);
  std::size_t begin = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t comma = text.find(',', begin);
    if ((comma == std::string::npos) != (axis == 2)) return std::nullopt;
    const auto value = parse_number(text.substr(begin, comma == std::string::npos ? comma : comma - begin));
    if (!value) return std::nullopt;
    point[axis] = *value;
    begin = comma + 1;
  }
  return point;
}

Arguments::Arguments(const Command& command, const std::vector<std::string>& words)
    : command_(command.name), words_(words) {
  const std::vector<Option> options = options_of(command);
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (word.size() < 3 || word.rfind("--", 0) != 0) {
      positionals_.push_back(word);
      continue;
    }
    const auto found =
        std::find_if(options.begin(), options.end(), [&](const Option& option) { return word == option.name; });
    if (found == options.end()) throw UsageError("unknown option " + word);
    auto& values = values_[word];
    if (!values.empty() && !found->repeatable) throw UsageError(word + " was given twice");
    if (found->value == nullptr) {
      values.emplace_back();
    } else {
      if (i + 1 == words.size()) throw UsageError(word + " needs a value");
      values.push_back(words[++i]);
    }
  }
  if (positionals_.size() < command.min_positionals) throw UsageError("something is missing");
  if (positionals_.size() > command.max_positionals) throw UsageError("too many words");
}

std::string Arguments::text(const std::string& option, const std::string& fallback) const {
  const auto found = values_.find(option);
  return found == values_.end() ? fallback : found->second.back();
}

const std::vector<std::string>& Arguments::all(const std::string& option) const {
  static const std::vector<std::string> kNone;
  const auto found = values_.find(option);
  return found == values_.end() ? kNone : found->second;
}

std::string Arguments::required(const std::string& option) const {
  if (!has(option)) throw UsageError(option + " is missing");
  return text(option);
}

double Arguments::number(const std::string& option, double fallback) const {
  if (!has(option)) return fallback;
  const auto value = parse_number(text(option));
  if (!value) throw UsageError(option + " is not a number");
  return *value;
}

long long Arguments::whole(const std::string& option, long long fallback, long long min, long long max) const {
  if (!has(option)) return fallback;
  const std::string value = text(option);
  long long number = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  if (error != std::errc() || end != value.data() + value.size() || number < min || number > max)
    throw UsageError(option + " is not a whole number from " + std::to_string(min) + " to " + std::to_string(max));
  return number;
}

}  // namespace seldinger::app
