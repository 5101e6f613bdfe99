#include "assessment/grading/rule_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace seldinger::assessment {
namespace {

using Json = nlohmann::ordered_json;
constexpr std::size_t kMostCriteria = 100;

void read_criterion(const Json& json, const std::string& where, cases::SightLaw law, PassRule& rule,
                    std::vector<base::Problem>& wrong) {
  const auto bad = [&](const char* what) { wrong.push_back({"bad_criterion", where + ": " + what}); };
  if (!json.is_object()) return bad("is not an object");
  for (const auto& [key, value] : json.items())
    if (key != "metric" && key != "version" && key != "comparison" && key != "value" && key != "critical")
      return bad("holds an unknown field");
  Criterion one;
  const Json none;
  const auto field = [&](const char* name) -> const Json& { return json.contains(name) ? json.at(name) : none; };
  if (!field("metric").is_string()) return bad("needs a metric's id");
  one.metric = field("metric").get<std::string>();
  one.version = version_in_force(one.metric, law);
  if (json.contains("version")) {
    if (!field("version").is_number_integer() || field("version").get<std::int64_t>() < 1 ||
        field("version").get<std::int64_t>() > 1'000'000)
      return bad("version is a whole number from 1");
    one.version = field("version").get<int>();
  }
  const auto comparison =
      field("comparison").is_string() ? comparison_from(field("comparison").get<std::string>()) : std::nullopt;
  if (!comparison) return bad("comparison is <=, >= or =");
  one.comparison = *comparison;
  if (!field("value").is_number() || !std::isfinite(field("value").get<double>())) return bad("needs a value");
  one.value = field("value").get<double>();
  if (json.contains("critical")) {
    if (!field("critical").is_boolean()) return bad("critical is true or false");
    one.critical = field("critical").get<bool>();
  }
  rule.criteria.push_back(one);
}

}  // namespace

std::string json_of_rule(const PassRule& rule) {
  Json criteria = Json::array();
  for (const Criterion& one : rule.criteria)
    criteria.push_back({{"metric", one.metric},
                        {"version", one.version},
                        {"comparison", sign_of(one.comparison)},
                        {"value", one.value},
                        {"critical", one.critical}});
  return Json{{"criteria", criteria}}.dump(-1, ' ', false, Json::error_handler_t::replace);
}

base::Result<PassRule> rule_from_json(const std::string& text, cases::SightLaw law) {
  base::Error error{"bad_rule", "the pass rule is not valid"};
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains("criteria") || !json.at("criteria").is_array() || json.size() != 1 ||
      json.at("criteria").size() > kMostCriteria) {
    error.findings.push_back({"bad_rule", "a rule is an object with a list `criteria`, and nothing else"});
    return error;
  }
  PassRule rule;
  for (std::size_t i = 0; i < json.at("criteria").size(); ++i)
    read_criterion(json.at("criteria")[i], "criterion " + std::to_string(i + 1), law, rule, error.findings);
  if (!error.findings.empty()) return error;
  return rule;
}

}  // namespace seldinger::assessment
