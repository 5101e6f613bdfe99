#include <nlohmann/json.hpp>

#include "assessment/operators/person_operator.h"
#include "assessment/operators/profile.h"

namespace seldinger::assessment {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kLongestName = 64;

struct Reader {
  base::Error error{"bad_operator", "", {}};

  void number(const std::string& name, const Json& value, double min, double max, double& into) {
    if (!value.is_number() || !(value.get<double>() >= min && value.get<double>() <= max))
      error.findings.push_back({"bad_field", name + " is not a number in its range"});
    else
      into = value.get<double>();
  }
  // One of novice, intermediate and expert; nothing, told, otherwise.
  std::optional<OperatorProfile> group(const std::string& name, const Json& value) {
    auto found = value.is_string() ? named_profile(value.get<std::string>()) : std::nullopt;
    if (!found) error.findings.push_back({"bad_field", name + " is not novice, intermediate, expert or learner"});
    return found;
  }
};

}  // namespace

base::Result<OperatorProfile> profile_from_json(const std::string& text) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) return base::Error{"bad_operator", "the operator's file is not a JSON object"};
  Reader reader;
  OperatorProfile profile = *named_profile("expert");
  if (json.contains("like"))
    if (const auto like = reader.group("like", json["like"])) profile = *like;
  profile.name = "custom";
  for (const auto& [key, value] : json.items()) {
    if (key == "like") continue;
    if (key == "name") {
      if (value.is_string() && value.get<std::string>().size() <= kLongestName &&
          value.get<std::string>() != kPersonOperator && value != "")
        profile.name = value.get<std::string>();
      else
        reader.error.findings.push_back({"bad_field", "name is not a short text, or a person's"});
      continue;
    }
    const SkillField* found = nullptr;
    for (const SkillField& field : skill_fields())
      if (key == field.name) found = &field;
    if (found != nullptr) {
      reader.number(key, value, found->min, found->max, profile.*found->value);
    } else if (key == "person_spread") {
      reader.number(key, value, 0.0, 2.0, profile.person_spread);
    } else if (key == "learning_rate") {
      reader.number(key, value, 0.0, 10.0, profile.learning.rate);
    } else if (key == "attempts_before") {
      reader.number(key, value, 0.0, 1e6, profile.learning.before);
    } else if (key == "learns_towards") {
      if (const auto towards = reader.group(key, value)) profile.learning.towards = *towards;
    } else if (key == "learning_law") {
      if (value == "exponential" || value == "power")
        profile.learning.law = value == "power" ? LearningLaw::power : LearningLaw::exponential;
      else
        reader.error.findings.push_back({"bad_field", "learning_law is not exponential or power"});
    } else {
      reader.error.findings.push_back({"unknown_field", "the operator's file holds a field that is not known"});
    }
  }
  base::Error& error = reader.error;
  if (!error.findings.empty()) {
    error.text = error.findings.front().text;
    error.findings.erase(error.findings.begin());
    return error;
  }
  return profile;
}

}  // namespace seldinger::assessment
