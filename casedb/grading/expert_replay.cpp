#include "casedb/grading/expert_replay.h"

#include <set>
#include <tuple>

#include "casedb/cases/permissions.h"
#include "casedb/grading/grading.h"
#include "casedb/people/consent.h"

namespace seldinger::casedb {

std::optional<std::string> expert_replay_of(Library& library, const std::string& case_id,
                                            const std::string& reader_id, Role role) {
  const auto row = find_case(library, case_id);
  if (!row) return std::nullopt;
  const auto age = [](const AttemptRow& one) { return std::tie(one.started_us, one.attempt_id); };
  const std::set<std::string> agreed = consenting_people(library, std::nullopt);
  const auto may_see = [&](const AttemptRow& one) {
    Relation whose;
    whose.nobodys = one.synthetic() || !one.person_id;
    whose.own = !whose.nobodys && *one.person_id == reader_id;
    whose.agreed = !whose.nobodys && agreed.contains(*one.person_id);
    return may(role, Action::see_expert_replay, whose);
  };
  std::optional<AttemptRow> newest;
  for (const auto kind : {assessment::SetKind::consultants, assessment::SetKind::simulated})
    for (AttemptRow& one : list_expert_attempts(library, case_id, kind)) {
      if (one.picture.modality != row->modality || one.approach != row->approach ||
          one.instrument.kind != row->instrument.kind)
        continue;
      if (!may_see(one)) continue;
      if (grade_of(one, *row).verdict != assessment::Verdict::passed) continue;
      if (!newest || age(*newest) < age(one)) newest = std::move(one);
      break;  // the list has the newest first
    }
  if (!newest) return std::nullopt;
  return newest->attempt_id;
}

}  // namespace seldinger::casedb
