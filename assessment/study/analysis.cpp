#include "assessment/study/analysis.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "assessment/grading/standard.h"
#include "assessment/registry.h"
#include "assessment/statistics/groups/groups_procedures.h"
#include "assessment/statistics/relations/imputation.h"
#include "sim/base/check.h"

namespace seldinger::assessment::study {
namespace {

using statistics::Answer;

// The metric as the plan's version of it: what is stored of that version is looked at, whatever is measured now.
std::optional<MetricInfo> planned_metric(const Outcome& outcome) {
  const MetricInfo* info = find_metric(outcome.metric);
  if (info == nullptr) return std::nullopt;
  MetricInfo planned = *info;
  planned.version = outcome.version;
  return planned;
}

bool is_excluded(const Exclusion& exclusion, const StudyAttempt& attempt) {
  const MetricValue* newest = nullptr;
  for (const MetricValue& one : attempt.metrics)
    if (one.id == exclusion.metric && (newest == nullptr || one.version > newest->version)) newest = &one;
  if (newest == nullptr || !newest->value) return false;
  if (exclusion.comparison == Comparison::equal) return *newest->value == exclusion.value;
  return exclusion.comparison == Comparison::at_most ? *newest->value <= exclusion.value
                                                     : *newest->value >= exclusion.value;
}

// Why an attempt does not count; empty: it does.
std::string why_left_out(const Plan& plan, const Outcome& outcome, const Visit& visit,
                         const StudyAttempt& attempt) {
  if (attempt.synthetic != (plan.people == People::simulated))
    return attempt.synthetic ? "made by a simulated operator"
                             : "made by a person, in a study of simulated operators";
  if (attempt.case_id != outcome.case_id) return "at another case";
  if (attempt.day < visit.from_day || attempt.day > visit.to_day) return "outside of the visit's days";
  if (attempt.too_late) return "begun after the data were locked";
  if (!attempt.cut_off.empty()) return attempt.cut_off;
  for (const Exclusion& one : plan.exclusions)
    if (is_excluded(one, attempt)) return one.why;
  if (!compared(attempt.metrics)) return "the procedure was not performed";
  return {};
}

bool has_version(const StudyAttempt& attempt, const Outcome& outcome, bool exactly) {
  return std::any_of(attempt.metrics.begin(), attempt.metrics.end(), [&](const MetricValue& one) {
    return one.id == outcome.metric && (!exactly || one.version == outcome.version);
  });
}

void note(std::vector<LeftOut>& left_out, const std::string& why) {
  const auto found =
      std::find_if(left_out.begin(), left_out.end(), [&](const LeftOut& one) { return one.why == why; });
  if (found == left_out.end())
    left_out.push_back({why, 1});
  else
    ++found->attempts;
}

GroupSum sum_of(const std::string& group, const std::vector<PersonValue>& people) {
  GroupSum sum;
  sum.name = group;
  std::vector<double> values;
  for (const PersonValue& one : people) {
    if (one.group != group) continue;
    ++sum.persons;
    sum.attempts += one.attempts;
    if (one.standing == Standing::value) values.push_back(one.value);
    sum.failures += one.standing == Standing::failure ? 1U : 0U;
    sum.censored += one.standing == Standing::censored ? 1U : 0U;
    sum.absent += one.standing == Standing::absent ? 1U : 0U;
  }
  sum.with_value = values.size();
  if (values.empty()) return sum;
  std::sort(values.begin(), values.end());
  sum.median = quantile(values, 0.5);
  sum.low_quartile = quantile(values, 0.25);
  sum.high_quartile = quantile(values, 0.75);
  return sum;
}

// What stands in the place of those without a value, by group; none: they are left out.
enum class Stead { left_out, worst, best };
struct Rule {
  Stead failed = Stead::worst;
  Stead absent_first = Stead::left_out, absent_second = Stead::left_out;
};

Rule rule_of(const Plan& plan) {
  Rule rule;
  if (plan.absent == Absent::failure) rule.absent_first = rule.absent_second = Stead::worst;
  return rule;
}

// Values better or worse than any that was seen, for a test of order; the plan's failure_value for one of means.
std::optional<double> stands_for(Stead stead, const Outcome& outcome, double low, double high) {
  if (stead == Stead::left_out) return std::nullopt;
  const bool at_high_end = (stead == Stead::worst) == (outcome.better == Direction::lower_is_better);
  if (outcome.test == Test::welch) {
    if (stead == Stead::worst && outcome.failure_value) return outcome.failure_value;
    return at_high_end ? high : low;
  }
  // One step beyond, in the data's own scale: only its rank counts.
  const double step = std::max(high - low, std::max({std::abs(low), std::abs(high), 1.0}) * 1e-3);
  return at_high_end ? high + step : low - step;
}

const statistics::Procedure& procedure_of(Test test) {
  for (const statistics::Procedure& one : statistics::groups_procedures())
    if (one.name == base::name_of(kTestNames, test)) return one;
  CHECK(false);
}

Answer tested(const Outcome& outcome, const std::vector<PersonValue>& people, const Rule& rule) {
  double low = 0.0, high = 0.0;
  bool any = false;
  for (const PersonValue& one : people) {
    if (one.standing != Standing::value) continue;
    low = any ? std::min(low, one.value) : one.value;
    high = any ? std::max(high, one.value) : one.value;
    any = true;
  }
  statistics::DataTable table;
  table.values.push_back({outcome.metric, {}});
  for (const PersonValue& one : people) {
    std::optional<double> value;
    if (one.standing == Standing::value)
      value = one.value;
    else if (one.standing == Standing::absent)
      value = stands_for(one.group == outcome.first ? rule.absent_first : rule.absent_second, outcome, low, high);
    else
      value = stands_for(rule.failed, outcome, low, high);
    if (!value) continue;
    table.values.front().values.push_back(*value);
    table.group.push_back(one.group);
    table.subject.push_back(one.name);
    ++table.rows;
  }
  // `order` names both groups, and a procedure takes a name that no row bears for a slip.
  for (const std::string& group : {outcome.first, outcome.second})
    if (std::find(table.group.begin(), table.group.end(), group) == table.group.end())
      return statistics::not_estimable(std::string(base::name_of(kTestNames, outcome.test)), "too_few", table.rows);
  const statistics::ProcedureOptions options({{"order", outcome.first + ":" + outcome.second}});
  return procedure_of(outcome.test).run(table, options);
}

// Whether the numbers of a comparison are of all who were measured, as the distance between medians is not when
// some have a rank alone.
void tell_of_failures(Compared& compared) {
  const std::size_t failed =
      compared.first.failures + compared.first.censored + compared.second.failures + compared.second.censored;
  if (failed == 0) return;
  if (compared.outcome.test == Test::welch)
    compared.answer.notes.push_back(std::to_string(failed) +
                                    " persons failed and count as the plan's failure_value.");
  else
    compared.answer.notes.push_back(std::to_string(failed) +
                                    " persons failed and rank last: shifts in the metric's unit mean little here.");
}

void compare(const Plan& plan, const std::vector<StudyPerson>& people, Compared& made) {
  const Outcome& outcome = made.outcome;
  if (!planned_metric(outcome)) {
    made.refused = "The metric is no longer in the registry.";
    return;
  }
  Collected collected = collect(plan, outcome, people, made.hand);
  for (PersonValue& one : collected.people)
    if (one.group == outcome.first || one.group == outcome.second) made.people.push_back(std::move(one));
  made.left_out = std::move(collected.left_out);
  made.hands = std::move(collected.hands);
  made.first = sum_of(outcome.first, made.people);
  made.second = sum_of(outcome.second, made.people);
  if (collected.other_versions > 0) {
    made.refused = std::to_string(collected.other_versions) +
                   " attempts have the metric in a version other than the plan's " +
                   std::to_string(outcome.version) +
                   ": what is measured differently is not compared. `seldinger recompute` adds versions.";
    return;
  }
  if (made.hands.size() > 1 && plan.hands == Hands::one) {
    made.refused = "The needle was led by different kinds of hands (";
    for (std::size_t i = 0; i < made.hands.size(); ++i) made.refused += (i == 0 ? "" : ", ") + made.hands[i];
    made.refused += "), and the plan does not compare them together.";
    return;
  }
  made.answer = tested(outcome, made.people, rule_of(plan));
  tell_of_failures(made);
  if (made.first.failures + made.first.censored + made.second.failures + made.second.censored > 0)
    made.sensitivity.push_back({OtherRule::present, "only who has a value",
                                tested(outcome, made.people, {Stead::left_out, Stead::left_out, Stead::left_out})});
  if (made.first.absent + made.second.absent > 0) {
    made.sensitivity.push_back({OtherRule::best_in_first,
                                "absent: best in " + outcome.first + ", worst in " + outcome.second,
                                tested(outcome, made.people, {Stead::worst, Stead::best, Stead::worst})});
    made.sensitivity.push_back({OtherRule::worst_in_first,
                                "absent: worst in " + outcome.first + ", best in " + outcome.second,
                                tested(outcome, made.people, {Stead::worst, Stead::worst, Stead::best})});
  }
}

// Whether somebody came to each visit: made an attempt within its days at a case of the plan.
bool came_to_every_visit(const Plan& plan, const StudyPerson& person) {
  const auto is_of_plan = [&](const StudyAttempt& attempt) {
    const auto at_case = [&](const Outcome& one) { return one.case_id == attempt.case_id; };
    return attempt.synthetic == (plan.people == People::simulated) &&
           (std::any_of(plan.primary.begin(), plan.primary.end(), at_case) ||
            std::any_of(plan.secondary.begin(), plan.secondary.end(), at_case));
  };
  return std::all_of(plan.visits.begin(), plan.visits.end(), [&](const Visit& visit) {
    return std::any_of(person.attempts.begin(), person.attempts.end(), [&](const StudyAttempt& one) {
      return visit.from_day <= one.day && one.day <= visit.to_day && is_of_plan(one);
    });
  });
}

void add_per_protocol(const Plan& plan, const std::set<std::string>& missed, Compared& compared) {
  std::vector<PersonValue> kept;
  bool otherwise = false;  // whether the comparison is another one
  for (PersonValue& one : compared.people) {
    one.every_visit = !missed.contains(one.name);
    if (one.every_visit)
      kept.push_back(one);
    else
      otherwise = otherwise || one.standing != Standing::absent || plan.absent == Absent::failure;
  }
  if (otherwise)
    compared.sensitivity.push_back({OtherRule::per_protocol, "per protocol: only who came to every visit",
                                    tested(compared.outcome, kept, rule_of(plan))});
}

void add_tipping(const Plan& plan, Compared& compared) {
  const Answer& answer = compared.answer;
  const GroupSum &first = compared.first, &second = compared.second;
  if (first.absent + second.absent == 0 || !first.median || !second.median || !answer.estimate || !answer.p_value ||
      !(*answer.p_value < plan.alpha))
    return;
  const Outcome& outcome = compared.outcome;
  const bool larger = *answer.estimate > (outcome.test == Test::brunner_munzel ? 0.5 : 0.0);
  const bool first_is_better = larger == (outcome.better == Direction::higher_is_better);
  const double worse = outcome.better == Direction::lower_is_better ? 1.0 : -1.0;
  double low = *first.median, high = low;
  for (const PersonValue& one : compared.people) {
    if (one.standing != Standing::value) continue;
    low = std::min(low, one.value);
    high = std::max(high, one.value);
  }
  const auto at = [&](double shift) {
    std::vector<PersonValue> moved = compared.people;
    for (PersonValue& one : moved) {
      if (one.standing != Standing::absent) continue;
      const bool is_first = one.group == outcome.first;
      one.standing = Standing::value;
      one.value =
          (is_first ? *first.median : *second.median) + (is_first == first_is_better ? worse : -worse) * shift;
    }
    return tested(outcome, moved, rule_of(plan));
  };
  const auto goes = [&](const Answer& one) { return !one.p_value || !(*one.p_value < plan.alpha); };
  constexpr int kSteps = 20, kHalvings = 10;
  const double range = high - low;
  double holds = 0.0, shift = 0.0;
  Answer there = at(shift);
  for (int step = 1; step <= kSteps && !goes(there); ++step) {
    holds = shift;
    shift = range * step / kSteps;
    there = at(shift);
  }
  const bool found = goes(there);
  for (int i = 0; i < kHalvings && found && shift > holds; ++i) {
    const double middle = 0.5 * (holds + shift);
    Answer here = at(middle);
    if (goes(here)) {
      shift = middle;
      there = std::move(here);
    } else {
      holds = middle;
    }
  }
  compared.sensitivity.push_back(
      {OtherRule::tipping,
       found ? "absent: at their group’s median, shifted against the conclusion until it goes"
             : "absent: at their group’s median, shifted against the conclusion, which stays",
       std::move(there), shift});
}

// The values of the outcome that absent people are imputed from; empty: the plan names none.
std::map<std::string, double> impute_from(const StudyResult& result, const Compared& compared) {
  std::map<std::string, double> by_name;
  for (const auto* outcomes : {&result.primary, &result.secondary})
    for (const Compared& other : *outcomes) {
      if (other.outcome.name != compared.outcome.impute_from || other.hand != compared.hand) continue;
      for (const PersonValue& one : other.people)
        if (one.standing == Standing::value) by_name[one.name] = one.value;
    }
  return by_name;
}

void add_imputed(const Plan& plan, const StudyResult& result, Compared& compared) {
  const Outcome& outcome = compared.outcome;
  if (plan.imputations == 0 || outcome.test != Test::welch || compared.first.absent + compared.second.absent == 0)
    return;
  const std::map<std::string, double> from = impute_from(result, compared);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  statistics::DataTable table;
  table.values.push_back({outcome.metric, {}});
  // Both groups one after the other, as the draws are.
  for (const std::string& group : {outcome.first, outcome.second})
    for (const PersonValue& one : compared.people) {
      if (one.group != group) continue;
      const bool is_there = one.standing != Standing::absent;
      const std::optional<double> value = one.standing == Standing::value ? one.value : outcome.failure_value;
      if (is_there && !value) continue;
      table.values.front().values.push_back(is_there ? *value : nan);
      table.group.push_back(group);
      const auto found = from.find(one.name);
      table.x.push_back(found == from.end() ? nan : found->second);
      ++table.rows;
    }
  if (outcome.impute_from.empty()) table.x.clear();
  const statistics::ProcedureOptions options(
      {{"order", outcome.first + ":" + outcome.second}, {"draws", std::to_string(plan.imputations)}});
  statistics::ImputedComparison made = statistics::imputed_comparison(table, options);
  compared.sensitivity.push_back(
      {OtherRule::imputed,
       "absent: drawn " + std::to_string(plan.imputations) + " times from what others of their group " +
           (outcome.impute_from.empty() ? "have" : "with such “" + outcome.impute_from + "” have") +
           ", pooled by Rubin’s rules",
       std::move(made.answer),
       {},
       std::move(made.draws)});
}

// Where the plan parts by hands, one for each; else one.
std::vector<Compared> compare_all(const Plan& plan, const std::vector<Outcome>& outcomes,
                                  const std::vector<StudyPerson>& people) {
  std::vector<Compared> all;
  for (const Outcome& outcome : outcomes) {
    std::vector<std::string> hands{std::string()};
    if (plan.hands == Hands::stratified && planned_metric(outcome))
      if (auto found = collect(plan, outcome, people, {}).hands; !found.empty()) hands = std::move(found);
    for (const std::string& hand : hands) {
      Compared& made = all.emplace_back();
      made.outcome = outcome;
      made.hand = hand;
      compare(plan, people, made);
    }
  }
  return all;
}

}  // namespace

Collected collect(const Plan& plan, const Outcome& outcome, const std::vector<StudyPerson>& people,
                  const std::string& hand) {
  const auto info = planned_metric(outcome);
  const Visit* visit = find_visit(plan, outcome.visit);
  CHECK(info && visit != nullptr);
  Collected collected;
  std::set<std::string> hands;
  for (const StudyPerson& person : people) {
    PersonValue value{person.name, person.group, Standing::absent, 0.0, 0};
    std::vector<Contribution> contributions;
    for (const StudyAttempt& attempt : person.attempts) {
      std::string why = why_left_out(plan, outcome, *visit, attempt);
      const std::string led_by = attempt.hand.empty() ? "unknown" : attempt.hand;
      if (why.empty() && !hand.empty() && led_by != hand) why = "led by another kind of hand";
      if (why.empty() && !has_version(attempt, outcome, true)) {
        if (has_version(attempt, outcome, false)) ++collected.other_versions;
        why = "without this version of the metric";
      }
      const Contribution one = why.empty() ? contribution_of(*info, attempt.metrics) : Contribution{};
      if (why.empty() && one.counted == Counted::left_out) why = "the metric says nothing about it";
      if (!why.empty()) {
        note(collected.left_out, why);
        continue;
      }
      contributions.push_back(one);
      if (one.counted == Counted::value) value.values.push_back(one.value);
      hands.insert(led_by);
      value.hands.insert(led_by);
      value.arms.insert(attempt.arm.empty() ? "none" : attempt.arm);
    }
    const OnePerson sum = of_one_person(*info, contributions);
    value.attempts = contributions.size();
    if (sum.estimate) {
      value.standing = Standing::value;
      value.value = *sum.estimate;
    } else if (sum.worst) {
      value.standing = sum.failures >= sum.censored ? Standing::failure : Standing::censored;
    }
    collected.people.push_back(std::move(value));
  }
  collected.hands.assign(hands.begin(), hands.end());
  return collected;
}

std::vector<std::optional<double>> holm_adjusted(const std::vector<std::optional<double>>& p) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p[i]) order.push_back(i);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return *p[a] < *p[b]; });
  std::vector<std::optional<double>> adjusted(p.size());
  double least = 0.0;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    least = std::max(least, std::min(1.0, static_cast<double>(p.size() - rank) * *p[order[rank]]));
    adjusted[order[rank]] = least;
  }
  return adjusted;
}

StudyResult analyse(const Plan& plan, const std::vector<StudyPerson>& people) {
  StudyResult result{compare_all(plan, plan.primary, people), compare_all(plan, plan.secondary, people), true};
  std::vector<std::optional<double>> p;
  for (const Compared& one : result.primary) p.push_back(one.refused.empty() ? one.answer.p_value : std::nullopt);
  const auto adjusted = holm_adjusted(p);
  for (std::size_t i = 0; i < result.primary.size(); ++i) {
    Compared& one = result.primary[i];
    one.p_adjusted = adjusted[i];
    for (const GroupSum* sum : {&one.first, &one.second})
      if (sum->persons < sum->absent + static_cast<std::size_t>(plan.per_group)) result.stopped = false;
  }
  return result;
}

void add_sensitivity(const Plan& plan, const std::vector<StudyPerson>& people, StudyResult& result) {
  std::set<std::string> missed;
  for (const StudyPerson& one : people)
    if (!came_to_every_visit(plan, one)) missed.insert(one.name);
  for (Compared& one : result.primary) {
    if (!one.refused.empty()) continue;
    add_per_protocol(plan, missed, one);
    add_tipping(plan, one);
    add_imputed(plan, result, one);
  }
}

}  // namespace seldinger::assessment::study
