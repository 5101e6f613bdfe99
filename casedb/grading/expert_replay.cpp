#include "casedb/grading/expert_replay.h"

#include <tuple>

#include "casedb/grading/grading.h"

namespace seldinger::casedb {

std::optional<std::string> expert_replay_of(Library& library, const std::string& case_id) {
  const auto row = find_case(library, case_id);
  if (!row) return std::nullopt;
  const auto age = [](const AttemptRow& one) { return std::tie(one.started_us, one.attempt_id); };
  std::optional<AttemptRow> newest;
  for (const auto kind : {assessment::SetKind::consultants, assessment::SetKind::simulated})
    for (AttemptRow& one : list_expert_attempts(library, case_id, kind)) {
      if (one.picture.modality != row->modality || one.approach != row->approach ||
          one.instrument.kind != row->instrument.kind)
        continue;
      if (grade_of(one, *row).verdict != assessment::Verdict::passed) continue;
      if (!newest || age(*newest) < age(one)) newest = std::move(one);
      break;  // the list has the newest first
    }
  if (!newest) return std::nullopt;
  return newest->attempt_id;
}

}  // namespace seldinger::casedb
