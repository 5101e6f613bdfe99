#include "casedb/studies/visits.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "casedb/attempts/attempts.h"
#include "casedb/database/sqlite.h"
#include "casedb/studies/enrolments.h"

namespace seldinger::casedb {

std::vector<PersonVisit> list_visits(Library& library, const StoredPlan& plan, std::int64_t at_us) {
  constexpr double kVisitDayUs = 86'400e6;
  const Snapshot one_state(library.database());
  std::set<std::string> cases;
  for (const auto* outcomes : {&plan.plan.primary, &plan.plan.secondary})
    for (const assessment::study::Outcome& one : *outcomes) cases.insert(one.case_id);
  std::vector<PersonVisit> visits;
  for (const StudyEnrolment& person : list_study_enrolments(library, plan.study_id)) {
    if (!person.consents) continue;
    const auto attempts = list_attempts_of(library, person.person_id);
    const auto at_day = [&](double day) {
      return person.enrolled_us + static_cast<std::int64_t>(std::llround(day * kVisitDayUs));
    };
    for (const assessment::study::Visit& visit : plan.plan.visits) {
      PersonVisit one{person.pseudonym, visit.name, at_day(visit.from_day), at_day(visit.to_day),
                      VisitState::ahead};
      const bool made = std::any_of(attempts.begin(), attempts.end(), [&](const AttemptRow& row) {
        return cases.contains(row.case_id) && row.started_us >= one.from_us && row.started_us <= one.to_us;
      });
      one.state = made                  ? VisitState::made
                  : at_us < one.from_us ? VisitState::ahead
                  : at_us > one.to_us   ? VisitState::missed
                                        : VisitState::due;
      visits.push_back(std::move(one));
    }
  }
  std::sort(visits.begin(), visits.end(), [](const PersonVisit& a, const PersonVisit& b) {
    return std::tie(a.to_us, a.pseudonym, a.visit) < std::tie(b.to_us, b.pseudonym, b.visit);
  });
  return visits;
}

}  // namespace seldinger::casedb
