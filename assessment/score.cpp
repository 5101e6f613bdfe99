#include "assessment/score.h"

#include <glm/geometric.hpp>

#include "assessment/registry.h"
#include "assessment/signals/target_view.h"
#include "sim/case/patient_position.h"

namespace seldinger::assessment {

base::Result<Signals> signals_of(const cases::Case& scene, const cases::Recording& recording) {
  AttemptSetting setting;
  setting.skin = &scene.skin_index;
  if (!scene.lesions.empty()) setting.target = scene.lesions[0];
  setting.instrument = scene.instrument;
  setting.modality = scene.picture.modality;
  setting.approach = scene.approach;
  if (scene.probe_is_chosen && setting.modality == cases::Modality::ultrasound)
    setting.probe_suits = cases::depths_that_suit(scene.picture.probe);
  setting.structures = scene.structures;
  if (scene.planned_entry_lps_mm && setting.target) {
    const glm::dvec3 way = setting.target->center_lps_mm - *scene.planned_entry_lps_mm;
    if (glm::length(way) > 0.0) setting.plan = PlannedEntry{*scene.planned_entry_lps_mm, glm::normalize(way)};
  }
  setting.subject = scene.subject;
  setting.position = scene.position;
  const glm::dvec3 up = cases::upwards(scene.position);
  for (const glm::vec3& vertex : scene.skin.vertices_lps_mm) {
    const double height_mm = glm::dot(glm::dvec3(vertex), up);
    if (!setting.table_mm || height_mm < *setting.table_mm) setting.table_mm = height_mm;
  }
  setting.defer_is_right = scene.defer_is_right;
  setting.breathes = scene.breathing.has_value();
  setting.yields = scene.yields;
  setting.sight_law = scene.sight_law;
  setting.target_cannot_show = target_cannot_show(scene);
  return make_signals(setting, recording);
}

Scored score(const Signals& signals) {
  return {measure_all(signals), walk_steps(signals)};
}

base::Result<Scored> score(const cases::Case& scene, const cases::Recording& recording) {
  const auto signals = signals_of(scene, recording);
  if (!signals) return signals.error();
  return score(*signals);
}

base::Result<std::vector<MetricValue>> measure(const cases::Case& scene, const cases::Recording& recording) {
  const auto signals = signals_of(scene, recording);
  if (!signals) return signals.error();
  return measure_all(*signals);
}

}  // namespace seldinger::assessment
