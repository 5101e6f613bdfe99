#include <cmath>
#include <nlohmann/json.hpp>

#include "assessment/operators/person_operator.h"
#include "assessment/population/group_json.h"

namespace seldinger::assessment::population {
namespace {

using Json = nlohmann::json;

constexpr double kMostShift = 5.0;
constexpr std::size_t kLongestGroup = 64;

bool read_shift(const Json& value, double& into) {
  if (!value.is_number() || !(std::abs(value.get<double>()) <= kMostShift)) return false;
  into = value.get<double>();
  return true;
}

bool read_shifts(const Json& value, Abilities& into) {
  if (value.is_number()) {
    double shift = 0.0;
    if (!read_shift(value, shift)) return false;
    into.fill(shift);
    return true;
  }
  if (!value.is_object()) return false;
  for (const auto& [key, one] : value.items()) {
    const auto ability = base::from_name(kAbilityNames, key);
    if (!ability || !read_shift(one, into[static_cast<std::size_t>(*ability)])) return false;
  }
  return true;
}

}  // namespace

bool is_group_json(const std::string& text) {
  const Json json = Json::parse(text, nullptr, false);
  return json.is_object() && json.contains("shift");
}

base::Result<Group> group_from_json(const std::string& text) {
  const Json json = Json::parse(text, nullptr, false);
  const auto bad = [](const char* what) { return base::Error{"bad_operator", what, {}}; };
  if (!json.is_object()) return bad("the group's file is not a JSON object");
  Group group;
  for (const auto& [key, value] : json.items()) {
    if (key == "name") {
      if (!value.is_string() || value.get<std::string>().size() > kLongestGroup || value == "" ||
          value.get<std::string>() == kPersonOperator)
        return bad("name is not a short text, or a person's");
      group.name = value.get<std::string>();
    } else if (key == "shift") {
      if (!read_shifts(value, group.shift)) return bad("shift is not a number of -5 to 5, or one for each ability");
    } else if (key == "middle_years") {
      if (!value.is_number() || !(value.get<double>() > 0.0 && value.get<double>() <= 50.0))
        return bad("middle_years is not a number over 0 and up to 50");
      group.middle_years = value.get<double>();
    } else {
      return bad("the group's file holds a field that is not known");
    }
  }
  if (group.name.empty()) return bad("a group has a name");
  if (named_group(group.name)) return bad("novice, intermediate and expert are groups already");
  return group;
}

}  // namespace seldinger::assessment::population
