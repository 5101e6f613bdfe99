// What others and we ourselves have put under a probe before, to be charted against Hertz (bench --stage
// displacement, docs/decisions/0023). Nothing else uses it.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "app/measure/rigs/hertz_reference.h"

namespace seldinger::measure {

// mm at a place from the contact's middle, z inwards.
using ContactModel = std::function<glm::dvec3(const glm::dvec3& at_mm)>;

struct ContactPeer {
  const char* name;
  ContactModel displacement_mm;
};

// A bell times a fall-off with depth, tuned by eye (as Barnouin, GRAPP 2020, draws displacement); one Boussinesq
// source above the skin that agrees in force and depth; seven that share Hertz' pressure; seven fitted by least
// squares.
std::vector<ContactPeer> contact_peers(const BallContact& contact);

}  // namespace seldinger::measure
