// State: all that must be saved to go on. One writer: engine/step. Every field enters state_hash().
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "sim/case/inputs.h"

namespace seldinger::cases {

struct NeedleState {
  glm::dvec3 tip_lps_mm{0.0};
  glm::dvec3 direction{0.0, 0.0, 1.0};  // unit, hub → tip
  double depth_below_skin_mm = 0.0;     // > 0 inside the body: signed distance of the tip to the skin
  std::uint32_t skin_triangle = 0;      // nearest, the next query's hint
  bool in_body = false;                 // tip has passed the skin (never through a cut cap)
  glm::dvec3 entry_lps_mm{0.0};         // where it last passed; valid while in_body
  double inserted_mm = 0.0;             // along the shaft from the entry to the tip; 0 outside
};

struct ProbeState {
  glm::dvec3 origin_lps_mm{0.0};
  glm::dvec3 axial{0.0, 0.0, 1.0};    // unit
  glm::dvec3 lateral{1.0, 0.0, 0.0};  // unit, perpendicular to axial
  bool frozen = false;
};

struct FireState {
  bool fired = false;
  std::uint64_t tick = 0;             // of the first trigger
  glm::dvec3 tip_before_lps_mm{0.0};  // the endpoint pose
  glm::dvec3 direction{0.0};
  glm::dvec3 tip_after_lps_mm{0.0};  // core: advanced by the throw
};

struct State {
  std::uint64_t tick = 0;
  double t_s = 0.0;
  NeedleState needle;
  ProbeState probe;
  FireState fire;
};

// Hash of every field; the same on every machine.
std::uint64_t state_hash(const State& state) noexcept;

}  // namespace seldinger::cases
