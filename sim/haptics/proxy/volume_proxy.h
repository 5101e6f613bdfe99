// Touching a surface of equal HU in the CT itself: a point that follows the device and stays out of what is solid
// (Salisbury and Tarr, ASME DSC 61, 1997: sphere and point proxies on implicit surfaces).
#pragma once

#include <glm/vec3.hpp>

#include "sim/haptics/proxy/iso_surface.h"
#include "sim/haptics/proxy/proxy_spring.h"

namespace seldinger::haptics {

struct VolumeProxySettings {
  DamperSettings spring = kProxySpring;
  double static_friction = 0.0, dynamic_friction = 0.0;  // static ≥ dynamic
};

// What must be kept from tick to tick. A new one: the proxy will start where the device is.
struct VolumeProxyTrack {
  glm::dvec3 proxy_lps_mm{0.0};
  ProxySpringTrack spring;
  bool begun = false, touching = false, holding = false;
};

class VolumeProxy {
 public:
  // CHECKs tick and stiffness > 0, damping and friction ≥ 0, static ≥ dynamic friction.
  explicit VolumeProxy(const VolumeProxySettings& settings);

  // One tick; the force on the hand, N. The proxy looks at its way every quarter of a voxel, so nothing as thick is
  // crossed at any speed; of a long way the rest is for the next ticks. A proxy that starts inside goes with the
  // device until that is outside. Allocates nothing. A device that is not finite moves nothing.
  glm::dvec3 advance(const IsoSurface& surface, const glm::dvec3& device_lps_mm,
                     VolumeProxyTrack& track) const noexcept;

 private:
  void follow(const IsoSurface& surface, const glm::dvec3& device_lps_mm, VolumeProxyTrack& track) const noexcept;

  VolumeProxySettings settings_;
  ProxySpring spring_;
};

}  // namespace seldinger::haptics
