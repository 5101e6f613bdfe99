#include "session/guidance/probe_guidance.h"

#include "session/guidance/frame_truth.h"

namespace seldinger::session {

void ProbeGuidance::look(const cases::State& state, const tissue::Displacement& displacement) {
  state_.truth = shown(state, displacement);
  const auto target = target_of(scene_.lesions);
  if (target && tissue::count_sources(displacement) > 0)
    state_.moved_mm = tissue::displaced(displacement, *target) - *target;
}

}  // namespace seldinger::session
