#include "sim/haptics/probe/probe_law.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace seldinger::haptics {
namespace {

// Skin and what is on the bone: no bone lies nearer (design).
constexpr double kLeastBoneMm = 2.0;
// One ray meets or misses a rib's edge; the head is as wide as its contact. What is felt follows in this time, so
// that no edge is a step of more than 0.15 N a tick (design).
constexpr double kBoneFollowS = 0.05;

}  // namespace

ProbeLaw::ProbeLaw(const ProbeSettings& settings)
    : settings_(settings),
      contact_{settings.radius_mm, settings.shear_n_mm2, settings.stiffness_n_mm},
      damper_({.tick_s = settings.tick_s,
               .damping_n_s_mm = settings.damping_n_s_mm,
               .stiffness_n_mm = settings.stiffness_n_mm}),
      bone_share_(1.0 - base::exact_exp(-settings.tick_s / kBoneFollowS)) {
  CHECK(settings.radius_mm > 0.0 && settings.shear_n_mm2 > 0.0 && settings.friction >= 0.0);
}

ProbeForce ProbeLaw::advance(const SkinTouch& touch, ProbeTrack& track) const noexcept {
  ProbeForce force;
  if (!(touch.depth_mm > 0.0)) {
    track = {};
    return force;
  }
  const double per_bone_mm = 1.0 / std::max(kLeastBoneMm, touch.bone_mm);
  if (!track.touching) {
    track.last_lps_mm = touch.at_lps_mm;
    track.per_bone_mm = per_bone_mm;
  }
  track.per_bone_mm += bone_share_ * (per_bone_mm - track.per_bone_mm);
  force.pressure_n = contact_.force_n(touch.depth_mm, track.per_bone_mm);

  // Friction: a spring along the skin that slips. Stiffer at the same force holds less energy, softer loses force,
  // so that pressing while it is loaded gives nothing back.
  const double side_n_mm = contact_.side_stiffness_n_mm(touch.depth_mm);
  if (track.side_stiffness_n_mm > side_n_mm) track.shear_n *= side_n_mm / track.side_stiffness_n_mm;
  const glm::dvec3 moved_mm = touch.at_lps_mm - track.last_lps_mm;
  glm::dvec3 shear_n = track.shear_n - side_n_mm * moved_mm;
  shear_n -= glm::dot(shear_n, touch.outward) * touch.outward;
  const double shear_length_n = std::sqrt(glm::dot(shear_n, shear_n));
  const double limit_n = settings_.friction * force.pressure_n;
  if (shear_length_n > limit_n) shear_n *= limit_n / shear_length_n;
  force.friction_n = shear_n;

  const glm::dvec3 elastic_n = force.pressure_n * touch.outward + shear_n;
  track.damper_n = damper_.advance(track.damper_n, elastic_n - track.last_elastic_n);
  force.force_n = elastic_n + track.damper_n;
  const double outwards_n = glm::dot(force.force_n, touch.outward);
  if (outwards_n < 0.0) force.force_n -= outwards_n * touch.outward;

  track.last_lps_mm = touch.at_lps_mm;
  track.shear_n = shear_n;
  track.side_stiffness_n_mm = side_n_mm;
  track.last_elastic_n = elastic_n;
  track.touching = true;
  return force;
}

}  // namespace seldinger::haptics
