#include "session/guidance/guidance.h"

#include "session/guidance/fluoroscopy_guidance.h"
#include "session/guidance/slice_guidance.h"
#include "session/guidance/ultrasound_guidance.h"
#include "sim/base/check.h"

namespace seldinger::session {

const cases::FrameTruth& Guidance::see(const cases::State& state, const tissue::Displacement& displacement) {
  look(state, displacement);
  state_.live = live(state);
  state_.truth.live = state_.live;
  state_.fresh = true;
  return state_.truth;
}

std::optional<cases::FrameTruth> Guidance::stay(const cases::State& state) {
  state_.fresh = false;
  if (!pulsed() || !state_.live || live(state)) return std::nullopt;
  state_.live = false;
  state_.truth.t_s = state.t_s;
  state_.truth.live = false;
  state_.truth.beam.reset();
  return state_.truth;
}

const GuidanceKind& guidance_kind(cases::Modality modality) noexcept {
  switch (modality) {
    case cases::Modality::mpr:
      return kSliceGuidance;
    case cases::Modality::xray:
      return kFluoroscopyGuidance;
    case cases::Modality::ultrasound:
      return kUltrasoundGuidance;
  }
  CHECK(false && "a modality of these");
  return kSliceGuidance;
}

Needs needs_of(cases::Modality modality) noexcept {
  return guidance_kind(modality).needs;
}

std::unique_ptr<Guidance> guidance_of(const cases::Case& scene) {
  return guidance_kind(scene.picture.modality).make(scene);
}

}  // namespace seldinger::session
