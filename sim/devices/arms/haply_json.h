// Messages of the Haply Inverse service, version 3: JSON text (docs.haply.co). The service tells states in answer
// to commands, once of its own accord after the connection; positions in metres, orientations as unit quaternions.
#pragma once

#include <bitset>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace seldinger::devices {

struct HaplyMessage {
  struct Arm {
    std::string id;
    std::string handedness;  // in the first message only
    std::optional<glm::dvec3> position_m;
  };
  struct Grip {
    std::string id;
    std::optional<glm::dmat3> orientation;  // a rotation
    std::bitset<8> buttons;
  };
  std::vector<Arm> arms;
  std::vector<Grip> grips;
};

// What cannot be used (numbers that are none or out of reach, a quaternion of no length, ids that are none) is left
// out; nothing: no message of the service.
std::optional<HaplyMessage> haply_message(std::string_view text);
std::string text_of(const HaplyMessage& message);

struct HaplyForce {
  std::string id;
  glm::dvec3 force_n{0.0};
};
std::string text_of(const std::vector<HaplyForce>& forces);
// Nothing: no command of ours. Forces that are no numbers are left out.
std::optional<std::vector<HaplyForce>> haply_forces(std::string_view text);

}  // namespace seldinger::devices
