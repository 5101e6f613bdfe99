#include "app/simulation.h"

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "app/attempt_loop.h"
#include "app/case_build.h"
#include "app/live_attempt.h"
#include "app/ordered_work.h"
#include "app/ultrasound_sight.h"
#include "app/version.h"
#include "assessment/operators/scripted.h"
#include "sim/base/hash.h"
#include "sim/engine/step.h"

namespace seldinger::app {

base::Result<Simulation> Simulation::prepare(casedb::Library& library, const std::string& case_id,
                                             const std::string& lesion_id,
                                             std::optional<cases::InstrumentKind> kind,
                                             std::optional<cases::Modality> modality) {
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
  auto scene = build_case(library, *row, found->form, picture, needs_of(picture.modality));
  if (!scene) return scene.error();
  if ((scene->breathing || scene->yields) && picture.modality != cases::Modality::mpr)
    return base::Error{"motion_not_shown",
                       "a patient who moves is shown by mpr only: ultrasound and fluoroscopy do not show it yet"};
  scene->instrument.kind = kind.value_or(row->instrument.kind);
  assessment::PathLimits limits = assessment::path_limits(*scene);
  if (picture.modality == cases::Modality::ultrasound)
    limits.looks_from = [&](const assessment::PuncturePlan& plan) {
      return UltrasoundSight(*scene).looks_from(plan, scene->lesions.front());
    };
  auto plan = assessment::plan_puncture(scene->volume, scene->skin_index, found->lesion.center_lps_mm, limits);
  if (!plan) return plan.error();
  if (plan->picture) scene->picture = *plan->picture;
  plan->brief = {row->clinic.inr, row->clinic.platelets_per_nl};
  return Simulation(library, *row, *found, std::move(*scene), *plan);
}

casedb::AttemptHead Simulation::head(const assessment::OperatorProfile& profile, std::uint64_t seed,
                                     const std::optional<std::string>& person_id) const {
  casedb::AttemptHead head;
  head.case_id = row_.case_id;
  head.lesion_id = lesion_.lesion_id;
  head.person_id = person_id;
  head.operator_name = profile.name;
  head.seed = seed;
  head.program_version = kVersion;
  head.instrument = scene_.instrument;
  head.picture = scene_.picture;
  head.approach = scene_.approach;
  head.started_us =
      std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::system_clock::now().time_since_epoch())
          .count();
  return head;
}

base::Result<SimulatedAttempt> Simulation::live_attempt(const assessment::OperatorProfile& profile,
                                                        std::uint64_t seed) {
  if (scene_.picture.modality == cases::Modality::xray)
    return base::Error{"not_in_real_time", "a fluoroscope's attempts run in virtual time only"};
  assessment::ScriptedOperator person(profile, plan_, scene_.instrument, seed);
  Scenario scenario(scenario_);
  LiveAttempt live(*library_, head(profile, seed, std::nullopt), scene_);
  const auto stored = live.run(
      [&](const cases::State& state, const cases::FrameTruth* frame) {
        cases::Inputs inputs = person.act(state, frame, engine::kTickSeconds);
        scenario.add_to(inputs, state.t_s);
        person.hear(inputs.event);
        return inputs;
      },
      [&] { return person.done(); });
  if (!stored) return stored.error();
  return SimulatedAttempt{stored->attempt_id, profile.name, seed, stored->metrics};
}

base::Result<casedb::NewAttempt> Simulation::make(const assessment::OperatorProfile& profile, std::uint64_t seed,
                                                  const std::optional<std::string>& person_id, bool picture) const {
  casedb::NewAttempt attempt;
  static_cast<casedb::AttemptHead&>(attempt) = head(profile, seed, person_id);
  attempt.recording = run_attempt(scene_, plan_, profile, seed, scenario_);
  attempt.duration_s = static_cast<double>(attempt.recording.inputs.size()) * attempt.recording.dt_s;
  attempt.end = attempt.recording.endpoint                ? casedb::AttemptEnd::fired
                : attempt.duration_s < kMaxAttemptSeconds ? casedb::AttemptEnd::stopped
                                                          : casedb::AttemptEnd::time_limit;
  auto scored = score(scene_, attempt.recording);
  if (!scored) return scored.error();
  attempt.metrics = std::move(scored->metrics);
  attempt.steps = std::move(scored->steps);
  if (picture) attempt.picture_png = picture_at_endpoint(scene_, attempt.recording);
  return attempt;
}

base::Result<SimulatedAttempt> Simulation::attempt(const assessment::OperatorProfile& profile, std::uint64_t seed,
                                                   const std::optional<std::string>& person_id) {
  const auto made = make(profile, seed, person_id, true);
  if (!made) return made.error();
  const auto attempt_id = casedb::add_attempt(*library_, *made);
  if (!attempt_id) return attempt_id.error();
  return SimulatedAttempt{*attempt_id, profile.name, seed, made->metrics};
}

base::Result<void> Simulation::attempts(const std::vector<SimulatedTrial>& trials, std::size_t jobs, bool pictures,
                                        const std::function<void(SimulatedAttempt)>& stored) {
  using Made = base::Result<casedb::NewAttempt>;
  base::Result<void> done;
  in_order<Made>(
      trials.size(), jobs,
      [&](std::size_t i) { return make(trials[i].profile, trials[i].seed, std::nullopt, pictures); },
      [&](std::size_t i, Made made) {
        const auto attempt_id = made ? casedb::add_attempt(*library_, *made) : made.error();
        if (!attempt_id) {
          done = attempt_id.error();
          return false;
        }
        stored({*attempt_id, trials[i].profile.name, trials[i].seed, made->metrics, {}, trials[i].person,
                trials[i].number});
        return true;
      });
  return done;
}

std::vector<SimulatedTrial> simulated_trials(const assessment::OperatorProfile& profile, std::uint64_t seed,
                                             std::size_t count, std::optional<std::size_t> people) {
  std::vector<SimulatedTrial> trials;
  for (std::size_t p = 0; p < people.value_or(1); ++p) {
    assessment::OperatorProfile person = profile;
    if (people) {
      person = assessment::person_of(profile, base::hash_combine(seed, p));
      person.name.append("-").append(std::to_string(p + 1));
    }
    for (std::size_t i = 0; i < count; ++i)
      trials.push_back({assessment::at_attempt(person, i), seed + trials.size(),
                        people ? std::optional<std::uint64_t>(p + 1) : std::nullopt, i});
  }
  return trials;
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
