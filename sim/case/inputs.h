// Inputs: what hands and buttons say in one tick. The only thing a recording must hold to replay an attempt.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "sim/case/console.h"
#include "sim/case/event.h"
#include "sim/case/fluoroscope.h"

namespace seldinger::cases {

// Pose of a hand-held tool. Needle: position = tip, axis = hub → tip. Probe: position = centre of the face, axis =
// axial (into the body), side = lateral. axis and side are near-unit and near-perpendicular; step() makes them so.
struct ToolPose {
  glm::dvec3 position_lps_mm{0.0};
  glm::dvec3 axis{0.0, 0.0, 1.0};
  glm::dvec3 side{1.0, 0.0, 0.0};
};

struct Inputs {
  ToolPose needle;
  ToolPose probe;
  bool fire = false;                  // trigger is down
  bool freeze = false;                // picture is frozen
  ConsoleSetting console;             // under xray it says nothing
  EventKind event = EventKind::none;  // said or asked for in this tick, by trainee or mentor
  std::uint16_t event_tenths_mm = 0;  // the length that is told with it, in 0.1 mm; 0: none
  FluoroscopeInputs fluoroscope;
  ExposureReport exposure;  // of the last exposed frame, by imaging; each frame's counts once
};

}  // namespace seldinger::cases
