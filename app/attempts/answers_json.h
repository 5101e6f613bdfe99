// The JSON documents that commands answer.
#pragma once

#include <string>
#include <vector>

#include "assessment/metrics/metric.h"
#include "assessment/score.h"
#include "casedb/attempts/attempts.h"
#include "casedb/attempts/merge_simulated.h"
#include "casedb/cases/cases.h"
#include "casedb/grading/grading.h"
#include "casedb/json/case_json.h"
#include "casedb/people/people.h"
#include "session/attempt/simulation.h"

namespace seldinger::app {

struct PointSample {
  glm::dvec3 lps_mm{0.0};
  std::optional<double> hu_nearest, hu_trilinear;
  std::optional<std::string> tissue;       // class; nothing outside the volume
  std::optional<std::string> organ;        // by the case's labels, else as found, where it is sure
  std::optional<double> organ_confidence;  // from 0 to 1; 1 by labels
};

// What scoring attempts again has found. A difference: a value that is stored under the same version.
struct Recomputed {
  struct Difference {
    std::string attempt_id, metric_id;
    int version = 1;
    std::optional<double> stored, now;
  };
  std::size_t attempts = 0, values = 0, added = 0, steps_added = 0, not_bit_identical = 0;
  std::vector<Difference> differences;                            // by more than 1e-9 of the value
  std::vector<std::pair<std::string, base::Error>> not_scored{};  // attempts that cannot be
};

struct DemoAnswer {
  casedb::CaseRow found;
  casedb::LesionRow lesion;
  std::string lesion_rule;
  double lesion_depth_mm = 0.0;
  std::vector<session::SimulatedAttempt> attempts;
  std::vector<std::pair<std::string, std::string>> passwords;  // of accounts made in this run
  std::string url;                                             // empty when not served
};

std::string json_of_case(const casedb::CaseParts& parts);
std::string json_of_cases(const std::vector<casedb::CaseParts>& cases);
std::string json_of_samples(const std::vector<PointSample>& samples);
std::string json_of_lesion(const std::string& lesion_id);
// Metrics and steps; of a stored attempt its grade, else null.
std::string json_of_score(const assessment::Scored& scored, const casedb::AttemptGrade* grade);
std::string json_of_merged(const casedb::Merged& merged);
std::string json_of_simulation(const std::vector<session::SimulatedAttempt>& attempts);
// An attempt whose recording cannot be read has no course.
struct Course {
  std::vector<assessment::StepResult> steps;
  std::optional<std::vector<cases::Event>> events{};
};
std::string json_of_attempt(const casedb::AttemptRow& attempt, const casedb::AttemptGrade& grade,
                            const std::optional<cases::ServoRecord>& servo, const Course& course);
std::string json_of_recompute(const Recomputed& recomputed);
// `grades`: of the attempts, in their order.
std::string json_of_attempts(const std::vector<casedb::AttemptRow>& attempts,
                             const std::vector<assessment::Grade>& grades,
                             const std::vector<casedb::OpenAttempt>& running);
std::string json_of_replay(std::optional<bool> verified, std::optional<std::uint64_t> first_difference_tick,
                           const std::string& reason);
std::string json_of_users(const std::vector<casedb::Account>& accounts);
std::string json_of_demo(const DemoAnswer& demo);

}  // namespace seldinger::app
