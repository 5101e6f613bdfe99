#include "session/attempt/simulation.h"

#include <algorithm>

#include "assessment/population/streams.h"
#include "assessment/score.h"
#include "casedb/attempts/add_unless.h"
#include "session/attempt/endpoint_picture.h"
#include "session/attempt/median_attempt.h"
#include "session/attempt/ordered_work.h"
#include "session/attempt/simulated_attempt.h"
#include "session/guidance/guidance.h"
#include "sim/base/check.h"
#include "sim/base/hash.h"
#include "sim/engine/step.h"

namespace seldinger::session {

namespace population = assessment::population;

namespace {

// Of an operator who is nobody, whoever it is stored for.
SimulatedTrial trial_of(const assessment::OperatorProfile& profile, std::uint64_t seed,
                        const std::optional<std::string>& person_id = std::nullopt) {
  return {
      .profile = profile, .seed = seed, .stream = stream_of_operator(profile.name, seed), .person_id = person_id};
}

}  // namespace

base::Result<Simulation> Simulation::prepare(casedb::Library& library, Program program, const std::string& case_id,
                                             const std::string& lesion_id,
                                             std::optional<cases::InstrumentKind> kind,
                                             std::optional<cases::Modality> modality) {
  auto task = prepare_task(library, case_id, lesion_id, kind, modality);
  if (!task) return task.error();
  return Simulation(library, std::move(program), std::move(*task));
}

base::Result<void> Simulation::set_scenario(std::vector<cases::Event> events) {
  if (!events.empty() && task_.scene.subject == cases::Subject::phantom)
    return base::Error{"no_patient", "nothing happens to a phantom: --event is for patients"};
  const bool injected = std::any_of(events.begin(), events.end(), [](const cases::Event& event) {
    return event.kind == cases::EventKind::inject;
  });
  if (injected && task_.scene.instrument.kind == cases::InstrumentKind::core)
    return base::Error{"no_injection", "a core needle has no hub: contrast goes through an access needle"};
  scenario_ = std::move(events);
  return {};
}

base::Result<SimulatedAttempt> Simulation::live_attempt(const assessment::OperatorProfile& profile,
                                                        std::uint64_t seed, const Opened& opened) {
  // Whoever looks for needle and target in pulses is not made for real time.
  if (!guidance_kind(task_.scene.picture.modality).probe_guides)
    return base::Error{"not_in_real_time", "a fluoroscope's attempts run in virtual time only"};
  assessment::ScriptedOperator person(profile, task_.plan, task_.scene.instrument,
                                      stream_of_operator(profile.name, seed));
  return run_live(
      LiveAttempt(*library_, program_, head_of(task_, program_, profile.name, seed, std::nullopt), task_.scene),
      person, 0, seed, opened);
}

// The operator sees and hears what was recorded, and what they would have done then is left out: hands did what was
// recorded. A picture is seen in the first tick after it, as it is in all but a few attempts.
base::Result<SimulatedAttempt> Simulation::resume(InterruptedAttempt interrupted,
                                                  const assessment::OperatorProfile& profile) {
  const std::uint64_t seed = interrupted.attempt().seed;
  CHECK(interrupted.attempt().synthetic());
  if (!was_made_at(interrupted.attempt(), task_))
    return base::Error{"other_case", "the attempt was made on a different task"};
  assessment::ScriptedOperator person(profile, task_.plan, task_.scene.instrument,
                                      stream_of_operator(profile.name, seed));
  std::uint32_t happened = 0;
  auto frame = interrupted.recording().frames.begin();
  const auto frames_end = interrupted.recording().frames.end();
  const auto replayed =
      interrupted.replay(task_.scene, [&](const cases::State& before, const cases::Inputs& inputs) {
        const bool new_frame = frame != frames_end && frame->t_s <= before.t_s;
        person.act(before, new_frame ? &*frame : nullptr, base::kTickS);
        if (new_frame) ++frame;
        if (happened < scenario_.size() && inputs.event == scenario_[happened].kind) ++happened;
        person.hear(inputs.event);
      });
  if (!replayed) return replayed.error();
  return run_live(LiveAttempt(*library_, program_, std::move(interrupted), task_.scene), person, happened, seed);
}

base::Result<SimulatedAttempt> Simulation::run_live(LiveAttempt live, assessment::ScriptedOperator& person,
                                                    std::uint32_t happened, std::uint64_t seed,
                                                    const Opened& opened) const {
  const engine::Scenario scenario(scenario_);
  const auto stored = live.run({.hands =
                                    [&](const cases::State& state, const cases::FrameTruth* frame) {
                                      cases::Inputs inputs = person.act(state, frame, base::kTickS);
                                      scenario.add_to(inputs, state.t_s, happened);
                                      person.hear(inputs.event);
                                      return inputs;
                                    },
                                .opened = opened,
                                .done = [&] { return person.done(); }});
  if (!stored) return stored.error();
  return SimulatedAttempt{stored->attempt_id, live.head().operator_name, seed, stored->metrics};
}

base::Result<casedb::NewAttempt> Simulation::make(const SimulatedTrial& trial, bool picture) const {
  casedb::NewAttempt attempt;
  static_cast<casedb::AttemptHead&>(attempt) =
      head_of(task_, program_, trial.profile.name, trial.seed, trial.person_id);
  if (trial.started_us) attempt.started_us = *trial.started_us;
  attempt.conditions.station = trial.station;
  double limit_s = kMaxAttemptSeconds;
  casedb::AttemptEnd at_limit = casedb::AttemptEnd::time_limit;
  if (trial.mishaps) {
    limit_s = trial.mishaps->patience_s;
    at_limit = casedb::AttemptEnd::stopped;
    if (const auto lost_s = trial.mishaps->device_lost_s; lost_s && *lost_s < limit_s) {
      limit_s = *lost_s;
      at_limit = casedb::AttemptEnd::device_lost;
    }
  }
  attempt.recording =
      run_attempt(task_.scene, task_.plan, trial.profile, trial.stream.value_or(trial.seed), scenario_, limit_s);
  attempt.duration_s = static_cast<double>(attempt.recording.inputs.size()) * attempt.recording.dt_s;
  attempt.end = attempt.recording.endpoint     ? casedb::AttemptEnd::fired
                : attempt.duration_s < limit_s ? casedb::AttemptEnd::stopped
                                               : at_limit;
  auto scored = assessment::score(task_.scene, attempt.recording);
  if (!scored) return scored.error();
  attempt.metrics = std::move(scored->metrics);
  attempt.steps = std::move(scored->steps);
  if (picture) attempt.picture_png = program_.file_of(picture_at_endpoint(task_.scene, attempt.recording));
  return attempt;
}

base::Result<SimulatedAttempt> Simulation::attempt(const assessment::OperatorProfile& profile, std::uint64_t seed,
                                                   const std::optional<std::string>& person_id) {
  const auto made = make(trial_of(profile, seed, person_id), true);
  if (!made) return made.error();
  const auto attempt_id = casedb::add_attempt(*library_, *made);
  if (!attempt_id) return attempt_id.error();
  return SimulatedAttempt{*attempt_id, profile.name, seed, made->metrics};
}

base::Result<SimulatedAttempt> Simulation::median_attempt(const assessment::OperatorProfile& profile,
                                                          std::span<const std::uint64_t> seeds, std::size_t jobs,
                                                          const std::optional<std::string>& person_id) {
  using Made = base::Result<casedb::NewAttempt>;
  CHECK(!seeds.empty());
  std::vector<casedb::NewAttempt> all;
  std::optional<base::Error> refused;
  in_order<Made>(
      seeds.size(), jobs, [&](std::size_t i) { return make(trial_of(profile, seeds[i], person_id), false); },
      [&](std::size_t, Made made) {
        if (made)
          all.push_back(std::move(*made));
        else
          refused = made.error();
        return !refused;
      });
  if (refused) return *refused;
  std::vector<std::vector<assessment::MetricValue>> metrics;
  for (const casedb::NewAttempt& one : all) metrics.push_back(one.metrics);
  casedb::NewAttempt& middle = all[index_of_median(metrics)];
  middle.picture_png = program_.file_of(picture_at_endpoint(task_.scene, middle.recording));
  const auto attempt_id = casedb::add_attempt(*library_, middle);
  if (!attempt_id) return attempt_id.error();
  return SimulatedAttempt{*attempt_id, profile.name, middle.seed, middle.metrics};
}

base::Result<void> Simulation::each(const std::vector<SimulatedTrial>& trials, std::size_t jobs, bool pictures,
                                    const Taken& take) const {
  using Made = base::Result<casedb::NewAttempt>;
  base::Result<void> done;
  in_order<Made>(
      trials.size(), jobs, [&](std::size_t i) { return make(trials[i], pictures); },
      [&](std::size_t i, Made made) {
        const base::Result<bool> more = made ? take(i, *made) : made.error();
        if (!more) done = more.error();
        return more && *more;
      });
  return done;
}

// Of a simulated person's attempt the one that is there by then: another program may make the same people's.
base::Result<std::string> Simulation::store_once(const casedb::NewAttempt& made) {
  std::string there;
  const auto added = casedb::add_attempt_unless(*library_, made, [&] {
    if (!made.person_id) return false;
    for (const casedb::AttemptRow& row : casedb::list_attempts_of_seed(*library_, *made.person_id, made.seed))
      if (was_made_at(row, task_)) there = row.attempt_id;
    return !there.empty();
  });
  if (!added) return added.error();
  return added->value_or(there);
}

base::Result<void> Simulation::attempts(const std::vector<SimulatedTrial>& trials, std::size_t jobs, bool pictures,
                                        const std::function<void(SimulatedAttempt)>& stored) {
  return each(trials, jobs, pictures, [&](std::size_t i, casedb::NewAttempt& made) -> base::Result<bool> {
    const auto attempt_id = store_once(made);
    if (!attempt_id) return attempt_id.error();
    SimulatedAttempt one{*attempt_id, trials[i].profile.name, trials[i].seed, made.metrics};
    one.person = trials[i].person;
    one.number = trials[i].number;
    stored(std::move(one));
    return true;
  });
}

base::Result<void> Simulation::measured_attempts(const std::vector<SimulatedTrial>& trials, std::size_t jobs,
                                                 const Measured& told) const {
  return each(trials, jobs, false, [&](std::size_t i, casedb::NewAttempt& made) -> base::Result<bool> {
    return told(i, {std::move(made.metrics), made.duration_s});
  });
}

base::Result<void> Simulation::forgotten_attempts(const std::vector<SimulatedTrial>& trials, std::size_t jobs,
                                                  const Forgotten& told) const {
  return each(trials, jobs, false, [&](std::size_t i, casedb::NewAttempt& made) -> base::Result<bool> {
    casedb::AttemptRow row;
    static_cast<casedb::AttemptHead&>(row) = made;
    row.end = made.end;
    row.metrics = std::move(made.metrics);
    return told(i, casedb::grade_of(row, task_.row));
  });
}

std::vector<SimulatedTrial> simulated_trials(const assessment::OperatorProfile& profile, std::uint64_t seed,
                                             std::size_t count, std::optional<std::size_t> people) {
  std::vector<SimulatedTrial> trials;
  if (!people) {
    for (std::size_t i = 0; i < count; ++i) {
      trials.push_back(trial_of(assessment::at_attempt(profile, i), seed + i));
      trials.back().number = i;
    }
    return trials;
  }
  for (std::size_t p = 1; p <= *people; ++p) {
    const std::uint64_t key = population::person_key(seed, profile.name, p);
    assessment::OperatorProfile person =
        assessment::person_of(profile, population::stream_of(key, population::Drawn::specific));
    person.name.append("-").append(std::to_string(p));
    for (std::size_t i = 0; i < count; ++i)
      trials.push_back({.profile = assessment::at_attempt(person, i),
                        .seed = population::stream_of(key, population::Drawn::attempt, i) >> 11U,
                        .person = p,
                        .number = i});
  }
  return trials;
}

}  // namespace seldinger::session
