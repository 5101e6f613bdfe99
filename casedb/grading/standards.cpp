#include "casedb/grading/standards.h"

#include <algorithm>

#include "assessment/grading/expert_set_at.h"
#include "casedb/cases/permissions.h"
#include "casedb/database/audit.h"
#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/uuid.h"
#include "sim/base/check.h"

namespace seldinger::casedb {
namespace {

using assessment::SetKind;

void add_band(Sqlite& database, const std::string& standard_id, std::size_t position,
              const assessment::MetricBand& band) {
  const auto tolerance = [&](double assessment::Interval::*end) {
    return band.tolerance ? std::optional((*band.tolerance).*end) : std::nullopt;
  };
  question(database, "add_standard_band")
      .bind("standard_id", standard_id)
      .bind("position", static_cast<std::int64_t>(position))
      .bind("metric_id", band.id)
      .bind("version", band.version)
      .bind("unit", band.unit)
      .bind("people", static_cast<std::int64_t>(band.n))
      .bind("low", band.low)
      .bind("high", band.high)
      .bind("mean", band.mean)
      .bind("sd", band.sd)
      .bind("tolerance_low", tolerance(&assessment::Interval::low))
      .bind("tolerance_high", tolerance(&assessment::Interval::high))
      .run();
}

assessment::MetricBand read_band(const Statement& from) {
  assessment::MetricBand band;
  band.id = from.text("metric_id");
  band.unit = from.text("unit");
  band.version = from.small_integer("version");
  band.n = static_cast<std::size_t>(from.integer("people"));
  band.low = from.real("low");
  band.high = from.real("high");
  band.mean = from.real("mean");
  band.sd = from.real("sd");
  if (!from.is_null("tolerance_low"))
    band.tolerance = assessment::Interval{from.real("tolerance_low"), from.real("tolerance_high")};
  return band;
}

Standard read_standard(Sqlite& database, const Statement& from) {
  Standard made;
  made.lesion_id = from.text("lesion_id");
  made.modality = from.text("picture_modality");
  made.approach = from.text("approach");
  made.instrument = from.text("instrument_kind");
  assessment::ExpertSet& set = made.set;
  set.standard_id = from.text("standard_id");
  set.id = from.text("set_id");
  set.set_us = from.integer("set_us");
  set.newest_us = from.integer("newest_us");
  set.people = static_cast<std::size_t>(from.integer("people"));
  set.attempts = static_cast<std::size_t>(from.integer("attempts"));
  Statement attempts = question(database, "standard_attempts");
  for (attempts.bind("standard_id", set.standard_id); attempts.step();) {
    set.attempt_ids.push_back(attempts.text("attempt_id"));
    if (!attempts.is_null("person_id")) set.person_ids.push_back(attempts.text("person_id"));
  }
  std::sort(set.person_ids.begin(), set.person_ids.end());
  set.person_ids.erase(std::unique(set.person_ids.begin(), set.person_ids.end()), set.person_ids.end());
  Statement bands = question(database, "standard_bands");
  for (bands.bind("standard_id", set.standard_id); bands.step();) set.bands.push_back(read_band(bands));
  return made;
}

void store(Sqlite& database, const Task& task, const assessment::ExpertSet& set, const std::string& standard_id,
           const std::string& person_id) {
  question(database, "add_standard")
      .bind("standard_id", standard_id)
      .bind("case_id", task.case_id)
      .bind("lesion_id", task.lesion_id)
      .bind("picture_modality", name_of(task.modality))
      .bind("approach", name_of(task.approach))
      .bind("instrument_kind", name_of(task.instrument))
      .bind("set_id", set.id)
      .bind("people", static_cast<std::int64_t>(set.people))
      .bind("attempts", static_cast<std::int64_t>(set.attempts))
      .bind("newest_us", set.newest_us)
      .bind("set_by", person_id)
      .bind("set_us", now_us())
      .run();
  for (const std::string& attempt_id : set.attempt_ids)
    question(database, "add_standard_attempt")
        .bind("standard_id", standard_id)
        .bind("attempt_id", attempt_id)
        .run();
  for (std::size_t i = 0; i < set.bands.size(); ++i) add_band(database, standard_id, i, set.bands[i]);
}

}  // namespace

Task task_of(const AttemptHead& attempt) {
  return {attempt.case_id, attempt.lesion_id, attempt.picture.modality, attempt.approach, attempt.instrument.kind};
}

std::vector<MetricValue> every_version(const AttemptRow& attempt) {
  std::vector<MetricValue> all = attempt.metrics;
  all.insert(all.end(), attempt.older_metrics.begin(), attempt.older_metrics.end());
  return all;
}

std::string_view cut_off_of(const AttemptRow& attempt) noexcept {
  if (attempt.end == AttemptEnd::interrupted) return "interrupted";
  if (attempt.end == AttemptEnd::device_lost) return "device_lost";
  return "";
}

bool completed(const AttemptRow& attempt, const CaseSetting& setting) noexcept {
  return attempt.end == AttemptEnd::fired || (setting.clinic.defer && attempt.end == AttemptEnd::stopped);
}

namespace {

// What is not known of older attempts does not stand against them.
bool unaided(const Conditions& conditions) noexcept {
  return !conditions.guide_used.value_or(false) && conditions.help_level.value_or(0) == 0;
}

}  // namespace

assessment::ExpertSet consultants_of(Library& library, const Task& task) {
  const auto row = find_case(library, task.case_id);
  CHECK(row.has_value());  // a task's case is in its library
  std::vector<assessment::ExpertAttempt> experts;
  for (const AttemptRow& one : list_expert_attempts(library, task.case_id, SetKind::consultants))
    if (task_of(one) == task && one.person_id)
      experts.push_back({one.attempt_id, *one.person_id, one.started_us, every_version(one),
                         completed(one, *row) && unaided(find_conditions(library, one.attempt_id))});
  return assessment::expert_set_at(row->sight_law, std::move(experts));
}

base::Result<std::string> set_standard(Library& library, const std::string& case_id, const std::string& lesion_id,
                                       std::optional<cases::Modality> modality, const std::string& by) {
  // Attempts are erased: what the set is made of is there until it is stored.
  Transaction transaction(library.database());
  const auto account = acting_account(library, by);
  if (!account) return account.error();
  const auto row = find_case(library, case_id);
  if (!row) return row.error();
  if (row->rule.criteria.empty())
    return base::Error{"no_rule", "the case has no pass rule, so a standard would have nothing to stand beside"};
  const auto lesions = list_lesions(library, case_id);
  const auto target = std::find_if(lesions.begin(), lesions.end(), [&](const LesionRow& one) {
    return lesion_id.empty() || one.lesion_id == lesion_id;
  });
  if (target == lesions.end()) return base::Error{"no_lesion", "there is no such lesion in the case"};
  const Task task{case_id, target->lesion_id, modality.value_or(row->modality), row->approach,
                  row->instrument.kind};
  const assessment::ExpertSet set = consultants_of(library, task);
  const bool own = std::binary_search(set.person_ids.begin(), set.person_ids.end(), account->person_id);
  if (const auto allowed = allow(account->role, Action::set_standard, Subject::whose(own)); !allowed)
    return allowed.error();
  if (!set.enough_people())
    return base::Error{"too_few_consultants", std::to_string(set.people) + " of " +
                                                  std::to_string(assessment::kStandardConsultants) +
                                                  " consultants have completed " +
                                                  std::to_string(assessment::kFamiliarAttempts) + " attempts"};
  if (const auto now = standard_of(library, task); now && now->id == set.id)
    return base::Error{"same_standard", "the standard in force is made of the same values"};
  std::string standard_id = new_uuid();
  store(library.database(), task, set, standard_id, account->person_id);
  audit(library, Act::set_standard, {"standard", standard_id});
  transaction.commit();
  return standard_id;
}

std::vector<Standard> list_standards(Library& library, const std::string& case_id) {
  Sqlite& database = library.database();
  std::vector<Standard> standards;
  Statement rows = question(database, "standards_of_case");
  for (rows.bind("case_id", case_id); rows.step();) {
    standards.push_back(read_standard(database, rows));
    standards.back().by_operator = entered_by_operator(database, Act::set_standard, rows.text("standard_id"));
  }
  return standards;
}

std::optional<assessment::ExpertSet> standard_of(Library& library, const Task& task) {
  for (Standard& one : list_standards(library, task.case_id))
    if (one.lesion_id == task.lesion_id && one.modality == name_of(task.modality) &&
        one.approach == name_of(task.approach) && one.instrument == name_of(task.instrument))
      return std::move(one.set);
  return std::nullopt;
}

}  // namespace seldinger::casedb
