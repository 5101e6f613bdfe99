#include "casedb/grading/grading.h"

#include "sim/base/check.h"

namespace seldinger::casedb {
namespace {

using assessment::SetKind;

// The newest versions first, so that whoever looks for one by id alone finds that.
std::vector<MetricValue> every_version(const AttemptRow& attempt) {
  std::vector<MetricValue> all = attempt.metrics;
  all.insert(all.end(), attempt.older_metrics.begin(), attempt.older_metrics.end());
  return all;
}

// How an attempt ended through no decision of whoever made it.
std::string_view cut_off_of(const AttemptRow& attempt) {
  if (attempt.end == AttemptEnd::interrupted) return "interrupted";
  if (attempt.end == AttemptEnd::device_lost) return "device_lost";
  return "";
}

auto graded_task_of(const AttemptRow& row) {
  return std::tuple(row.case_id, row.lesion_id, row.picture.modality, row.approach, row.instrument.kind);
}

assessment::ExpertAttempt expert_attempt(const AttemptRow& row) {
  return {row.attempt_id, row.person_id.value_or(""), row.started_us, every_version(row)};
}

assessment::ExpertSet set_of(Library& library, const AttemptRow& attempt, SetKind kind) {
  std::vector<assessment::ExpertAttempt> experts;
  for (const AttemptRow& row : list_expert_attempts(library, attempt.case_id, kind))
    if (graded_task_of(row) == graded_task_of(attempt) && cut_off_of(row).empty())
      experts.push_back(expert_attempt(row));
  return assessment::expert_set(kind, std::move(experts));
}

}  // namespace

bool has_standard(Library& library, const CaseRow& row) {
  if (row.rule.criteria.empty()) return false;
  std::map<std::string, std::vector<assessment::ExpertAttempt>> of_lesion;
  for (const AttemptRow& one : list_expert_attempts(library, row.case_id, SetKind::consultants))
    if (one.picture.modality == row.modality && one.approach == row.approach &&
        one.instrument.kind == row.instrument.kind && cut_off_of(one).empty())
      of_lesion[one.lesion_id].push_back(expert_attempt(one));
  for (auto& [lesion_id, attempts] : of_lesion)
    if (assessment::expert_set(SetKind::consultants, std::move(attempts)).standard()) return true;
  return false;
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

const Grader::Experts& Grader::experts_of(const AttemptRow& attempt) {
  const Task task = graded_task_of(attempt);
  const auto known = experts_.find(task);
  if (known != experts_.end()) return known->second;
  Experts experts;
  experts.consultants = set_of(*library_, attempt, SetKind::consultants);
  if (experts.consultants.bands.empty()) experts.simulated = set_of(*library_, attempt, SetKind::simulated);
  return experts_.emplace(task, std::move(experts)).first->second;
}

assessment::Grade Grader::grade(const AttemptRow& attempt) {
  return grade_of(attempt, setting_of(attempt.case_id));
}

AttemptGrade Grader::look_at(const AttemptRow& attempt) {
  const std::vector<MetricValue> metrics = every_version(attempt);
  const CaseSetting& setting = setting_of(attempt.case_id);
  const assessment::Gradable gradable{metrics, cut_off_of(attempt), setting.time_limit_s};
  const Experts& experts = experts_of(attempt);
  AttemptGrade made;
  made.grade = assessment::grade(setting.rule, gradable);
  made.provisional = !experts.consultants.standard();
  made.experts = experts.simulated.bands.empty() ? experts.consultants : experts.simulated;
  made.score = assessment::score(experts.consultants, made.grade, gradable,
                                 by_a_person(attempt) ? std::string_view(*attempt.person_id) : std::string_view());
  made.debrief = assessment::debrief(made.grade, gradable, made.experts);
  return made;
}

}  // namespace seldinger::casedb
