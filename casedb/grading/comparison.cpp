#include "casedb/grading/comparison.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "assessment/registry.h"
#include "casedb/grading/dependability.h"

namespace seldinger::casedb {
namespace {

ComparedMetric over(std::vector<double> values) {
  ComparedMetric made;
  made.n = values.size();
  if (values.empty()) return made;
  std::sort(values.begin(), values.end());
  made.median = assessment::quantile(values, 0.5);
  made.mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  made.low = values.front();
  made.high = values.back();
  return made;
}

bool same(const assessment::CriterionResult& a, const assessment::CriterionResult& b) {
  return a.criterion.metric == b.criterion.metric && a.criterion.comparison == b.criterion.comparison &&
         a.criterion.value == b.criterion.value && a.of_the_time_limit == b.of_the_time_limit;
}

const assessment::CriterionResult* find(const assessment::Grade& grade, const assessment::CriterionResult& asked) {
  const auto found =
      std::find_if(grade.criteria.begin(), grade.criteria.end(), [&](const auto& one) { return same(one, asked); });
  return found == grade.criteria.end() ? nullptr : &*found;
}

std::vector<assessment::CriterionResult> criteria_of(const CaseSetting& setting) {
  std::vector<assessment::CriterionResult> criteria;
  const assessment::Grade grade = assessment::grade(setting.rule, {{}, "", setting.time_limit_s});
  for (const assessment::Criterion& asked : setting.rule.criteria)
    for (const assessment::CriterionResult& one : grade.criteria)
      if (!one.of_the_time_limit && one.criterion.metric == asked.metric &&
          one.criterion.comparison == asked.comparison && one.criterion.value == asked.value)
        criteria.push_back(one);
  for (const assessment::CriterionResult& one : grade.criteria)
    if (one.of_the_time_limit) criteria.push_back(one);
  return criteria;
}

std::optional<double> value_of(const AttemptRow& row, const assessment::MetricInfo& info) {
  const MetricValue* found = assessment::find_version(row.metrics, info.id, info.version);
  return found != nullptr && found->value && std::isfinite(*found->value) ? found->value : std::nullopt;
}

void sum_up(ComparedGroup& group, const Comparison& comparison) {
  std::vector<const ComparedAttempt*> gradable;
  for (const ComparedAttempt& attempt : group.attempts) {
    if (!assessment::compared(attempt.row.metrics))
      ++group.not_performed;
    else if (attempt.grade.grade.reason.empty())
      gradable.push_back(&attempt);
  }
  group.gradable = gradable.size();
  for (const ComparedAttempt* attempt : gradable) {
    group.passed += attempt->grade.grade.verdict == assessment::Verdict::passed ? 1U : 0U;
    group.with_critical_errors += attempt->grade.grade.critical_errors() > 0 ? 1U : 0U;
  }
  for (const assessment::CriterionResult& asked : comparison.criteria) {
    std::vector<double> values;
    group.met.push_back(0);
    for (const ComparedAttempt* attempt : gradable) {
      const assessment::CriterionResult* one = find(attempt->grade.grade, asked);
      if (one == nullptr) continue;
      group.met.back() += one->outcome == assessment::Outcome::met ? 1U : 0U;
      if (one->value) values.push_back(*one->value);
    }
    group.of_criteria.push_back(over(std::move(values)));
  }
  for (const assessment::MetricInfo& info : comparison.metrics) {
    std::vector<double> values;
    std::vector<assessment::Contribution> contributions;
    for (const ComparedAttempt* attempt : gradable) {
      const assessment::Contribution one = assessment::contribution_of(info, attempt->row.metrics);
      if (one.counted == assessment::Counted::value) values.push_back(one.value);
      contributions.push_back(one);
    }
    group.of_metrics.push_back(over(std::move(values)));
    group.of_metrics.back().one = assessment::of_one_person(info, contributions);
  }
}

ComparedGroup& group_of(std::vector<ComparedGroup>& groups, const AttemptRow& row) {
  const bool person = by_a_person(row);
  const auto found = std::find_if(groups.begin(), groups.end(), [&](const ComparedGroup& one) {
    return person ? one.person_id == row.person_id : !one.person_id && one.operator_name == row.operator_name;
  });
  if (found != groups.end()) return *found;
  ComparedGroup& made = groups.emplace_back();
  if (person)
    made.person_id = row.person_id;
  else
    made.operator_name = row.operator_name;
  return made;
}

}  // namespace

base::Result<Comparison> compare_attempts(Library& library, const std::string& case_id,
                                          const std::string& lesion_id, std::optional<cases::Modality> modality) {
  auto row = find_case(library, case_id);
  if (!row) return row.error();
  std::vector<AttemptRow> attempts = list_attempts_on(library, case_id);
  const auto fits = [&](const AttemptRow& one) {
    return (lesion_id.empty() || one.lesion_id == lesion_id) && (!modality || one.picture.modality == *modality);
  };
  const auto newest = std::find_if(attempts.begin(), attempts.end(), fits);
  if (newest == attempts.end()) return base::Error{"no_attempt", "there is no such attempt on the case"};
  const AttemptRow first = *newest;
  Comparison made;
  made.manner = {first.picture.modality, first.approach, first.instrument.kind};
  made.lesion_id = first.lesion_id;
  made.criteria = criteria_of(*row);
  made.row = std::move(*row);
  made.other_tasks = std::erase_if(attempts, [&](const auto& one) { return task_of(one) != task_of(first); });
  std::reverse(attempts.begin(), attempts.end());  // oldest first
  for (assessment::MetricInfo info : assessment::registry()) {
    info.version = assessment::version_of(info, made.row.sight_law);
    if (info.group != assessment::Group::recording && assessment::applies(info.needs, made.manner) &&
        std::any_of(attempts.begin(), attempts.end(), [&](const auto& one) { return value_of(one, info); }))
      made.metrics.push_back(info);
  }
  Grader grader(library);
  for (AttemptRow& one : attempts) {
    AttemptGrade grade = grader.look_at(one);
    made.experts = grade.experts;
    made.provisional = grade.provisional;
    ComparedGroup& group = group_of(made.groups, one);
    group.attempts.push_back({std::move(one), std::move(grade)});
  }
  std::sort(made.groups.begin(), made.groups.end(), [](const ComparedGroup& a, const ComparedGroup& b) {
    return std::tuple(!a.person_id, a.person_id.value_or(""), a.operator_name) <
           std::tuple(!b.person_id, b.person_id.value_or(""), b.operator_name);
  });
  for (ComparedGroup& group : made.groups) sum_up(group, made);
  if (!made.row.rule.criteria.empty())
    made.dependability = dependability(learning_attempts(library, Learners::people));
  return made;
}

}  // namespace seldinger::casedb
