// Which visits of a study are due, by whom: a plan's windows of days, counted from each person's enrolment.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "casedb/database/library.h"
#include "casedb/studies/plans.h"
#include "sim/base/names.h"

namespace seldinger::casedb {

// Made: there is an attempt at a case of the plan within the window, whatever came of it.
enum class VisitState { made, ahead, due, missed };
inline constexpr auto kVisitStateNames = base::names<VisitState>({{VisitState::made, "made"},
                                                                  {VisitState::ahead, "ahead"},
                                                                  {VisitState::due, "due"},
                                                                  {VisitState::missed, "missed"}});

struct PersonVisit {
  std::string pseudonym, visit;
  std::int64_t from_us = 0, to_us = 0;
  VisitState state = VisitState::ahead;
};
// Of everybody who is enrolled and still consents, as at that time; by the end of their windows.
std::vector<PersonVisit> list_visits(Library& library, const StoredPlan& plan, std::int64_t at_us);

}  // namespace seldinger::casedb
