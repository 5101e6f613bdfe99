// Which way a tool is to be led, in words: by the mouse as the room is seen now, and by the key that does the same.
#pragma once

#include <glm/vec3.hpp>
#include <string>

#include "sim/case/inputs.h"
#include "sim/devices/hands/mouse_hands.h"

namespace seldinger::app {

// To bring it that way: "to the right by 12.0 mm (drag, or D)". The probe goes along the skin, which its axis
// stands on; the needle, in the air, along its own axis too. Of what it takes, the part that leads furthest.
std::string slide_words(const glm::dvec3& way_lps_mm, devices::HeldTool tool, const glm::dvec3& axis,
                        const devices::HandView& view);
// To make the needle point so, a unit vector: "its hub to the left by 30° (right drag, or K)".
std::string aim_words(const glm::dvec3& direction, const cases::ToolPose& needle, const devices::HandView& view);
// About the probe's axis: "by 53° (middle drag to the right, or O)".
std::string rotate_words(double by_rad);
// In its plane, about that plane's normal, axial × lateral: "by 12° (right drag to the right, or L)".
std::string rock_words(double by_rad);

}  // namespace seldinger::app
