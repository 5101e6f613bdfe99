// The damper of our laws: on how fast their springs load, never on how fast the hand moves, so that cutting and
// sliding at any steady speed feel none of it.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>

#include "sim/base/check.h"
#include "sim/base/exact_math.h"

namespace seldinger::haptics {

inline constexpr double kDamperCutoffHz = 100.0;  // low-pass (our judgement)

struct DamperSettings {
  double tick_s = 0.001;
  double damping_n_s_mm = 0.0;  // at the full stiffness
  double stiffness_n_mm = 0.0;  // of all springs together, at most
};

class ElasticDamper {
 public:
  // CHECKs that tick and stiffness are > 0 and damping ≥ 0.
  explicit ElasticDamper(const DamperSettings& settings)
      : ticks_(settings.damping_n_s_mm / (settings.stiffness_n_mm * settings.tick_s)),
        share_(1.0 - base::exact_exp(-2.0 * std::numbers::pi * kDamperCutoffHz * settings.tick_s)),
        slew_n_(kSlewNS * settings.tick_s) {
    CHECK(settings.tick_s > 0.0 && settings.stiffness_n_mm > 0.0);
    CHECK(settings.damping_n_s_mm >= 0.0);
  }

  // The damper's force of this tick from that of the last, where the springs' force has changed by `change_n`.
  double advance(double damper_n, double change_n) const noexcept {
    const double step_n = share_ * (ticks_ * change_n - damper_n);
    return damper_n + std::clamp(step_n, -slew_n_, slew_n_);
  }
  glm::dvec3 advance(const glm::dvec3& damper_n, const glm::dvec3& change_n) const noexcept {
    const glm::dvec3 step_n = share_ * (ticks_ * change_n - damper_n);
    const double length_n = std::sqrt(glm::dot(step_n, step_n));
    return damper_n + (length_n > slew_n_ ? slew_n_ / length_n : 1.0) * step_n;
  }

 private:
  // How fast the damper may change: at a hand's jerk it is no step of its own (design; the goal of 0.15 N a tick,
  // of which the springs take 0.1 at 200 mm/s).
  static constexpr double kSlewNS = 50.0;

  double ticks_, share_, slew_n_;
};

}  // namespace seldinger::haptics
