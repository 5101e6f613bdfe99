// A library with a case, people, and attempts that have little more than a hit and a time.
#pragma once

#include "assessment/grading/rule.h"
#include "assessment/registry.h"
#include "casedb/cases/authoring.h"
#include "casedb/database/uuid.h"
#include "casedb/people/people.h"
#include "tests/casedb/library_samples.h"

namespace seldinger::casedb {

class GradedLibrary : public testing::Test {
 protected:
  Library library_ = open_library(fresh_folder() / "library");
  std::string case_id_ = add_case(library_, sample_case());
  std::string lesion_id_ = add_lesion(library_, case_id_, sample_lesion()).value();

  void rule(std::initializer_list<const char*> criteria, std::optional<double> time_limit_s = {},
            std::optional<int> attempt_limit = {}) {
    CaseSetting setting = find_case(library_, case_id_).value();
    setting.rule.criteria.clear();
    for (const char* text : criteria) setting.rule.criteria.push_back(assessment::criterion_from(text).value());
    setting.time_limit_s = time_limit_s;
    setting.attempt_limit = attempt_limit;
    ASSERT_TRUE(set_setting(library_, case_id_, setting).has_value());
  }
  std::string user(const std::string& name, Role role) {
    return add_user(library_, name, role, "a long password").value();
  }
  // As it is measured now.
  static MetricValue metric(const char* id, std::optional<double> value) {
    const assessment::MetricInfo* info = assessment::find_metric(id);
    return {id, info->version, value, info->unit, value ? "" : "no_endpoint"};
  }
  NewAttempt new_attempt(const std::optional<std::string>& person_id, std::optional<double> hit, double time_s) {
    NewAttempt made = sample_attempt(case_id_, lesion_id_);
    made.recording = sample_recording(20);
    made.picture_png.clear();
    made.person_id = person_id;
    made.operator_name = person_id ? kPersonOperator : "novice";
    made.started_us = now_us();
    made.end = AttemptEnd::fired;
    const CaseRow row = find_case(library_, case_id_).value();
    made.approach = row.approach;
    made.instrument.kind = row.instrument.kind;
    made.picture.modality = row.modality;
    made.metrics = {metric("gap_share", 0.0), metric("sample_rate_p5", 1000.0), metric("tracking_jumps", 0.0),
                    metric("hit", hit), metric("time_total", time_s)};
    return made;
  }
  std::string attempt(const std::optional<std::string>& person_id, std::optional<double> hit, double time_s) {
    return add_attempt(library_, new_attempt(person_id, hit, time_s)).value();
  }
};

}  // namespace seldinger::casedb
