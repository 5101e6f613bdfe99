// A workshop's day as commands print it with --json.
#pragma once

#include <string>
#include <vector>

#include "casedb/studies/visits.h"
#include "casedb/workshops/workshops.h"

namespace seldinger::app {

std::string json_of_workshop(const casedb::Workshop& workshop);
std::string json_of_participant(const casedb::Workshop& workshop, const casedb::Participant& one);
// With each participant's visits that are still to come or due.
std::string json_of_day(const casedb::Workshop& workshop, const std::vector<casedb::Participant>& participants,
                        const std::vector<casedb::PersonVisit>& visits);

}  // namespace seldinger::app
