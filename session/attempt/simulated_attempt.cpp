#include "session/attempt/simulated_attempt.h"

#include "assessment/operators/fluoroscopy.h"
#include "assessment/operators/scripted.h"
#include "assessment/population/streams.h"
#include "session/guidance/guidance.h"
#include "sim/engine/step.h"
#include "sim/engine/tick.h"

namespace seldinger::session {

namespace population = assessment::population;

namespace {

// One attempt in virtual time, and its recording.
class Attempt {
 public:
  Attempt(const cases::Case& scene, std::span<const cases::Event> scenario) : tick_(scene), scenario_(scenario) {
    recording_.step_version = engine::kStepVersion;
    recording_.dt_s = base::kTickS;
    recording_.events.emplace();
  }
  const cases::State& state() const noexcept { return now_.state; }
  const tissue::Displacement& displacement() const noexcept { return now_.displacement; }

  // What was said in it.
  cases::EventKind tick(cases::Inputs hands) {
    scenario_.add_to(hands, state().t_s, now_.happened);
    const cases::RecordedTick tick = tick_.advance_hands(hands, {}, now_);
    recording_.inputs.push_back(tick.inputs);
    recording_.hashes.push_back(tick.hash);
    if (tick.pose) recording_.poses.push_back(*tick.pose);
    if (tick.force) recording_.forces.push_back(*tick.force);
    if (tick.endpoint) recording_.endpoint = tick.endpoint;
    cases::add_events(state().t_s, tick, *recording_.events);
    return hands.event;
  }
  void picture(const cases::FrameTruth& frame) { recording_.frames.push_back(frame); }
  cases::Recording take() { return std::move(recording_); }

 private:
  engine::Tick tick_;
  engine::TickState now_;
  engine::Scenario scenario_;
  cases::Recording recording_;
};

// `act` tells what the person's hands want of a state.
template <typename Person, typename Act>
cases::Recording run(Attempt& attempt, Guidance& guidance, Person& person, double limit_s, const Act& act) {
  while (!person.done() && attempt.state().t_s < limit_s) {
    cases::Inputs hands = act(attempt.state());
    hands.exposure = guidance.state().report;
    person.hear(attempt.tick(hands));
    if (const auto frame = guidance.follow(attempt.state(), attempt.displacement())) attempt.picture(*frame);
  }
  return attempt.take();
}

}  // namespace

// As a person's attempts, of a number that no person has.
std::uint64_t stream_of_operator(const std::string& name, std::uint64_t seed) noexcept {
  return population::stream_of(population::person_key(seed, name, 0), population::Drawn::attempt);
}

cases::Recording run_attempt(const cases::Case& scene, const assessment::PuncturePlan& plan,
                             const assessment::OperatorProfile& profile, std::uint64_t stream,
                             std::span<const cases::Event> scenario, double limit_s) {
  const std::unique_ptr<Guidance> guidance = guidance_of(scene);
  const GuidanceState& seen = guidance->state();
  Attempt attempt(scene, scenario);
  if (guidance_kind(scene.picture.modality).probe_guides) {
    assessment::ScriptedOperator person(profile, plan, scene.instrument, stream);
    return run(attempt, *guidance, person, limit_s, [&](const cases::State& state) {
      return person.act(state, seen.fresh ? &seen.truth : nullptr, base::kTickS, seen.moved_mm);
    });
  }
  assessment::FluoroscopyOperator person(profile, plan, scene.instrument, scene.fluoroscope, scene.position,
                                         stream);
  return run(attempt, *guidance, person, limit_s, [&](const cases::State& state) {
    return person.act(state, seen.fresh ? &seen.fix : nullptr, base::kTickS);
  });
}

}  // namespace seldinger::session
