#include <algorithm>
#include <cmath>

#include "assessment/json/object_reader_json.h"
#include "assessment/study/plan.h"

namespace seldinger::assessment::study {
namespace {

constexpr std::size_t kMostWords = 4'000, kMostName = 60, kMostList = 50;
constexpr double kFarDay = 20'000.0;

class PlanReader : public ObjectReader {
 public:
  PlanReader(const Json& json, std::string where, std::vector<base::Problem>& wrong)
      : ObjectReader(json, std::move(where), wrong, "bad_study_plan", "the plan") {}

  std::string words(const char* field, bool needed, std::size_t most = kMostWords) {
    if (!has(field)) {
      if (needed) bad(field, "is missing");
      return {};
    }
    const Json& value = json_.at(field);
    const std::string text = value.is_string() ? value.get<std::string>() : std::string();
    const bool blank = text.find_first_not_of(" \n\t") == std::string::npos;
    if (!value.is_string() || text.size() > most || (needed && blank) ||
        std::any_of(text.begin(), text.end(),
                    [](char c) { return static_cast<unsigned char>(c) < 0x20 && c != '\n'; }))
      bad(field, "must be text of 1 to " + std::to_string(most) + " bytes");
    return text;
  }
  std::string name(const char* field) {
    std::string text = words(field, true, kMostName);
    if (text.find('\n') != std::string::npos || text.starts_with(' ') || text.ends_with(' '))
      bad(field, "must be a name on one line, with no space at either end");
    return text;
  }
  double number(const char* field, std::optional<double> fallback, double least, double most) {
    if (!has(field)) {
      if (!fallback) bad(field, "is missing");
      return fallback.value_or(least);
    }
    const Json& value = json_.at(field);
    const double number = value.is_number() ? value.get<double>() : std::nan("");
    if (number >= least && number <= most) return number;
    bad(field, "must be a number in its range");
    return fallback.value_or(least);
  }
  int whole(const char* field, std::optional<double> fallback, int least, int most) {
    const double value = number(field, fallback, least, most);
    if (value != std::floor(value)) bad(field, "must be a whole number");
    return static_cast<int>(value);
  }
  template <const auto& table>
  auto choice(const char* field, std::optional<std::string_view> fallback = {}) {
    const bool there = has(field);
    const Json none;
    const Json& value = there ? json_.at(field) : none;
    const std::string text = value.is_string()    ? value.get<std::string>()
                             : !there && fallback ? std::string(*fallback)
                                                  : std::string();
    const auto found = base::from_name(table, text);
    if (!found) {
      std::string known;
      for (const std::string_view one : base::kNamesOf<table>)
        known += (known.empty() ? "" : ", ") + std::string(one);
      bad(field, "must be one of: " + known);
    }
    return found.value_or(table.front().value);
  }
  Comparison comparison(const char* field) {
    const std::string sign = words(field, true, 2);
    const auto found = comparison_from(sign);
    if (!found && !sign.empty()) bad(field, "must be one of: <=, >=, =");
    return found.value_or(Comparison::equal);
  }
  std::vector<std::string> texts(const char* field) {
    std::vector<std::string> all;
    for (const auto& [json, place] : list(field, 0, kMostList)) {
      const std::string text = json->is_string() ? json->get<std::string>() : std::string();
      if (text.empty() || text.size() > kMostWords)
        wrong_.push_back({"bad_study_plan", place + " must be text of 1 to 4000 bytes"});
      all.push_back(text);
    }
    return all;
  }
  const Json& at(const char* field) const { return json_.at(field); }
};

enum class Better { lower, higher };
constexpr auto kBetterNames = base::names<Better>({{Better::lower, "lower"}, {Better::higher, "higher"}});

Outcome read_outcome(const Json& json, const std::string& where, const Plan& plan,
                     std::vector<base::Problem>& wrong) {
  PlanReader reader(json, where, wrong);
  Outcome outcome;
  outcome.name = reader.name("name");
  outcome.metric = reader.words("metric", true, kMostName);
  outcome.version = reader.whole("version", {}, 1, 1'000'000);
  outcome.case_id = reader.words("case", true, kMostName);
  outcome.visit = reader.name("visit");
  outcome.test = reader.choice<kTestNames>("test");
  outcome.better = reader.choice<kBetterNames>("better") == Better::lower ? Direction::lower_is_better
                                                                          : Direction::higher_is_better;
  outcome.smallest_worthwhile = reader.number("smallest_worthwhile", {}, 1e-9, 1e9);
  if (reader.has("failure_value")) outcome.failure_value = reader.number("failure_value", {}, -1e9, 1e9);
  if (reader.has("impute_from")) outcome.impute_from = reader.name("impute_from");
  const auto compared = reader.list("compare", 2, 2);
  for (const auto& [name, place] : compared) {
    const std::string text = name->is_string() ? name->get<std::string>() : std::string();
    (place.ends_with("[0]") ? outcome.first : outcome.second) = text;
    if (find_group(plan, text) == nullptr)
      wrong.push_back({"bad_study_plan", place + " is not a group of the plan"});
  }
  if (compared.size() == 2 && outcome.first == outcome.second) reader.bad("compare", "names one group twice");
  if (!outcome.visit.empty() && find_visit(plan, outcome.visit) == nullptr)
    reader.bad("visit", "is not a visit of the plan");
  return outcome;
}

void read_argument(PlanReader& reader, Plan& plan, std::vector<base::Problem>& wrong) {
  for (const auto& [json, place] : reader.list("argument", 4, 4)) {
    PlanReader one(*json, place, wrong);
    Claim claim;
    claim.inference = one.choice<kInferenceNames>("inference");
    claim.claim = one.words("claim", true);
    claim.evidence = one.words("evidence", false);
    claim.rebuttals = one.texts("rebuttals");
    if (claim.rebuttals.empty()) one.bad("rebuttals", "are missing: what would undo the claim?");
    plan.argument.push_back(std::move(claim));
  }
  std::sort(plan.argument.begin(), plan.argument.end(),
            [](const Claim& a, const Claim& b) { return a.inference < b.inference; });
  for (std::size_t i = 1; i < plan.argument.size(); ++i)
    if (plan.argument[i].inference == plan.argument[i - 1].inference)
      return reader.bad("argument", "must have one claim for each of Kane's four inferences");
}

void read_groups(PlanReader& reader, Plan& plan, std::vector<base::Problem>& wrong) {
  const bool groups = reader.has("groups"), arms = reader.has("arms");
  if (groups == arms) return reader.bad("groups", "or arms: a plan has one of the two");
  plan.randomised = arms;
  for (const auto& [json, place] : reader.list(arms ? "arms" : "groups", 2, kMostGroups)) {
    PlanReader one(*json, place, wrong);
    PlannedGroup group;
    group.name = one.name("name");
    if (group.name.find(':') != std::string::npos) one.bad("name", "holds a colon");
    if (!group.name.empty() && find_group(plan, group.name) != nullptr) one.bad("name", "is also another group's");
    if (arms) group.ratio = one.whole("ratio", 1, 1, 10);
    if (!arms)
      for (const auto& [fact, at] : one.list("facts", 1, kMostList)) {
        PlanReader criterion(*fact, at, wrong);
        FactCriterion read;
        read.fact = criterion.words("fact", true, kMostName);
        read.comparison = criterion.comparison("comparison");
        if (criterion.has("value") && criterion.at("value").is_number())
          read.value = Json(criterion.at("value").get<double>()).dump();
        else
          read.value = criterion.words("value", true, kMostName);
        group.facts.push_back(std::move(read));
      }
    plan.groups.push_back(std::move(group));
  }
}

void read_randomisation(PlanReader& reader, Plan& plan, std::vector<base::Problem>& wrong) {
  if (!reader.has("randomisation")) {
    if (plan.randomised) reader.bad("randomisation", "is missing");
    return;
  }
  if (!plan.randomised) return reader.bad("randomisation", "does not belong here: the groups are not arms");
  PlanReader one(reader.at("randomisation"), "randomisation", wrong);
  plan.randomisation.strata = one.texts("strata");
  int places = 0;
  for (const PlannedGroup& arm : plan.groups) places += arm.ratio;
  for (const auto& [json, place] : one.list("block_sizes", 1, 10)) {
    const int size = json->is_number_integer() && json->get<double>() >= 1.0 && json->get<double>() <= 100.0
                         ? json->get<int>()
                         : 0;
    if (size == 0 || places == 0 || size % places != 0)
      wrong.push_back({"bad_study_plan", place + " must be a multiple, up to 100, of the sum of the arms' ratios"});
    plan.randomisation.block_sizes.push_back(size);
  }
}

void read_exclusions(PlanReader& reader, Plan& plan, std::vector<base::Problem>& wrong) {
  for (const auto& [json, place] : reader.list("exclusions", 0, kMostList)) {
    PlanReader one(*json, place, wrong);
    Exclusion exclusion;
    exclusion.metric = one.words("metric", true, kMostName);
    exclusion.comparison = one.comparison("comparison");
    exclusion.value = one.number("value", {}, -1e9, 1e9);
    exclusion.why = one.words("why", true);
    plan.exclusions.push_back(std::move(exclusion));
  }
}

void read_outcomes(PlanReader& reader, Plan& plan, std::vector<base::Problem>& wrong) {
  for (const auto& [json, place] : reader.list("primary", 1, kMostPrimary))
    plan.primary.push_back(read_outcome(*json, place, plan, wrong));
  for (const auto& [json, place] : reader.list("secondary", 0, kMostList))
    plan.secondary.push_back(read_outcome(*json, place, plan, wrong));
  std::set<std::string> names;
  for (const auto* outcomes : {&plan.primary, &plan.secondary})
    for (const Outcome& one : *outcomes)
      if (!names.insert(one.name).second) reader.bad("primary", "and secondary give two outcomes the same name");
}

// What absent people are imputed from, and whether there is anything to impute.
void check_imputation(PlanReader& reader, const Plan& plan) {
  bool of_means = false;
  for (const Outcome& one : plan.primary) of_means = of_means || one.test == Test::welch;
  if (plan.imputations != 0 && plan.imputations < kLeastImputations)
    reader.bad("missing.imputations", "are fewer than 10");
  if (plan.imputations > 0 && !of_means)
    reader.bad("missing.imputations", "do not belong here: no primary outcome has the test welch");
  if (plan.imputations > 0 && plan.absent == Absent::failure)
    reader.bad("missing.imputations", "do not belong here: absent people count as failures");
  for (const Outcome& one : plan.primary) {
    if (one.impute_from.empty()) continue;
    const auto is_named = [&](const Outcome& other) { return other.name == one.impute_from; };
    const bool known = std::any_of(plan.primary.begin(), plan.primary.end(), is_named) ||
                       std::any_of(plan.secondary.begin(), plan.secondary.end(), is_named);
    if (!known || one.impute_from == one.name) reader.bad("primary", "impute_from must name another outcome");
    if (plan.imputations == 0) reader.bad("primary", "impute_from does not belong here: missing.imputations is 0");
  }
}

void read_plan(const Json& json, Plan& plan, std::vector<base::Problem>& wrong) {
  PlanReader reader(json, "", wrong);
  plan.title = reader.words("title", true, 200);
  plan.intended_use = reader.words("intended_use", true);
  plan.decision = reader.words("decision", true);
  plan.people = reader.choice<kPeopleNames>("people", "real");
  read_argument(reader, plan, wrong);
  read_groups(reader, plan, wrong);
  read_randomisation(reader, plan, wrong);
  for (const auto& [one, place] : reader.list("visits", 1, 20)) {
    PlanReader visit(*one, place, wrong);
    Visit read{visit.name("name"), visit.number("from_day", {}, -kFarDay, kFarDay),
               visit.number("to_day", {}, -kFarDay, kFarDay)};
    if (!(read.from_day < read.to_day)) visit.bad("to_day", "is not after from_day");
    if (find_visit(plan, read.name) != nullptr) visit.bad("name", "is also another visit's");
    plan.visits.push_back(std::move(read));
  }
  read_outcomes(reader, plan, wrong);
  read_exclusions(reader, plan, wrong);
  plan.hands = reader.choice<kHandsNames>("hands", "one");
  plan.alpha = reader.number("alpha", 0.05, 0.0001, 0.2);
  const Json none = Json::object();
  {
    PlanReader stopping(reader.has("stopping") ? reader.at("stopping") : none, "stopping", wrong);
    plan.per_group = stopping.whole("per_group", {}, 2, 100'000);
    plan.stopping_rule = stopping.words("rule", true);
  }
  PlanReader missing(reader.has("missing") ? reader.at("missing") : none, "missing", wrong);
  plan.absent = missing.choice<kAbsentNames>("absent");
  plan.missing_why = missing.words("why", true);
  plan.imputations = missing.whole("imputations", 0, 0, kMostImputations);
  check_imputation(reader, plan);
}

// A whole number as one, so that 1 and 1.0 are one plan.
Json shortest(double value) {
  if (value == std::floor(value) && std::abs(value) < 0x1p53) return static_cast<std::int64_t>(value);
  return value;
}

Json json_of(const Outcome& one) {
  Json json = {{"name", one.name},
               {"metric", one.metric},
               {"version", one.version},
               {"case", one.case_id},
               {"visit", one.visit},
               {"test", base::name_of(kTestNames, one.test)},
               {"compare", {one.first, one.second}},
               {"better", one.better == Direction::lower_is_better ? "lower" : "higher"},
               {"smallest_worthwhile", shortest(one.smallest_worthwhile)}};
  if (one.failure_value) json["failure_value"] = shortest(*one.failure_value);
  if (!one.impute_from.empty()) json["impute_from"] = one.impute_from;
  return json;
}

Json json_of(const PlannedGroup& group, bool arm) {
  if (arm) return {{"name", group.name}, {"ratio", group.ratio}};
  Json facts = Json::array();
  for (const FactCriterion& one : group.facts)
    facts.push_back({{"fact", one.fact}, {"comparison", sign_of(one.comparison)}, {"value", one.value}});
  return {{"name", group.name}, {"facts", facts}};
}

}  // namespace

base::Result<Plan> plan_from_json(const std::string& text) {
  base::Error error{"bad_study_plan", "the plan is not as it should be"};
  const auto json = object_in(text, "bad_study_plan", error.findings);
  if (!json) return error;
  Plan plan;
  read_plan(*json, plan, error.findings);
  if (!error.findings.empty()) return error;
  return plan;
}

std::string canonical_json(const Plan& plan) {
  Json json = {{"title", plan.title},
               {"intended_use", plan.intended_use},
               {"decision", plan.decision},
               {"people", base::name_of(kPeopleNames, plan.people)},
               {"hands", base::name_of(kHandsNames, plan.hands)},
               {"alpha", shortest(plan.alpha)},
               {"stopping", {{"per_group", plan.per_group}, {"rule", plan.stopping_rule}}},
               {"missing", {{"absent", base::name_of(kAbsentNames, plan.absent)}, {"why", plan.missing_why}}}};
  if (plan.imputations > 0) json["missing"]["imputations"] = plan.imputations;
  for (const char* list : {"argument", "visits", "primary", "secondary", "exclusions"}) json[list] = Json::array();
  for (const Claim& one : plan.argument)
    json["argument"].push_back({{"inference", base::name_of(kInferenceNames, one.inference)},
                                {"claim", one.claim},
                                {"evidence", one.evidence},
                                {"rebuttals", one.rebuttals}});
  for (const Visit& one : plan.visits)
    json["visits"].push_back(
        {{"name", one.name}, {"from_day", shortest(one.from_day)}, {"to_day", shortest(one.to_day)}});
  for (const Outcome& one : plan.primary) json["primary"].push_back(json_of(one));
  for (const Outcome& one : plan.secondary) json["secondary"].push_back(json_of(one));
  for (const Exclusion& one : plan.exclusions)
    json["exclusions"].push_back({{"metric", one.metric},
                                  {"comparison", sign_of(one.comparison)},
                                  {"value", shortest(one.value)},
                                  {"why", one.why}});
  Json& groups = json[plan.randomised ? "arms" : "groups"] = Json::array();
  for (const PlannedGroup& one : plan.groups) groups.push_back(json_of(one, plan.randomised));
  if (plan.randomised)
    json["randomisation"] = {{"strata", plan.randomisation.strata},
                             {"block_sizes", plan.randomisation.block_sizes}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace seldinger::assessment::study
