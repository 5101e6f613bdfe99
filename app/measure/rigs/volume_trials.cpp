#include "app/measure/rigs/volume_trials.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "sim/base/rng.h"

namespace seldinger::measure {
namespace {

constexpr double kBlurMm = 0.8, kDepthMm = 2.0, kStepMm = 0.1;
const glm::dvec3 kAxis(1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0);

double length_of(const glm::dvec3& v) {
  return std::sqrt(glm::dot(v, v));
}

// From the middle, the axis or the plane to p: how far p is out, times the way out.
glm::dvec3 out_of(Solid shape, const glm::dvec3& p) {
  if (shape == Solid::ball) return p;
  const glm::dvec3 along = kAxis * glm::dot(kAxis, p);
  return shape == Solid::cylinder ? p - along : along;
}

// Mm outside the solid's surface.
double height_mm(const SolidInCt& solid, const glm::dvec3& p) {
  if (solid.shape == Solid::plane) return glm::dot(kAxis, p);
  return length_of(out_of(solid.shape, p)) - solid.radius_mm;
}

glm::dvec3 normal_at(const SolidInCt& solid, const glm::dvec3& p) {
  if (solid.shape == Solid::plane) return kAxis;
  const glm::dvec3 out = out_of(solid.shape, p);
  return out / length_of(out);
}

}  // namespace

volume::Volume ct_of(const SolidInCt& solid, std::uint64_t seed) {
  const int n = 2 * static_cast<int>(solid.radius_mm) + 14;
  const double first = -0.5 * (n - 1) + 0.3;  // not symmetric about the voxels
  volume::Volume ct = volume::make_volume(glm::ivec3(n), glm::dvec3(1.0), glm::dmat3(1.0), glm::dvec3(first));
  std::size_t at = 0;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i, ++at) {
        const glm::dvec3 p = glm::dvec3(i, j, k) + first;
        // A blurred edge that is much less curved than the kernel is wide (integral of the kernel across it).
        const double share = 0.5 * std::erfc(height_mm(solid, p) / (kBlurMm * std::sqrt(2.0)));
        const double hu = solid.outside_hu + (solid.inside_hu - solid.outside_hu) * share +
                          solid.noise_hu * base::normal_at(seed, at);
        ct.hu[at] = static_cast<std::int16_t>(std::clamp(std::round(hu), double{volume::kAirHu}, 3000.0));
      }
  return ct;
}

Slide slide(const SolidInCt& solid, const volume::Volume& ct, const haptics::VolumeProxySettings& settings,
            int ticks, std::uint64_t seed) {
  const haptics::IsoSurface surface(ct, solid.iso_hu());
  const haptics::VolumeProxy proxy(settings);
  haptics::VolumeProxyTrack track;
  base::Rng rng(seed);
  const auto random = [&] { return glm::dvec3(rng.normal(), rng.normal(), rng.normal()); };
  glm::dvec3 heading = random(), last_n(0.0);
  glm::dvec3 place = solid.shape == Solid::plane ? glm::dvec3(0.0) : normal_at(solid, {1, 1, 1}) * solid.radius_mm;
  const double room_mm = solid.radius_mm;  // along a cylinder or a plane: then it turns round
  Slide result;
  double squares = 0.0, forces = 0.0;
  int counted = 0;
  const int settle = 400;  // pressed in at 20 mm/s
  for (int tick = 0; tick < ticks + settle; ++tick) {
    heading += 0.02 * random();
    if (solid.shape != Solid::ball && length_of(place) > room_mm) heading = -place;
    const glm::dvec3 normal = normal_at(solid, place);
    heading -= normal * glm::dot(normal, heading);
    heading /= length_of(heading);
    place += heading * kStepMm;
    place -= normal_at(solid, place) * height_mm(solid, place);
    const double depth_mm = std::min(kDepthMm, -2.0 + 0.02 * tick);
    const glm::dvec3 outward = normal_at(solid, place);
    const glm::dvec3 force_n = proxy.advance(surface, place - outward * depth_mm, track);
    if (tick >= settle) {
      const double length_n = length_of(force_n);
      if (!(length_n > 0.0)) ++result.lost;
      const double sine = length_of(glm::cross(force_n, outward));
      const double angle = std::atan2(sine, glm::dot(force_n, outward)) * (180.0 / std::numbers::pi);
      squares += angle * angle;
      forces += length_n;
      ++counted;
      result.most_step_n = std::max(result.most_step_n, length_of(force_n - last_n));
    }
    last_n = force_n;
  }
  result.direction_rms_deg = std::sqrt(squares / counted);
  result.force_off = forces / counted / (settings.spring.stiffness_n_mm * kDepthMm) - 1.0;
  return result;
}

}  // namespace seldinger::measure
