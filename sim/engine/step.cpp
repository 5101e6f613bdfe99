#include "sim/engine/step.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "sim/base/vectors.h"
#include "sim/engine/fluoroscopy.h"
#include "sim/tissue/breathing.h"

namespace seldinger::engine {
namespace {

// A device that says nothing usable (zero, NaN) leaves the last direction.
glm::dvec3 unit_or(const glm::dvec3& v, const glm::dvec3& last) noexcept {
  const double length2 = glm::dot(v, v);
  return length2 > 1e-12 && length2 < 1e12 ? v / std::sqrt(length2) : last;
}

void move_needle(const cases::Case& scene, const cases::Inputs& inputs, const cases::FireState& fire, bool first,
                 const tissue::Displacement& displacement, cases::NeedleState& needle) noexcept {
  needle.direction = unit_or(inputs.needle.axis, needle.direction);
  if (base::is_finite(inputs.needle.position_lps_mm)) {
    const bool thrown = fire.fired && scene.instrument.kind == cases::InstrumentKind::core;
    needle.tip_lps_mm =
        inputs.needle.position_lps_mm + needle.direction * (thrown ? scene.instrument.throw_mm : 0.0);
  }
  const glm::dvec3 rest_lps_mm = tissue::count_sources(displacement) > 0
                                     ? tissue::rest_of(displacement, needle.tip_lps_mm)
                                     : needle.tip_lps_mm;
  if (first)
    needle.skin = cases::start_passage(scene.skin_index, rest_lps_mm, needle.direction);
  else
    cases::advance_passage(scene.skin_index, rest_lps_mm, needle.skin);
  needle.inserted_mm =
      needle.skin.in_body ? glm::dot(rest_lps_mm - needle.skin.entry_lps_mm, needle.direction) : 0.0;
}

void move_probe(const cases::Inputs& inputs, cases::ProbeState& probe) noexcept {
  probe.frozen = inputs.freeze;
  if (base::is_finite(inputs.probe.position_lps_mm)) probe.origin_lps_mm = inputs.probe.position_lps_mm;
  probe.axial = unit_or(inputs.probe.axis, probe.axial);
  const glm::dvec3 side = inputs.probe.side - probe.axial * glm::dot(inputs.probe.side, probe.axial);
  const glm::dvec3 last = probe.lateral - probe.axial * glm::dot(probe.lateral, probe.axial);
  // Where both are along axial, any perpendicular will do.
  const glm::dvec3 any = std::abs(probe.axial.x) < 0.5 ? glm::cross(probe.axial, glm::dvec3(1.0, 0.0, 0.0))
                                                       : glm::cross(probe.axial, glm::dvec3(0.0, 1.0, 0.0));
  probe.lateral = unit_or(side, unit_or(last, any / std::sqrt(glm::dot(any, any))));
}

void breathe(const cases::Case& scene, cases::EventKind event, double dt_s, cases::PatientBreath& breath) noexcept {
  static constexpr cases::Breathing kUnseen{};  // also who lies still holds the breath when asked, and not for ever
  if (event == cases::EventKind::breath_hold_request) {
    breath.hold_asked = true;
    breath.state.failed = false;
  }
  if (event == cases::EventKind::breathe_again) breath.hold_asked = false;
  breath.level = tissue::advance(scene.breathing ? *scene.breathing : kUnseen, dt_s,
                                 {breath.hold_asked, event == cases::EventKind::cough}, breath.state);
  if (breath.state.failed) breath.hold_asked = false;
  breath.moves = scene.breathing.has_value();
}

}  // namespace

void step(const cases::Case& scene, const cases::Inputs& inputs, double dt_s, cases::State& state) noexcept {
  step(scene, inputs, dt_s, {}, state);
}

void step(const cases::Case& scene, const cases::Inputs& inputs, double dt_s,
          const tissue::Displacement& displacement, cases::State& state) noexcept {
  const bool first = state.tick == 0;
  ++state.tick;
  state.t_s = static_cast<double>(state.tick) * dt_s;
  breathe(scene, inputs.event, dt_s, state.breath);
  move_probe(inputs, state.probe);
  if (scene.picture.modality != cases::Modality::xray) cases::turn(state.probe.console, inputs.console);
  if (scene.picture.modality == cases::Modality::xray) advance_fluoroscope(scene, inputs, dt_s, state.fluoroscopy);
  // Let go of, the needle stays where it is, and nobody pulls the trigger.
  if (scene.picture.modality == cases::Modality::xray && inputs.fluoroscope.hand_away && !first) return;
  move_needle(scene, inputs, state.fire, first, displacement, state.needle);
  if (!inputs.fire || state.fire.fired) return;
  // The endpoint is where the tip stands when the trigger falls; a core needle's throw follows in the same tick.
  state.fire = {true, state.t_s, state.needle.tip_lps_mm, state.needle.direction};
  if (scene.instrument.kind == cases::InstrumentKind::core)
    move_needle(scene, inputs, state.fire, false, displacement, state.needle);
}

}  // namespace seldinger::engine
