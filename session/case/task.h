// What there is to be done at a stored case: its scene, its target, and the way to it. The same for a simulated
// operator and for a person.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "assessment/operators/plan.h"
#include "casedb/attempts/attempts.h"
#include "casedb/cases/cases.h"
#include "session/case/program.h"
#include "sim/base/result.h"
#include "sim/case/case.h"
#include "sim/volume/organs/find_organs.h"

namespace seldinger::session {

struct Task {
  casedb::CaseRow row;
  casedb::LesionRow lesion;
  cases::Case scene;
  assessment::PuncturePlan plan;
  std::optional<volume::OrganFound> organ{};  // that the target lies in, where somebody asked (target_organ.h)
};

// An empty lesion id takes the case's first lesion; a kind other than the case's keeps the needle's measures; the
// modality is the case's unless given. Refused: `no_case`, `no_lesion`, `no_path`, `other_modality` (not one of the
// case's), damaged assets. `told`: how far it is, from 0 to 1 and rising, by the shares of the time that its stages
// take.
base::Result<Task> prepare_task(casedb::Library& library, const std::string& case_id, const std::string& lesion_id,
                                std::optional<cases::InstrumentKind> kind = std::nullopt,
                                std::optional<cases::Modality> modality = std::nullopt,
                                const std::function<void(double share)>& told = {});

// What may be chosen where the case leaves the choice: none where it does not.
std::vector<std::string> probes_to_choose(const Task& task);
// From now on the task is looked at by that probe, one of these (CHECKed), at a depth that shows the target.
void choose_probe(Task& task, std::string_view name);

// Of an attempt at it that begins now, in this program.
casedb::AttemptHead head_of(const Task& task, const Program& program, std::string operator_name, std::uint64_t seed,
                            const std::optional<std::string>& person_id);

// Whether an attempt was made at this very task: the same target, needle, picture and approach.
bool was_made_at(const casedb::AttemptHead& attempt, const Task& task);

}  // namespace seldinger::session
