// What the commands about cohorts, studies, consent, facts and erasing answer.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "casedb/keeping/erase.h"
#include "casedb/people/cohorts.h"
#include "casedb/people/consent.h"
#include "casedb/people/facts.h"

namespace seldinger::app {

std::string json_of_made(const char* key, const std::string& id);  // {"cohort_id":"…"}
std::string json_of_cohorts(const std::vector<casedb::Cohort>& cohorts);
// `names` by person id; who has none is called by the pseudonym.
std::string json_of_cohort(const casedb::Cohort& cohort, const std::vector<casedb::Enrolment>& enrolments,
                           const std::map<std::string, std::string>& names);
std::string json_of_consents(const std::vector<casedb::Consent>& consents);
std::string json_of_given_facts(const std::vector<casedb::FactGiven>& facts);
// On stderr, when old bytes are left somewhere.
void warn_of_what_is_left(const casedb::Erased& erased);
std::string json_of_erased(const casedb::Erased& erased);

}  // namespace seldinger::app
