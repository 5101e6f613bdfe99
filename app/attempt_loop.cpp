#include "app/attempt_loop.h"

#include <algorithm>
#include <memory>

#include "app/fluoroscopy.h"
#include "app/frame_truth.h"
#include "app/picture_clock.h"
#include "app/png.h"
#include "app/slice_picture.h"
#include "app/ultrasound_sight.h"
#include "assessment/operators/fluoroscopy.h"
#include "assessment/operators/scripted.h"
#include "sim/engine/step.h"
#include "sim/engine/tick.h"
#include "sim/imaging/mpr/mpr.h"
#include "sim/imaging/mpr/visibility.h"

namespace seldinger::app {
namespace {

cases::ToolPose probe_of(const cases::PoseSample& pose) {
  return {pose.probe_origin_lps_mm, pose.probe_axial, pose.probe_lateral};
}

// One attempt in virtual time, and its recording.
class Attempt {
 public:
  Attempt(const cases::Case& scene, std::span<const cases::Event> scenario) : tick_(scene), scenario_(scenario) {
    recording_.step_version = engine::kStepVersion;
    recording_.dt_s = engine::kTickSeconds;
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

// Under a probe: `truth_of` tells what the picture shows of a state, at the picture's rate.
template <typename TruthOf>
cases::Recording run_probe_attempt(const cases::Case& scene, const assessment::PuncturePlan& plan,
                                   const assessment::OperatorProfile& profile, std::uint64_t seed,
                                   std::span<const cases::Event> scenario, const TruthOf& truth_of) {
  assessment::ScriptedOperator person(profile, plan, scene.instrument, seed);
  Attempt attempt(scene, scenario);
  const cases::State& state = attempt.state();
  const auto target = target_of(scene.lesions);
  cases::FrameTruth frame;
  glm::dvec3 moved_mm(0.0);
  bool new_frame = false;
  PictureClock clock;
  while (!person.done() && state.t_s < kMaxAttemptSeconds) {
    person.hear(attempt.tick(person.act(state, new_frame ? &frame : nullptr, engine::kTickSeconds, moved_mm)));
    new_frame = clock.due(state.t_s, picture_rate_hz(scene.picture, state.probe.console));
    if (!new_frame) continue;
    frame = truth_of(state, attempt.displacement());
    frame.live = !state.probe.frozen;
    if (target && tissue::count_sources(attempt.displacement()) > 0)
      moved_mm = tissue::displaced(attempt.displacement(), *target) - *target;
    attempt.picture(frame);
  }
  return attempt.take();
}

cases::Recording run_xray_attempt(const cases::Case& scene, const assessment::PuncturePlan& plan,
                                  const assessment::OperatorProfile& profile, std::uint64_t seed,
                                  std::span<const cases::Event> scenario) {
  assessment::FluoroscopyOperator person(profile, plan, scene.instrument, scene.fluoroscope, scene.position, seed);
  FluoroscopyRoom room(scene);
  Attempt attempt(scene, scenario);
  const cases::State& state = attempt.state();
  FluoroscopyRoom::Exposed exposed;
  bool new_frame = false, live = false;
  while (!person.done() && state.t_s < kMaxAttemptSeconds) {
    cases::Inputs hands = person.act(state, new_frame ? &exposed.fix : nullptr, engine::kTickSeconds);
    hands.exposure = exposed.report;
    person.hear(attempt.tick(hands));
    new_frame = state.fluoroscopy.frame_due;
    if (new_frame) {
      exposed = room.expose(state, attempt.displacement());
      attempt.picture(exposed.truth);
    } else if (live && !state.fluoroscopy.live) {
      cases::FrameTruth held = exposed.truth;  // the last image stays, and shows nothing that happens
      held.t_s = state.t_s;
      held.live = false;
      held.beam.reset();
      attempt.picture(held);
    }
    live = state.fluoroscopy.live;
  }
  return attempt.take();
}

}  // namespace

Sight sight_of(const cases::Case& scene) {
  const auto needle = [&scene](const cases::State& state) {
    return imaging::needle_pose(scene.instrument, state.needle.tip_lps_mm, state.needle.direction);
  };
  CHECK(scene.picture.modality != cases::Modality::xray);
  if (scene.picture.modality == cases::Modality::ultrasound)
    return [needle, sight = std::make_shared<UltrasoundSight>(scene)](const cases::State& state,
                                                                      const tissue::Displacement& displacement) {
      return frame_truth(state.t_s,
                         sight->see(probe_of(pose_of(state)), state.probe.console, needle(state), displacement));
    };
  return [needle, &scene](const cases::State& state, const tissue::Displacement& displacement) {
    auto target = target_of(scene.lesions);
    if (target) target = tissue::displaced(displacement, *target);
    const imaging::MprView view = slice_view(scene.picture, pose_of(state), state.probe.console);
    return frame_truth(state.t_s, imaging::mpr_visible(view, needle(state), target));
  };
}

cases::Recording run_attempt(const cases::Case& scene, const assessment::PuncturePlan& plan,
                             const assessment::OperatorProfile& profile, std::uint64_t seed,
                             std::span<const cases::Event> scenario) {
  if (scene.picture.modality == cases::Modality::xray)
    return run_xray_attempt(scene, plan, profile, seed, scenario);
  return run_probe_attempt(scene, plan, profile, seed, scenario, sight_of(scene));
}

namespace {

std::vector<std::byte> png_of(const GreyPicture& picture) {
  return png_from_grey(picture.grey, picture.width_px, picture.height_px);
}

// The last image before the trigger: the inputs, stepped through again until its pulse. Only what moves tissue asks
// for more than the step.
std::vector<std::byte> xray_picture_at_endpoint(const cases::Case& scene, const cases::Recording& recording) {
  engine::Moment exposed;
  if (scene.breathing || scene.yields) {
    const engine::Tick tick(scene);
    engine::TickState now;
    for (const cases::Inputs& inputs : recording.inputs) {
      if (now.state.fire.fired) break;
      tick.advance(inputs, recording.dt_s, now);
      if (now.state.fluoroscopy.frame_due) exposed = engine::moment_of(now);
    }
  } else {
    cases::State state;
    for (const cases::Inputs& inputs : recording.inputs) {
      if (state.fire.fired) break;
      engine::step(scene, inputs, recording.dt_s, state);
      if (state.fluoroscopy.frame_due) exposed.state = state;
    }
  }
  if (!exposed.state.fluoroscopy.frame_due) return {};
  return png_of(FluoroscopyRoom(scene).picture(exposed.state, recording.hashes.back(), exposed.displacement));
}

// When the trigger fell, or last.
tissue::Displacement displacement_at_end(const cases::Case& scene, const cases::Recording& recording) {
  if (!scene.breathing && !scene.yields) return {};
  const engine::Tick tick(scene);
  engine::TickState now;
  for (const cases::Inputs& inputs : recording.inputs)
    if (!now.state.fire.fired) tick.advance(inputs, recording.dt_s, now);
  return now.displacement;
}

// As it stood when the trigger fell, or last.
cases::ConsoleSetting console_at_end(const cases::Recording& recording) {
  cases::ConsoleSetting console;
  std::uint64_t tick = 0;
  for (const cases::Inputs& inputs : recording.inputs) {
    if (recording.endpoint && static_cast<double>(tick) * recording.dt_s >= recording.endpoint->t_s) break;
    cases::turn(console, inputs.console);
    ++tick;
  }
  return console;
}

}  // namespace

std::vector<std::byte> picture_at_endpoint(const cases::Case& scene, const cases::Recording& recording) {
  CHECK(!recording.poses.empty());
  if (scene.picture.modality == cases::Modality::xray) return xray_picture_at_endpoint(scene, recording);
  cases::PoseSample pose = recording.poses.back();
  if (recording.endpoint)
    for (const cases::PoseSample& one : recording.poses)
      if (one.t_s <= recording.endpoint->t_s) pose = one;
  const imaging::NeedlePose needle =
      recording.endpoint
          ? imaging::needle_pose(scene.instrument, recording.endpoint->tip_lps_mm, recording.endpoint->direction)
          : imaging::needle_pose(scene.instrument, pose.tip_lps_mm, pose.needle_direction);
  const cases::ConsoleSetting console = console_at_end(recording);
  const tissue::Displacement displacement = displacement_at_end(scene, recording);
  if (scene.picture.modality == cases::Modality::ultrasound)
    return png_of(UltrasoundSight(scene).picture(probe_of(pose), console, needle, recording.hashes.back(),
                                                 recording.frames.size(), displacement));
  return png_of(slice_under_probe(scene, pose, console, needle, displacement));
}

Replay replay(const cases::Case& scene, const cases::Recording& recording, const TickSeen& seen) {
  const bool comparable = recording.step_version == engine::kStepVersion;
  const engine::Tick whole(scene);
  engine::TickState now;
  std::vector<cases::Event> events;
  std::size_t poses = 0;
  std::optional<cases::Endpoint> endpoint;
  const auto is_next = [](const auto& rows, std::size_t at, const auto& row) {
    return at < rows.size() && rows[at] == row;
  };
  for (std::size_t i = 0; i < recording.inputs.size(); ++i) {
    const cases::RecordedTick tick = whole.advance(recording.inputs[i], recording.dt_s, now);
    const std::size_t told = events.size();
    cases::add_events(now.state.t_s, tick, events);
    if (tick.endpoint) endpoint = tick.endpoint;
    bool same = tick.hash == recording.hashes[i];
    if (tick.pose) {
      same = same && is_next(recording.poses, poses, *tick.pose);
      if (tick.force && !recording.forces.empty()) same = same && is_next(recording.forces, poses, *tick.force);
      ++poses;
    }
    for (std::size_t e = told; recording.events && e < events.size(); ++e)
      same = same && is_next(*recording.events, e, events[e]);
    if (!same && comparable) return {false, now.state.tick};
    if (seen) seen(now.state, now.displacement);
  }
  if (!comparable) return {false, 0};
  const bool events_same = !recording.events || recording.events->size() == events.size();
  return {poses == recording.poses.size() && endpoint == recording.endpoint && events_same, now.state.tick};
}

}  // namespace seldinger::app
