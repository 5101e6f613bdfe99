#include "app/simulation.h"

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "app/attempt_loop.h"
#include "app/case_build.h"
#include "app/ultrasound_sight.h"
#include "app/version.h"

namespace seldinger::app {

base::Result<Simulation> Simulation::prepare(casedb::Library& library, const std::string& case_id,
                                             const std::string& lesion_id, cases::InstrumentKind kind) {
  const auto row = casedb::find_case(library, case_id);
  if (!row) return row.error();
  const casedb::LesionRow* found = nullptr;
  const auto lesions = casedb::list_lesions(library, case_id);
  for (const casedb::LesionRow& lesion : lesions)
    if (found == nullptr && (lesion_id.empty() || lesion.lesion_id == lesion_id)) found = &lesion;
  if (found == nullptr)
    return base::Error{"no_lesion", lesion_id.empty() ? "the case has no lesion; `seldinger case lesion` places one"
                                                      : "the case has no lesion of that id"};
  cases::Instrument instrument;
  instrument.kind = kind;
  cases::Picture picture;
  picture.modality = row->modality;
  auto scene = build_case(library, *row, found->lesion, instrument, picture, cases::Approach::in_plane);
  if (!scene) return scene.error();
  assessment::PathLimits limits = assessment::path_limits(row->modality, row->position);
  if (row->modality == cases::Modality::ultrasound) {
    if (const auto added = add_ultrasound_tissue(library, *row, *scene); !added) return added.error();
    limits.looks_from = [&](const assessment::PuncturePlan& plan) {
      return UltrasoundSight(*scene).looks_from(plan, found->lesion);
    };
  }
  const auto plan =
      assessment::plan_puncture(scene->volume, scene->skin_index, found->lesion.center_lps_mm, limits);
  if (!plan) return plan.error();
  if (plan->picture) scene->picture = *plan->picture;
  return Simulation(library, *row, *found, std::move(*scene), *plan);
}

base::Result<SimulatedAttempt> Simulation::attempt(const assessment::OperatorProfile& profile, std::uint64_t seed,
                                                   const std::optional<std::string>& person_id) {
  casedb::NewAttempt attempt;
  attempt.case_id = row_.case_id;
  attempt.lesion_id = lesion_.lesion_id;
  attempt.person_id = person_id;
  attempt.operator_name = profile.name;
  attempt.seed = seed;
  attempt.program_version = kVersion;
  attempt.instrument = scene_.instrument;
  attempt.picture = scene_.picture;
  attempt.approach = scene_.approach;
  attempt.started_us =
      std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::system_clock::now().time_since_epoch())
          .count();
  attempt.recording = run_attempt(scene_, plan_, profile, seed);
  attempt.duration_s = static_cast<double>(attempt.recording.inputs.size()) * attempt.recording.dt_s;
  auto metrics = measure(scene_, attempt.recording);
  if (!metrics) return metrics.error();
  attempt.metrics = std::move(*metrics);
  attempt.picture_png = picture_at_endpoint(scene_, attempt.recording);
  const auto attempt_id = casedb::add_attempt(*library_, attempt);
  if (!attempt_id) return attempt_id.error();
  return SimulatedAttempt{*attempt_id, profile.name, seed, attempt.metrics};
}

void print_metrics(const std::vector<assessment::MetricValue>& metrics) {
  std::size_t longest = 0;
  for (const assessment::MetricValue& metric : metrics) longest = std::max(longest, metric.id.size());
  const int width = static_cast<int>(longest);
  for (const assessment::MetricValue& metric : metrics) {
    if (metric.value)
      std::printf("  %-*s %10.3f %s\n", width, metric.id.c_str(), *metric.value, metric.unit.c_str());
    else
      std::printf("  %-*s          – (%s)\n", width, metric.id.c_str(), metric.reason.c_str());
  }
}

}  // namespace seldinger::app
