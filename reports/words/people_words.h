// How many people there are, and how many simulated ones, who are never counted among people.
#pragma once

#include <string>
#include <string_view>

#include "assessment/study/plan.h"
#include "casedb/people/consent.h"

namespace seldinger::reports {

std::string and_simulated_text(int simulated);  // " and 12 simulated"; nothing of none
// Whom a study may be of: "consent" or "simulated people", and with their number before it.
std::string study_people_words(const casedb::StudyPeople& people);
std::string study_people_text(const casedb::StudyPeople& people);
std::string_view whose_attempts_words(assessment::study::People people);
std::string with_outcome_text(int people, bool simulated_study);  // "12 simulated people with an outcome"

}  // namespace seldinger::reports
