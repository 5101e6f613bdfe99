// What reaches the motors of what a law asks for: no more than their peak, no more over time than they bear for
// ever, nothing within 20 ms of a fault, and no jump when it is over (docs/touch.md, S16 and S17).
#pragma once

#include <glm/vec3.hpp>

namespace seldinger::haptics {

// A force that a fault took away comes back in this (design).
inline constexpr double kReturnS = 0.3;

struct ForceLimits {
  double peak_n = 0.0, continuous_n = 0.0;  // 0 < continuous ≤ peak
  double tick_s = 0.001;
};

// What must be kept from tick to tick. A new one starts without force, and lets it in.
struct ForceLimiterState {
  glm::dvec3 out_n{0.0};
  double share = 0.0;    // of what is asked for, while it comes in
  double heat_n2 = 0.0;  // mean square of the force over the motors' thermal time
  glm::dvec3 fault_n{0.0};
  double fault_s = 0.0;      // since the fault began; 0: there is none
  double held_back_n = 0.0;  // of what was asked for, as the motors bear no more
};

class ForceLimiter {
 public:
  // CHECKs the limits.
  explicit ForceLimiter(const ForceLimits& limits);

  // One tick, `elapsed_s` after the last; healthy: the device answers and the pose is one. A wanted force that is
  // not finite is a fault.
  glm::dvec3 advance(const glm::dvec3& wanted_n, double elapsed_s, bool healthy,
                     ForceLimiterState& state) const noexcept;

 private:
  ForceLimits limits_;
};

}  // namespace seldinger::haptics
