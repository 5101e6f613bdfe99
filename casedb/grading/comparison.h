// Attempts on one task side by side, a group for each person and each simulated operator. What is simulated never
// stands in one group with people.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "assessment/estimand.h"
#include "assessment/statistics/answer.h"
#include "casedb/grading/grading.h"

namespace seldinger::casedb {

struct ComparedMetric {
  std::size_t n = 0;             // attempts with a value; of a metric, one that counts
  double median = 0.0;           // of those; n of 0: none
  double mean = 0.0;             // of a yes and no, the share
  double low = 0.0, high = 0.0;  // least and most
  // As the metric's estimand has it (assessment/estimand.h): one value of all of the group's attempts that count.
  // Of a criterion none.
  assessment::OnePerson one{};
};

struct ComparedAttempt {
  AttemptRow row;
  AttemptGrade grade;
};

struct ComparedGroup {
  std::string operator_name;             // of a simulated operator
  std::optional<std::string> person_id;  // of a person
  // Comparisons are among attempts in which the procedure was performed; the others are left out of all below.
  std::size_t not_performed = 0;
  std::size_t gradable = 0, passed = 0, with_critical_errors = 0;  // of the performed
  std::vector<std::size_t> met;                                    // of the gradable, a count for each criterion
  std::vector<ComparedMetric> of_criteria, of_metrics;             // of the gradable
  std::vector<ComparedAttempt> attempts;                           // oldest first
};

struct Comparison {
  CaseRow row;
  assessment::Manner manner;
  std::string lesion_id;
  std::vector<assessment::CriterionResult> criteria;  // in the rule's order, then the time limit; no values
  std::vector<assessment::MetricInfo> metrics;        // that some attempt has, as measured now at the case
  std::vector<ComparedGroup> groups;                  // people, then the simulated, by name
  assessment::ExpertSet experts;
  bool provisional = true;
  // Of passing cases of the library, by what people did (casedb/grading/dependability.h); none: the case has no
  // rule.
  std::optional<assessment::statistics::Answer> dependability{};
  std::size_t other_tasks = 0;  // attempts on the case with another target, guidance, approach or kind of needle
};

// Of the task of the newest attempt that fits; an empty lesion id and no modality fit all. Refused: `no_case`,
// `no_attempt` (none fits).
base::Result<Comparison> compare_attempts(Library& library, const std::string& case_id,
                                          const std::string& lesion_id = {},
                                          std::optional<cases::Modality> modality = {});

}  // namespace seldinger::casedb
