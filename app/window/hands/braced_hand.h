// A hand that holds a tool at a patient who breathes is braced on the body, and goes with it. Hands at a mouse know
// the skin at rest only; this carries their tools as far as breath carries the skin below them.
#pragma once

#include "sim/case/case.h"
#include "sim/case/inputs.h"
#include "sim/case/state.h"
#include "sim/engine/moving_tissue.h"

namespace seldinger::app {

class BracedHand {
 public:
  // The scene must outlive it. Without breath in it nothing is carried.
  explicit BracedHand(const cases::Case& scene) : scene_(scene), tissue_(scene) {}

  // After each tick. Allocates nothing, as carried.
  void see(const cases::State& state) noexcept {
    if (tissue_.breathes()) breath_ = tissue_.felt_by_probe(state);
  }
  // From where a hand holds it at the patient at rest to where it is: moved, not turned, by what moves the skin
  // that is nearest to where the shaft enters (inserted_mm up from the tip).
  cases::ToolPose carried(cases::ToolPose at_rest, double inserted_mm) const noexcept;
  // The other way round: where a hand holds, at the patient at rest, what is there.
  cases::ToolPose put_back(const cases::ToolPose& pose, double inserted_mm) const noexcept;

 private:
  const cases::Case& scene_;
  engine::MovingTissue tissue_;
  tissue::Displacement breath_{};
};

}  // namespace seldinger::app
