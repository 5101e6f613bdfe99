// How tissue holds a needle sideways: a beam on an elastic foundation as long as the needle is in tissue, so that
// nothing is switched at any depth (Hetényi, Beams on Elastic Foundation, 1946).
#pragma once

#include <glm/vec3.hpp>

#include "sim/case/gauge.h"
#include "sim/haptics/contact/elastic_damper.h"
#include "sim/haptics/needle/needle_law.h"

namespace seldinger::haptics {

// N mm²: E I of a steel tube, E 200 GPa.
double bending_stiffness_n_mm2(const cases::Gauge& gauge) noexcept;

// N/mm at the skin, for a beam with free ends that is in the foundation from there on: a rigid one's k L / 4 while
// it is short, k / 2λ once it is long (λ⁴ = k / 4 E I). foundation_n_mm2: the tissue's force per mm of needle and
// mm of shift.
double side_stiffness_n_mm(double inserted_mm, double bending_n_mm2, double foundation_n_mm2) noexcept;

// Tissue is twice as stiff across a thin rod as along it (slender bodies: Cox, J. Fluid Mech. 44, 1970; the same
// equations as for an incompressible solid).
inline constexpr double kFoundationNMm2 = 2.0 * kShaftStiffnessNMm2;

struct NeedleSideTrack {
  glm::dvec3 elastic_n{0.0}, damper_n{0.0}, last_mm{0.0};
  double stiffness_n_mm = 0.0;
  bool begun = false;
};

class NeedleSideLaw {
 public:
  // Tick, damping and stiffness as the needle law's.
  NeedleSideLaw(const NeedleSettings& settings, const cases::Gauge& gauge);

  // One tick: the needle at the skin is shifted by `shift_mm` from where it went in, across its line; inserted_mm
  // of it are in tissue. The force on the hand. Tissue that the needle reaches while shifted is not stretched by
  // that.
  glm::dvec3 advance(const glm::dvec3& shift_mm, double inserted_mm, NeedleSideTrack& track) const noexcept;

 private:
  double most_stiffness_n_mm_, bending_n_mm2_;
  ElasticDamper damper_;
};

}  // namespace seldinger::haptics
