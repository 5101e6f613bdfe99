// State: all that must be saved to go on. Writers: engine/step and, of what flows
// through the needle, engine/needle_flow. Every field enters state_hash().
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "sim/case/breathing.h"
#include "sim/case/fluoroscope.h"
#include "sim/case/inputs.h"
#include "sim/case/needle_flow.h"
#include "sim/case/skin_passage.h"

namespace seldinger::cases {

struct NeedleState {
  glm::dvec3 tip_lps_mm{0.0};           // after a core needle's throw: of the thrown tip
  glm::dvec3 direction{0.0, 0.0, 1.0};  // unit, hub → tip
  SkinPassage skin;                     // where the tip is relative to the skin
  double inserted_mm = 0.0;             // along the shaft from the entry to the tip; 0 outside
};

struct ProbeState {
  glm::dvec3 origin_lps_mm{0.0};
  glm::dvec3 axial{0.0, 0.0, 1.0};    // unit
  glm::dvec3 lateral{1.0, 0.0, 0.0};  // unit, perpendicular to axial
  bool frozen = false;
  ConsoleSetting console;  // hashed only where it is not as the case's picture has it
};

// A patient holds the breath whether or not the case shows how it moves the tissue.
struct PatientBreath {
  BreathState state;
  bool hold_asked = false;
  bool moves = false;  // the case breathes: what follows from it counts in the hash
  double level = 0.0;  // 0 breathed out, about 1 breathed in
};

struct FireState {
  bool fired = false;
  double t_s = 0.0;            // of the first trigger
  glm::dvec3 tip_lps_mm{0.0};  // the endpoint pose, before any throw
  glm::dvec3 direction{0.0, 0.0, 1.0};
};

struct State {
  std::uint64_t tick = 0;  // ticks done
  double t_s = 0.0;        // tick · dt
  NeedleState needle;
  ProbeState probe;
  FireState fire;
  PatientBreath breath;
  FluoroscopyState fluoroscopy;
  NeedleFlow flow;  // hashed only where it is in use
};

// Hash of every field, chained to the hash of the tick before; the same on every machine.
std::uint64_t state_hash(const State& state, std::uint64_t previous) noexcept;

}  // namespace seldinger::cases
