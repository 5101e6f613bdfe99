#include "casedb/grading/grading.h"

#include <algorithm>

#include "sim/base/check.h"

namespace seldinger::casedb {

bool has_standard(Library& library, const CaseRow& row) {
  const std::vector<Standard> standards = list_standards(library, row.case_id);
  return !row.rule.criteria.empty() && std::any_of(standards.begin(), standards.end(), [&](const Standard& one) {
    return one.modality == name_of(row.modality) && one.approach == name_of(row.approach) &&
           one.instrument == name_of(row.instrument.kind);
  });
}

bool by_a_person(const AttemptHead& attempt) noexcept {
  return attempt.operator_name == kPersonOperator && attempt.person_id.has_value();
}

assessment::Grade grade_of(const AttemptRow& attempt, const CaseSetting& setting) {
  const std::vector<MetricValue> metrics = every_version(attempt);
  return assessment::grade(setting.rule, {metrics, cut_off_of(attempt), setting.time_limit_s});
}

const CaseSetting& Grader::setting_of(const std::string& case_id) {
  const auto known = settings_.find(case_id);
  if (known != settings_.end()) return known->second;
  const auto row = find_case(*library_, case_id);
  CHECK(row.has_value());  // an attempt's case is in its library
  return settings_.emplace(case_id, *row).first->second;
}

const assessment::ExpertSet& Grader::experts_of(const AttemptRow& attempt) {
  const Task task = task_of(attempt);
  const auto known = experts_.find(task);
  if (known != experts_.end()) return known->second;
  auto standard = standard_of(*library_, task);
  if (!standard) {
    standard = consultants_of(*library_, task);
    standard->bands.clear();
  }
  return experts_.emplace(task, std::move(*standard)).first->second;
}

assessment::Grade Grader::grade(const AttemptRow& attempt) {
  return grade_of(attempt, setting_of(attempt.case_id));
}

AttemptGrade Grader::look_at(const AttemptRow& attempt) {
  const std::vector<MetricValue> metrics = every_version(attempt);
  const CaseSetting& setting = setting_of(attempt.case_id);
  const assessment::Gradable gradable{metrics, cut_off_of(attempt), setting.time_limit_s};
  AttemptGrade made;
  made.experts = experts_of(attempt);
  made.provisional = !made.experts.standard();
  made.grade = assessment::grade(setting.rule, gradable);
  made.score = assessment::score(made.experts, made.grade, gradable,
                                 by_a_person(attempt) ? std::string_view(*attempt.person_id) : std::string_view());
  made.debrief = assessment::debrief(made.grade, gradable, made.experts);
  return made;
}

}  // namespace seldinger::casedb
