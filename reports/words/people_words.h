// How many people there are, and how many simulated ones, who are never counted among people.
#pragma once

#include <string>

#include "casedb/people/consent.h"

namespace seldinger::reports {

std::string and_simulated_text(int simulated);                    // " and 12 simulated"; nothing of none
std::string consent_text(const casedb::Study& study);             // "3 consent and 12 simulated"
std::string with_outcome_text(int people, bool simulated_study);  // "12 simulated people with an outcome"

}  // namespace seldinger::reports
