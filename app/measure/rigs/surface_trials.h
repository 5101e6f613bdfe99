// Trials of the surface proxy: what the tests assert and the bench times. Deterministic.
#pragma once

#include <vector>

#include "sim/case/form/mesh.h"
#include "sim/case/form/mesh_index.h"
#include "sim/haptics/proxy/surface_proxy.h"

namespace seldinger::measure {

inline constexpr double kBumpySphereMm = 50.0;

// Radius of the wavy, in places concave surface below, mm, in the direction of the unit vector.
double bumpy_radius_mm(const glm::dvec3& outward) noexcept;

// A sphere of about kBumpySphereMm about the origin with waves of 1.5 mm; 2 · around · rings triangles in rows from
// pole to pole, where they have no area. 448 × 224 are 200,704.
cases::Mesh bumpy_sphere(int around, int rings);

struct Glide {
  int snags = 0;           // ticks in which the proxy stays behind: farther than depth · (1 + µ) + 0.2 mm (S8)
  int inside = 0;          // ticks in which it is nearer than the ball's slack allows
  double most_mm = 0.0;    // of what it stays behind beyond depth · (1 + µ)
  double most_step_n = 0;  // of the force, a tick
};

// Where a tool is, tick by tick, that is pressed in and then glides about 2 mm deep all over the bumpy sphere at
// about 0.1 m/s.
std::vector<glm::dvec3> gliding_tool(double radius_mm, int ticks, std::uint64_t seed);

// That tool (S8). What is deep is asked of the mesh itself, at the device. µ: static friction.
Glide glide(const cases::MeshIndex& mesh, const haptics::SurfaceSettings& settings, int ticks, std::uint64_t seed);

struct Crossings {
  int sweeps = 0, inside = 0, untouched = 0;
};

// Straight sweeps of the device into the bumpy sphere, each in another direction at 0.1 to 2 m/s, every eighth as
// one jump to the other side (S10). The proxy must stay outside, and what was met be felt.
Crossings sweep(const cases::MeshIndex& mesh, const haptics::SurfaceSettings& settings, int sweeps,
                std::uint64_t seed);

}  // namespace seldinger::measure
