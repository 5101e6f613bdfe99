#include "session/case/task.h"

#include <algorithm>
#include <chrono>

#include "casedb/attempts/made_at.h"
#include "session/case/case_build.h"
#include "session/guidance/guidance.h"
#include "session/guidance/ultrasound_sight.h"
#include "sim/base/check.h"

namespace seldinger::session {

base::Result<Task> prepare_task(casedb::Library& library, const std::string& case_id, const std::string& lesion_id,
                                std::optional<cases::InstrumentKind> kind, std::optional<cases::Modality> modality,
                                const std::function<void(double share)>& told) {
  const auto row = casedb::find_case(library, case_id);
  if (!row) return row.error();
  const casedb::LesionRow* found = nullptr;
  const auto lesions = casedb::list_lesions(library, case_id);
  for (const casedb::LesionRow& lesion : lesions)
    if (found == nullptr && (lesion_id.empty() || lesion.lesion_id == lesion_id)) found = &lesion;
  if (found == nullptr)
    return base::Error{"no_lesion", lesion_id.empty() ? "the case has no lesion; `seldinger case lesion` places one"
                                                      : "the case has no lesion of that id"};
  cases::Picture picture;
  picture.modality = modality.value_or(row->modality);
  const auto& further = row->further_modalities;
  if (picture.modality != row->modality &&
      std::find(further.begin(), further.end(), picture.modality) == further.end())
    return base::Error{"other_modality", "the case is not practised with this modality"};
  const auto tell = [&told](double share) {
    if (told) told(share);
  };
  const GuidanceKind& guidance = guidance_kind(picture.modality);
  const double built = guidance.loading_share;
  auto scene = build_case(library, *row, found->form, picture, guidance.needs);
  if (!scene) return scene.error();
  tell(built);
  scene->instrument.kind = kind.value_or(row->instrument.kind);
  assessment::PathLimits limits = assessment::path_limits(*scene);
  limits.told = [&](double share) { tell(built + (1.0 - built) * share); };
  if (guidance.looks_from != nullptr) limits.looks_from = guidance.looks_from(*scene);
  auto plan = assessment::plan_puncture(scene->volume, scene->skin_index, found->lesion.center_lps_mm, limits);
  if (!plan) return plan.error();
  if (plan->picture) scene->picture = *plan->picture;
  tell(1.0);
  plan->brief = {row->clinic.inr, row->clinic.platelets_per_nl, row->subject};
  if (scene->breathing) plan->ct_level = scene->breathing->ct_level;
  return Task{*row, *found, std::move(*scene), *plan, {}};
}

std::vector<std::string> probes_to_choose(const Task& task) {
  std::vector<std::string> names;
  if (task.scene.probe_is_chosen && task.scene.picture.modality == cases::Modality::ultrasound)
    for (const imaging::Probe* probe : offered_probes()) names.emplace_back(probe->name);
  return names;
}

void choose_probe(Task& task, std::string_view name) {
  const std::vector<std::string> offered = probes_to_choose(task);
  CHECK(std::find(offered.begin(), offered.end(), name) != offered.end());
  task.scene.picture = by_probe(task.plan.picture.value_or(task.scene.picture), *imaging::probe_named(name));
}

casedb::AttemptHead head_of(const Task& task, const Program& program, std::string operator_name, std::uint64_t seed,
                            const std::optional<std::string>& person_id) {
  casedb::AttemptHead head;
  head.case_id = task.row.case_id;
  head.lesion_id = task.lesion.lesion_id;
  head.person_id = person_id;
  head.operator_name = std::move(operator_name);
  head.seed = seed;
  head.program_version = program.version;
  head.instrument = task.scene.instrument;
  head.picture = task.scene.picture;
  head.approach = task.scene.approach;
  head.started_us =
      std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::system_clock::now().time_since_epoch())
          .count();
  return head;
}

bool was_made_at(const casedb::AttemptHead& attempt, const Task& task) {
  return casedb::made_at(attempt.case_id, attempt.lesion_id, attempt.instrument, attempt.picture,
                         attempt.approach) == casedb::made_at(task.row.case_id, task.lesion.lesion_id,
                                                              task.scene.instrument, task.scene.picture,
                                                              task.scene.approach);
}

}  // namespace seldinger::session
