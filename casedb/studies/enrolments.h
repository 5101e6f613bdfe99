// Who takes part in a study: people whose consent stands, in the group that their facts tell or that chance sends
// them to. Nobody learns where the next one will be sent: the place is taken and the person stored in one
// transaction.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "casedb/database/library.h"
#include "casedb/studies/plans.h"
#include "sim/base/result.h"

namespace seldinger::casedb {

struct StudyEnrolment {
  std::string person_id, pseudonym, group, stratum;
  std::int64_t position = 0;  // in the stratum's sequence, from 0
  std::int64_t enrolled_us = 0;
  bool consents = true;  // still
};

// Who may be enrolled, or is: people whose consent stands, of the kind that the plan is of.
std::set<std::string> people_asked(Library& library, const StoredPlan& stored);
bool is_of_simulated_people(Library& library, const std::string& study_id);  // by its plan, if it has one
// By the study's plan; where there is none yet, all whose consent stands.
std::set<std::string> people_asked(Library& library, const std::string& study_id);
// By the facts that hold now. `no_plan`, `plan_not_frozen`, `data_locked`, `no_person`, `real_person` (the study is
// of simulated people), `no_consent`, `already_enrolled`, `fact_missing` (the person has not said what the plan
// asks), `no_group` (none fits, or more than one).
base::Result<StudyEnrolment> enrol_in_study(Library& library, const std::string& study_id,
                                            const std::string& person_id);
std::vector<StudyEnrolment> list_study_enrolments(Library& library, const std::string& study_id);
// How many were ever enrolled, also those of whom nothing is known any more.
std::size_t count_ever_enrolled(Library& library, const std::string& study_id);

}  // namespace seldinger::casedb
