#include "sim/volume/phantom.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/base/check.h"
#include "sim/base/rng.h"
#include "sim/volume/phantom_parts.h"

namespace seldinger::volume {
namespace phantom {

void add(Shapes& shapes, const Tissue& tissue, const Geometry& geometry, const Over& over) {
  shapes.push_back({.geometry = geometry, .hu = tissue.hu, .class_name = tissue.name, .over = over});
}

void add_tube(Shapes& shapes, const Tissue& tissue, const std::vector<Knot>& knots, const Over& over) {
  constexpr double kPiece_mm = 6.0;  // short enough that no bend shows its corners
  const auto at = [&](std::size_t i, int offset) {
    const auto last = static_cast<std::ptrdiff_t>(knots.size()) - 1;
    return knots[static_cast<std::size_t>(
        std::clamp(static_cast<std::ptrdiff_t>(i) + offset, std::ptrdiff_t{0}, last))];
  };
  const auto curve = [](auto a, auto b, auto c, auto d, double t) {
    return 0.5 * (2.0 * b + (c - a) * t + (2.0 * a - 5.0 * b + 4.0 * c - d) * (t * t) +
                  (3.0 * b - a - 3.0 * c + d) * (t * t * t));
  };
  CHECK(!knots.empty());
  add(shapes, tissue, Sphere{knots[0].p_mm, knots[0].radius_mm}, over);
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    const Knot a = at(i, -1), b = at(i, 0), c = at(i, 1), d = at(i, 2);
    const int pieces = static_cast<int>(glm::distance(b.p_mm, c.p_mm) / kPiece_mm) + 1;
    Knot from = b;
    for (int piece = 1; piece <= pieces; ++piece) {
      const double t = static_cast<double>(piece) / pieces;
      const Knot to{curve(a.p_mm, b.p_mm, c.p_mm, d.p_mm, t), b.radius_mm + (c.radius_mm - b.radius_mm) * t};
      add(shapes, tissue, Cylinder{from.p_mm, to.p_mm, 0.5 * (from.radius_mm + to.radius_mm)}, over);
      add(shapes, tissue, Sphere{to.p_mm, to.radius_mm}, over);
      from = to;
    }
  }
}

std::vector<Knot> with_radius(std::vector<Knot> knots, double radius_mm) {
  for (Knot& knot : knots) knot.radius_mm = radius_mm;
  return knots;
}

glm::dvec3 mirrored(const glm::dvec3& p_mm, double side) {
  return {side * p_mm.x, p_mm.y, p_mm.z};
}

}  // namespace phantom

AnalyticVolume phantom_shapes(const PhantomOptions& options) {
  constexpr glm::dvec3 kFirstVoxel{-189.0, -132.0, -165.0}, kExtent{378.0, 264.0, 330.0};
  AnalyticVolume analytic;
  analytic.origin_mm = kFirstVoxel;
  analytic.spacing_mm = options.spacing_mm;
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(options.spacing_mm[axis] > 0.0);
    analytic.size_voxels[axis] = static_cast<int>(std::floor(kExtent[axis] / options.spacing_mm[axis])) + 1;
  }
  phantom::Shapes& shapes = analytic.shapes;
  phantom::add_body_layers(shapes);
  phantom::add_trunk_muscles(shapes);
  phantom::add_lungs(shapes);
  phantom::add_liver(shapes);
  phantom::add_mediastinum(shapes);
  phantom::add_upper_abdomen(shapes);
  phantom::add_bowel(shapes);
  phantom::add_kidneys(shapes, options.calyces);
  phantom::add_great_vessels(shapes);
  phantom::add_spine(shapes);
  phantom::add_pelvis(shapes);
  phantom::add_ribs(shapes);
  return analytic;
}

void add_ct_noise(double sd_hu, std::uint64_t seed, Phantom& phantom) {
  constexpr double kNoiseInAir = 0.5;  // of the body's: far from the −1024 floor, so that its mean stays unbiased
  if (sd_hu == 0.0) return;
  for (std::size_t at = 0; at < phantom.volume.hu.size(); ++at) {
    const double here_hu = sd_hu * (phantom.labels.label[at] == 0 ? kNoiseInAir : 1.0);
    const double hu = phantom.volume.hu[at] + here_hu * base::normal_at(seed, at);
    phantom.volume.hu[at] =
        static_cast<std::int16_t>(std::clamp(std::round(hu), static_cast<double>(kAirHu), 32767.0));
  }
}

Phantom make_phantom(const PhantomOptions& options) {
  Phantom made;
  made.volume = rasterize(phantom_shapes(options), made.labels);
  add_ct_noise(options.noise_sd_hu, options.seed, made);
  return made;
}

}  // namespace seldinger::volume
