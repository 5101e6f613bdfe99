// What the commands about studies answer.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "casedb/people/consent.h"
#include "casedb/studies/enrolments.h"
#include "casedb/studies/lock.h"
#include "casedb/studies/looks.h"
#include "casedb/studies/study_data.h"

namespace seldinger::app {

std::string json_of_studies(const std::vector<casedb::Study>& studies);
// {"study_id","plan_sha256","frozen_us", …}; of a draft the time is null.
std::string json_of_plan(const casedb::StoredPlan& plan);
// The same with the plan itself, its people, looks and deviations.
std::string json_of_lock(const casedb::StoredPlan& plan, const casedb::StudyLock& lock);
std::string json_of_study(const casedb::Study& study, const casedb::StoredPlan& plan,
                          const std::optional<casedb::StudyLock>& lock,
                          const std::vector<casedb::StudyEnrolment>& enrolments,
                          const std::vector<casedb::StudyNote>& looks,
                          const std::vector<casedb::StudyNote>& deviations);

// Somebody who was to be enrolled: where they are, or why not.
struct Enrolled {
  std::vector<casedb::StudyEnrolment> enrolments;
  std::vector<base::Problem> refused;  // a code each, and how many
};
std::string json_of_enrolled(const Enrolled& enrolled);

// Before the freeze: {"blinded":true,"consenting","simulated","with_attempts","attempts"}.
std::string json_of_blinded(const casedb::StoredPlan& plan, const casedb::BlindedCounts& counts);
std::string json_of_result(const casedb::StoredPlan& plan, const assessment::study::StudyResult& result,
                           const casedb::ParticipantFlow& flow, const std::string& data_hash);

}  // namespace seldinger::app
