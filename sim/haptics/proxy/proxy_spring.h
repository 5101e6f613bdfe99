// The force between a proxy and the device that it stands for: a spring, and the damper on how fast that loads.
// It never pulls the hand towards what it touches.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "sim/haptics/contact/elastic_damper.h"
#include "sim/haptics/contact/stiffness_bound.h"

namespace seldinger::haptics {

struct ProxySpringTrack {
  glm::dvec3 elastic_n{0.0}, damper_n{0.0};
};

class ProxySpring {
 public:
  explicit ProxySpring(const DamperSettings& settings)
      : stiffness_n_mm_(settings.stiffness_n_mm), damper_(settings) {}

  // One tick: stretch_mm from the device to its proxy. N, on the hand.
  glm::dvec3 advance(const glm::dvec3& stretch_mm, ProxySpringTrack& track) const noexcept {
    const glm::dvec3 elastic_n = stiffness_n_mm_ * stretch_mm;
    track.damper_n = damper_.advance(track.damper_n, elastic_n - track.elastic_n);
    track.elastic_n = elastic_n;
    const double length2 = glm::dot(elastic_n, elastic_n);
    if (!(length2 > 0.0)) {
      track.damper_n = glm::dvec3(0.0);
      return glm::dvec3(0.0);
    }
    const glm::dvec3 force_n = elastic_n + track.damper_n;
    const double outwards = glm::dot(force_n, elastic_n);
    return outwards < 0.0 ? force_n - elastic_n * (outwards / length2) : force_n;
  }

 private:
  double stiffness_n_mm_;
  ElasticDamper damper_;
};

// Stiffness and damping of a proxy where nothing else is known: what every preset of a device bears.
inline constexpr DamperSettings kProxySpring = {
    0.001, kWallDampingNSMm, stiffness_bound_n_mm(kWallDampingNSMm, 0.001, 0.001) / kStiffnessMargin};

}  // namespace seldinger::haptics
