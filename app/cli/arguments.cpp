#include "app/cli/arguments.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "app/cli/command.h"
#include "app/cli/words.h"

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

namespace {

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

bool holds_capital(const std::string& word) {
  return std::any_of(word.begin(), word.end(), [](char c) { return c >= 'A' && c <= 'Z'; });
}

// Where an option's value is one of a few words ("access|core"), anything else is wrong use. A capital stands for
// what is free: "FILE.json" for whatever ends so. A list that ends in … is not a whole one.
void check_choice(const Option& option, const std::string& typed) {
  const std::string form = option.value;
  if (form.find('|') == std::string::npos || form.find(',') != std::string::npos ||
      form.find("…") != std::string::npos)
    return;
  std::vector<std::string> all, words;
  for (std::size_t begin = 0; begin <= form.size();) {
    const std::size_t end = std::min(form.find('|', begin), form.size());
    all.push_back(form.substr(begin, end - begin));
    begin = end + 1;
  }
  for (const std::string& one : all) {
    if (!holds_capital(one)) words.push_back(one);
    const std::size_t dot = one.find('.');
    if (holds_capital(one) ? dot == std::string::npos || typed.ends_with(one.substr(dot)) : one == typed) return;
  }
  throw UsageError(std::string(option.name) + " is " + one_of(all) + ", not " + shown(typed) +
                   did_you_mean(typed, words));
}

}  // namespace

glm::dvec3 point_of(const std::string& option, const std::string& typed) {
  const auto point = parse_point(typed);
  if (!point) throw UsageError(option + " is X,Y,Z in mm, not " + shown(typed));
  return *point;
}

std::filesystem::path file_of(const std::string& option, const std::string& typed,
                              const std::vector<std::string>& endings) {
  std::filesystem::path file = typed;
  if (std::find(endings.begin(), endings.end(), file.extension()) == endings.end())
    throw UsageError(option + " ends in " + one_of(endings) + ", unlike " + shown(typed));
  return file;
}

Arguments::Arguments(const Command& command, const std::vector<std::string>& words)
    : command_(command.name), words_(words), names_(words_of(command)) {
  const std::vector<Option> options = options_of(command);
  bool options_ended = false;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (word == kEndOfOptions && !options_ended) {
      options_ended = true;
      continue;
    }
    if (options_ended || word.size() < 3 || word.rfind("--", 0) != 0) {
      positionals_.push_back(word);
      continue;
    }
    const auto found =
        std::find_if(options.begin(), options.end(), [&](const Option& option) { return word == option.name; });
    if (found == options.end()) {
      std::vector<std::string> names;
      for (const Option& option : options) names.emplace_back(option.name);
      throw UsageError("there is no option " + shown(word) + did_you_mean(word, names));
    }
    auto& values = values_[word];
    if (!values.empty() && !found->repeatable) throw UsageError(word + " was given twice");
    if (found->value == nullptr) {
      values.emplace_back();
    } else {
      if (i + 1 == words.size()) throw UsageError(word + " needs a value: " + found->value);
      check_choice(*found, words[++i]);
      kinds_[word] = found->value;
      values.push_back(words[i]);
    }
  }
  if (positionals_.size() < command.min_positionals)
    throw UsageError(words_of(command).at(positionals_.size()) + " is missing");
  if (positionals_.size() > command.max_positionals)
    throw UsageError(shown(positionals_[command.max_positionals]) + " is one word too many");
}

const std::string& Arguments::typed(const std::string& what) const {
  const auto found = values_.find(what);
  if (found != values_.end()) return found->second.back();
  const auto name = std::find(names_.begin(), names_.end(), what);
  return positionals_.at(static_cast<std::size_t>(name - names_.begin()));
}

std::vector<TypedName> Arguments::names(std::string_view kind) const {
  std::vector<TypedName> found;
  for (std::size_t i = 0; i < std::min(names_.size(), positionals_.size()); ++i)
    if (names_[i] == kind) found.push_back({names_[i], positionals_[i], i});
  for (const auto& [option, takes] : kinds_) {
    if (takes != kind) continue;
    const std::vector<std::string>& values = all(option);
    for (std::size_t i = 0; i < values.size(); ++i) found.push_back({option, values[i], i});
  }
  return found;
}

void Arguments::settle(const TypedName& name, const std::string& id) const {
  const auto found = values_.find(name.what);
  (found == values_.end() ? positionals_ : found->second).at(name.place) = id;
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
  if (!value) throw UsageError(option + " is a number, not " + shown(text(option)));
  return *value;
}

double Arguments::number(const std::string& option, double fallback, double min, double max) const {
  const double value = number(option, fallback);
  char text[80];
  std::snprintf(text, sizeof text, "%g to %g", min, max);
  if (!(value >= min && value <= max)) throw UsageError(option + " is " + text + ", not " + shown(typed(option)));
  return value;
}

long long Arguments::whole(const std::string& option, long long fallback, long long min, long long max) const {
  if (!has(option)) return fallback;
  const std::string value = text(option);
  long long number = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  if (error != std::errc() || end != value.data() + value.size() || number < min || number > max)
    throw UsageError(option + " is a whole number from " + std::to_string(min) + " to " + std::to_string(max) +
                     ", not " + shown(value));
  return number;
}

}  // namespace seldinger::app
