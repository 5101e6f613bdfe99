#include "assessment/study/plan.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "assessment/registry.h"

namespace seldinger::assessment::study {
namespace {

void bad(std::vector<base::Problem>& wrong, const std::string& place, const std::string& what) {
  wrong.push_back({"bad_study_plan", place + " " + what});
}

using Laws = std::map<std::string, cases::SightLaw>;  // by case

void check_outcome(const Outcome& outcome, const Laws& laws, const std::string& place,
                   std::vector<base::Problem>& wrong) {
  const MetricInfo* info = find_metric(outcome.metric);
  if (info == nullptr) return bad(wrong, place + ".metric", "is not a metric (docs/metrics.md)");
  const auto law = laws.find(outcome.case_id);
  const int version = version_of(*info, law == laws.end() ? cases::kNewestSightLaw : law->second);
  if (version != outcome.version)
    return bad(wrong, place + ".version",
               "is not the one that is measured now at that case, " + std::to_string(version));
  if (info->group == Group::recording) bad(wrong, place + ".metric", "tells of the recording, not of the person");
  if (info->direction != Direction::none && outcome.better != info->direction)
    bad(wrong, place + ".better", "contradicts the metric's own direction");
  const bool fails = can_fail(*info);
  if (outcome.test == Test::welch && fails && !outcome.failure_value)
    bad(wrong, place + ".failure_value",
        "is missing: who neither fired nor deferred has no value for a difference of means; give one, or take "
        "brunner_munzel, which ranks them last");
  if (outcome.failure_value && (outcome.test != Test::welch || !fails))
    bad(wrong, place + ".failure_value", "does not belong here: nobody is given a value");
}

std::optional<double> number_in(std::string_view text) {
  double value = 0.0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  if (read.ec != std::errc() || read.ptr != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace

bool can_fail(const MetricInfo& info) noexcept {
  return info.estimand.without_endpoint != WithoutEndpoint::left_out &&
         info.estimand.aggregation != Aggregation::proportion;
}

std::vector<base::Problem> problems_of(const Plan& plan, const Laws& laws) {
  std::vector<base::Problem> wrong;
  for (std::size_t i = 0; i < plan.primary.size(); ++i)
    check_outcome(plan.primary[i], laws, "primary[" + std::to_string(i) + "]", wrong);
  for (std::size_t i = 0; i < plan.secondary.size(); ++i)
    check_outcome(plan.secondary[i], laws, "secondary[" + std::to_string(i) + "]", wrong);
  for (std::size_t i = 0; i < plan.exclusions.size(); ++i) {
    const MetricInfo* info = find_metric(plan.exclusions[i].metric);
    if (info == nullptr || info->group != Group::recording)
      bad(wrong, "exclusions[" + std::to_string(i) + "].metric",
          "is not a metric of the recording: attempts are left out for a poor recording, not for what was "
          "achieved");
  }
  return wrong;
}

std::vector<base::Problem> unanswered_in(const Plan& plan) {
  std::vector<base::Problem> wrong;
  const auto look = [&](const std::string& place, const std::string& words) {
    if (words.starts_with(kToReplace))
      bad(wrong, place, "still has the template's words: put your own in their place");
  };
  look("title", plan.title);
  look("intended_use", plan.intended_use);
  look("decision", plan.decision);
  for (std::size_t i = 0; i < plan.argument.size(); ++i) {
    const std::string place = "argument[" + std::to_string(i) + "]";
    look(place + ".claim", plan.argument[i].claim);
    look(place + ".evidence", plan.argument[i].evidence);
    for (std::size_t j = 0; j < plan.argument[i].rebuttals.size(); ++j)
      look(place + ".rebuttals[" + std::to_string(j) + "]", plan.argument[i].rebuttals[j]);
  }
  look("stopping.rule", plan.stopping_rule);
  look("missing.why", plan.missing_why);
  return wrong;
}

const PlannedGroup* find_group(const Plan& plan, std::string_view name) {
  const auto found = std::find_if(plan.groups.begin(), plan.groups.end(),
                                  [&](const PlannedGroup& one) { return one.name == name; });
  return found == plan.groups.end() ? nullptr : &*found;
}

const Visit* find_visit(const Plan& plan, std::string_view name) {
  const auto found =
      std::find_if(plan.visits.begin(), plan.visits.end(), [&](const Visit& one) { return one.name == name; });
  return found == plan.visits.end() ? nullptr : &*found;
}

std::vector<std::string> facts_of(const Plan& plan) {
  std::set<std::string> facts(plan.randomisation.strata.begin(), plan.randomisation.strata.end());
  for (const PlannedGroup& group : plan.groups)
    for (const FactCriterion& one : group.facts) facts.insert(one.fact);
  return {facts.begin(), facts.end()};
}

bool fits(const FactCriterion& criterion, std::string_view answer) {
  const auto wanted = number_in(criterion.value), given = number_in(answer);
  if (wanted && given) {
    if (criterion.comparison == Comparison::equal) return *given == *wanted;
    return criterion.comparison == Comparison::at_most ? *given <= *wanted : *given >= *wanted;
  }
  return criterion.comparison == Comparison::equal && !wanted && answer == criterion.value;
}

}  // namespace seldinger::assessment::study
