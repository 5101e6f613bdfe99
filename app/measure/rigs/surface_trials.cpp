#include "app/measure/rigs/surface_trials.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "sim/base/exact_math.h"
#include "sim/base/rng.h"

namespace seldinger::measure {
namespace {

constexpr double kDepthMm = 2.0;

glm::dvec3 direction_of(base::Rng& rng) {
  const glm::dvec3 v(rng.normal(), rng.normal(), rng.normal());
  return v / std::sqrt(glm::dot(v, v));
}

}  // namespace

double bumpy_radius_mm(const glm::dvec3& d) noexcept {
  return kBumpySphereMm + 1.5 * base::exact_sin(9.0 * d.x) * base::exact_cos(7.0 * d.y + 4.0 * d.z);
}

cases::Mesh bumpy_sphere(int around, int rings) {
  cases::Mesh mesh;
  for (int ring = 0; ring <= rings; ++ring)
    for (int i = 0; i < around; ++i) {
      const double polar = std::numbers::pi * ring / rings, turn = 2.0 * std::numbers::pi * i / around;
      const bool pole = ring == 0 || ring == rings;
      const double across = pole ? 0.0 : base::exact_sin(polar);
      const glm::dvec3 d(across * base::exact_cos(turn), across * base::exact_sin(turn), base::exact_cos(polar));
      mesh.vertices_lps_mm.push_back(glm::vec3(d * bumpy_radius_mm(d)));
    }
  const auto at = [&](int ring, int i) { return static_cast<unsigned>(ring * around + i % around); };
  for (int ring = 0; ring < rings; ++ring)
    for (int i = 0; i < around; ++i) {
      mesh.triangles.emplace_back(at(ring, i), at(ring + 1, i), at(ring, i + 1));
      mesh.triangles.emplace_back(at(ring, i + 1), at(ring + 1, i), at(ring + 1, i + 1));
    }
  mesh.cut.assign(mesh.triangles.size(), 0);
  return mesh;
}

std::vector<glm::dvec3> gliding_tool(double radius_mm, int ticks, std::uint64_t seed) {
  std::vector<glm::dvec3> path;
  base::Rng rng(seed);
  glm::dvec3 place = direction_of(rng), heading = direction_of(rng);
  double entered_mm = -radius_mm - 0.1;  // pressed in at 20 mm/s
  for (int tick = 0; tick < ticks; ++tick) {
    // 0.1 mm a tick along the sphere, by a heading that wanders.
    heading += 0.02 * glm::dvec3(rng.normal(), rng.normal(), rng.normal());
    heading -= place * glm::dot(heading, place);
    heading /= std::sqrt(glm::dot(heading, heading));
    place += heading * (0.1 / kBumpySphereMm);
    place /= std::sqrt(glm::dot(place, place));
    entered_mm = std::min(kDepthMm, entered_mm + 0.02);
    path.push_back(place * (bumpy_radius_mm(place) - entered_mm));
  }
  return path;
}

Glide glide(const cases::MeshIndex& mesh, const haptics::SurfaceSettings& settings, int ticks, std::uint64_t seed) {
  const haptics::SurfaceProxy proxy(settings);
  haptics::SurfaceTrack track;
  Glide result;
  glm::dvec3 last_n(0.0);
  std::uint32_t near = 0;
  for (const glm::dvec3& device : gliding_tool(proxy.radius_mm(), ticks, seed)) {
    const glm::dvec3 force_n = proxy.advance(mesh, device, track);
    const cases::Closest device_at = mesh.closest(device, near);
    near = device_at.triangle;
    const double depth_mm = std::max(0.0, proxy.radius_mm() - device_at.distance_mm);
    const glm::dvec3 behind = track.proxy_lps_mm - device;
    const double beyond_mm = std::sqrt(glm::dot(behind, behind)) - depth_mm * (1.0 + settings.static_friction);
    result.most_mm = std::max(result.most_mm, beyond_mm);
    if (!(beyond_mm <= 0.2)) ++result.snags;
    if (!(mesh.closest(track.proxy_lps_mm, track.triangle).distance_mm >= 0.9 * proxy.radius_mm() - 1e-3))
      ++result.inside;
    const glm::dvec3 step_n = force_n - last_n;
    result.most_step_n = std::max(result.most_step_n, std::sqrt(glm::dot(step_n, step_n)));
    last_n = force_n;
  }
  return result;
}

Crossings sweep(const cases::MeshIndex& mesh, const haptics::SurfaceSettings& settings, int sweeps,
                std::uint64_t seed) {
  const haptics::SurfaceProxy proxy(settings);
  Crossings result;
  base::Rng rng(seed);
  for (int i = 0; i < sweeps; ++i) {
    const glm::dvec3 outward = direction_of(rng), to = direction_of(rng) * (0.8 * kBumpySphereMm);
    const glm::dvec3 from = outward * (bumpy_radius_mm(outward) + proxy.radius_mm() + 0.1 + 2.0 * rng.uniform());
    const double speed_mm = i % 8 == 0 ? 1e3 : 0.1 + 1.9 * rng.uniform();  // a tick; a jump
    glm::dvec3 along = (i % 8 == 0 ? -0.5 * from : to) - from;
    const double length_mm = std::sqrt(glm::dot(along, along));
    along /= length_mm;
    haptics::SurfaceTrack track;
    bool inside = false;
    proxy.advance(mesh, from, track);
    glm::dvec3 force_n(0.0);
    for (int tick = 1; tick <= 12; ++tick) {
      const glm::dvec3 device = from + along * std::min(length_mm, speed_mm * tick);
      force_n = proxy.advance(mesh, device, track);
      inside = inside || !(mesh.closest(track.proxy_lps_mm, track.triangle).distance_mm > 0.0);
    }
    const glm::dvec3 end = from + along * std::min(length_mm, speed_mm * 12);
    const bool met = mesh.closest(end, track.triangle).distance_mm < 0.0;
    ++result.sweeps;
    if (inside) ++result.inside;
    if (met && !(glm::dot(force_n, force_n) > 0.0)) ++result.untouched;
  }
  return result;
}

}  // namespace seldinger::measure
