// The force on a hand that holds a probe against the skin, tick by tick: soft contact over bone, friction along the
// skin (Dahl's model of order 0), a damper on how fast these load. No mode is switched anywhere: over a rib the
// same formula hardens. The touch itself (how deep, which way is out, how deep bone lies) is asked of the caller.
#pragma once

#include <glm/vec3.hpp>

#include "sim/haptics/contact/elastic_damper.h"
#include "sim/haptics/contact/soft_contact.h"
#include "sim/haptics/contact/stiffness_bound.h"

namespace seldinger::haptics {

// Where the probe's head, a sphere, is against the undeformed skin.
struct SkinTouch {
  glm::dvec3 at_lps_mm{0.0};  // the head's place
  glm::dvec3 outward{0.0};    // unit: from the skin to the head's middle
  double depth_mm = 0.0;      // the head's deepest point below the skin; ≤ 0: no contact
  double bone_mm = 0.0;       // how deep bone lies below the skin there; infinity: none
};

struct ProbeSettings {
  double tick_s = 0.001;
  double damping_n_s_mm = kWallDampingNSMm;
  double stiffness_n_mm = stiffness_bound_n_mm(kWallDampingNSMm, 0.001, 0.001) / kStiffnessMargin;
  double radius_mm = SoftContact{}.radius_mm;
  double shear_n_mm2 = SoftContact{}.shear_n_mm2;
  double friction = 0.15;  // of skin under gel (design)
};

// What must be kept from tick to tick. A new one: nothing touched yet.
struct ProbeTrack {
  glm::dvec3 last_lps_mm{0.0};
  glm::dvec3 shear_n{0.0}, damper_n{0.0}, last_elastic_n{0.0};
  double side_stiffness_n_mm = 0.0;
  double per_bone_mm = 0.0;  // 1 / depth of bone, as it is felt by now
  bool touching = false;
};

// Newtons, on the hand.
struct ProbeForce {
  glm::dvec3 force_n{0.0};     // the sum of what follows and the damper; never pulls towards the skin
  double pressure_n = 0.0;     // ≥ 0, outwards
  glm::dvec3 friction_n{0.0};  // along the skin
};

class ProbeLaw {
 public:
  // CHECKs that tick, stiffness, radius and modulus are > 0, damping and friction ≥ 0.
  explicit ProbeLaw(const ProbeSettings& settings);

  // One tick. Allocates nothing.
  ProbeForce advance(const SkinTouch& touch, ProbeTrack& track) const noexcept;

 private:
  ProbeSettings settings_;
  SoftContact contact_;
  ElasticDamper damper_;
  double bone_share_;
};

}  // namespace seldinger::haptics
