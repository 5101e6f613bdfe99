#include "session/attempt/endpoint_picture.h"

#include <optional>

#include "session/guidance/guidance.h"
#include "sim/base/check.h"
#include "sim/engine/step.h"
#include "sim/engine/tick.h"

namespace seldinger::session {
namespace {

// The last pulse before the trigger: the inputs, stepped through again until then. Only what moves tissue asks for
// more than the step.
std::optional<engine::Moment> last_pulse(const cases::Case& scene, const cases::Recording& recording) {
  std::optional<engine::Moment> pulse;
  if (scene.breathing || scene.yields) {
    const engine::Tick tick(scene);
    engine::TickState now;
    for (const cases::Inputs& inputs : recording.inputs) {
      if (now.state.fire.fired) break;
      tick.advance(inputs, recording.dt_s, now);
      if (now.state.fluoroscopy.frame_due) pulse = engine::moment_of(now);
    }
    return pulse;
  }
  cases::State state;
  for (const cases::Inputs& inputs : recording.inputs) {
    if (state.fire.fired) break;
    engine::step(scene, inputs, recording.dt_s, state);
    if (state.fluoroscopy.frame_due) pulse = engine::Moment{state};
  }
  return pulse;
}

tissue::Displacement displacement_at_end(const cases::Case& scene, const cases::Recording& recording) {
  if (!scene.breathing && !scene.yields) return {};
  const engine::Tick tick(scene);
  engine::TickState now;
  for (const cases::Inputs& inputs : recording.inputs)
    if (!now.state.fire.fired) tick.advance(inputs, recording.dt_s, now);
  return now.displacement;
}

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

// When the trigger fell, or last, by what was recorded: the needle as the endpoint has it, the probe in the last
// pose until then, the console as it stood.
engine::Moment moment_at_end(const cases::Case& scene, const cases::Recording& recording) {
  CHECK(!recording.poses.empty());
  cases::PoseSample pose = recording.poses.back();
  if (recording.endpoint)
    for (const cases::PoseSample& one : recording.poses)
      if (one.t_s <= recording.endpoint->t_s) pose = one;
  engine::Moment end;
  end.state.t_s = pose.t_s;
  end.state.needle.tip_lps_mm = recording.endpoint ? recording.endpoint->tip_lps_mm : pose.tip_lps_mm;
  end.state.needle.direction = recording.endpoint ? recording.endpoint->direction : pose.needle_direction;
  end.state.probe.origin_lps_mm = pose.probe_origin_lps_mm;
  end.state.probe.axial = pose.probe_axial;
  end.state.probe.lateral = pose.probe_lateral;
  end.state.probe.console = console_at_end(recording);
  end.displacement = displacement_at_end(scene, recording);
  return end;
}

}  // namespace

GreyPicture picture_at_endpoint(const cases::Case& scene, const cases::Recording& recording) {
  CHECK(!recording.hashes.empty());
  const std::unique_ptr<Guidance> guidance = guidance_of(scene);
  const std::optional<engine::Moment> moment =
      guidance->pulsed() ? last_pulse(scene, recording) : moment_at_end(scene, recording);
  if (!moment) return {};
  return guidance->picture(moment->state, moment->displacement, {recording.hashes.back(), recording.frames.size()});
}

}  // namespace seldinger::session
