// Touching a mesh: a ball that follows the device and stays outside (Ruspini, Kolarov and Khatib, SIGGRAPH 1997:
// virtual proxy). The ball moves from where it was, never from where the device was, and as far as nothing comes
// nearer than its radius, so nothing is crossed at any speed, and it does not matter which way triangles face,
// whether they close or overlap. What it touches is solved together each tick, not one by one.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "sim/case/form/mesh_index.h"
#include "sim/haptics/proxy/proxy_spring.h"

namespace seldinger::haptics {

// A point is a ball too small to feel (design).
inline constexpr double kPointRadiusMm = 0.01;

struct SurfaceSettings {
  DamperSettings spring = kProxySpring;
  double radius_mm = 0.0;        // less than kPointRadiusMm means that
  double static_friction = 0.0;  // ≥ dynamic_friction
  double dynamic_friction = 0.0;
};

// What must be kept from tick to tick. A new one: the ball will start where the device is.
struct SurfaceTrack {
  glm::dvec3 proxy_lps_mm{0.0};  // the ball's middle
  ProxySpringTrack spring;
  std::uint32_t triangle = 0;  // touched last
  bool begun = false, touching = false;
  bool holding = false;  // static friction has it
};

class SurfaceProxy {
 public:
  // CHECKs tick and stiffness > 0, radius, damping and friction ≥ 0, static ≥ dynamic friction.
  explicit SurfaceProxy(const SurfaceSettings& settings);

  // One tick: moves the ball towards the device, as near as touching and friction allow. The force on the hand,
  // N; never towards the surface. Allocates nothing. A device that is nowhere (not finite) moves nothing.
  glm::dvec3 advance(const cases::MeshIndex& mesh, const glm::dvec3& device_lps_mm,
                     SurfaceTrack& track) const noexcept;

  double radius_mm() const noexcept { return settings_.radius_mm; }  // as it is used

 private:
  void follow(const cases::MeshIndex& mesh, const glm::dvec3& device_lps_mm, SurfaceTrack& track) const noexcept;

  SurfaceSettings settings_;
  ProxySpring spring_;
};

}  // namespace seldinger::haptics
