// Guidance by what lies under the probe: pictures at a rate of their own, which go on while they are frozen.
#pragma once

#include "session/guidance/guidance.h"

namespace seldinger::session {

class ProbeGuidance : public Guidance {
 public:
  using Guidance::Guidance;

  bool pulsed() const noexcept override { return false; }
  bool live(const cases::State& state) const noexcept override { return !state.probe.frozen; }
  bool due(const cases::State& state) override { return state_.clock.due(state.t_s, rate_hz(state.probe.console)); }

 protected:
  void look(const cases::State& state, const tissue::Displacement& displacement) override;
  // What the picture under the probe shows.
  virtual cases::FrameTruth shown(const cases::State& state, const tissue::Displacement& displacement) const = 0;
};

}  // namespace seldinger::session
