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

void add_bone(Shapes& shapes, const Tissue& cortex, const Tissue& marrow, std::vector<Knot> knots,
              double cortex_mm) {
  add_tube(shapes, cortex, knots);
  for (Knot& knot : knots) knot.radius_mm -= cortex_mm;
  add_tube(shapes, marrow, knots, {cortex.name});
}

void add_bone(Shapes& shapes, const Tissue& cortex, const Tissue& marrow, const Ellipsoid& lens, double cortex_mm) {
  add(shapes, cortex, lens);
  add(shapes, marrow, Ellipsoid{lens.center_mm, lens.radii_mm - cortex_mm}, {cortex.name});
}

void add_valve(Shapes& shapes, const Tissue& vein, const glm::dvec3& at_mm, double radius_mm) {
  constexpr double kThick_mm = 1.2;
  for (const double side : {-1.0, 1.0}) {
    const glm::dvec3 middle_mm = at_mm + glm::dvec3(side * 0.55 * radius_mm, 0.0, 0.0);
    const glm::dvec3 half_mm = 0.5 * kThick_mm * glm::dvec3(side * 0.8, 0.0, 0.6);
    add(shapes, kValve, Cylinder{middle_mm - half_mm, middle_mm + half_mm, 0.75 * radius_mm}, {vein.name});
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

namespace {

struct Scan {
  glm::dvec3 first_voxel_mm, extent_mm;  // of the adult
  glm::dvec3 spacing_mm;
};

Scan scan_of(Region region) {
  switch (region) {
    case Region::torso:
      return {{-189.0, -132.0, -165.0}, {378.0, 264.0, 330.0}, {1.5, 1.5, 3.0}};
    case Region::groin:
      return {{-192.0, -122.0, -340.0}, {384.0, 258.0, 180.0}, {1.0, 1.0, 1.25}};
    case Region::neck:
      return {{-180.0, -94.0, 262.0}, {360.0, 208.0, 132.0}, {0.9, 0.9, 1.0}};
  }
  CHECK(false);
}

phantom::Physique physique_of(const PhantomOptions& options) {
  phantom::Physique made;
  switch (options.body) {
    case Body::adult:
      break;
    case Body::lean:
      made = {1.0, {12.0, 11.0, 5.0}, 8.0, 4.0};
      break;
    case Body::obese:
      made = {1.0, {-34.0, -30.0, -16.0}, -24.0, -8.0};
      break;
    case Body::child:
      made = {0.7, {10.0, 9.0, 5.0}, 7.0, 3.5};
      break;
  }
  if (options.posture == Posture::prone) made.torso.front_mm += 6.0;
  made.prone = options.posture == Posture::prone;
  return made;
}

Geometry scaled(const Geometry& geometry, double by) {
  if (const auto* box = std::get_if<Box>(&geometry)) return Box{by * box->min_mm, by * box->max_mm};
  if (const auto* sphere = std::get_if<Sphere>(&geometry))
    return Sphere{by * sphere->center_mm, by * sphere->radius_mm};
  if (const auto* ellipsoid = std::get_if<Ellipsoid>(&geometry))
    return Ellipsoid{by * ellipsoid->center_mm, by * ellipsoid->radii_mm};
  const auto& cylinder = std::get<Cylinder>(geometry);
  return Cylinder{by * cylinder.from_mm, by * cylinder.to_mm, by * cylinder.radius_mm};
}

void add_torso(phantom::Shapes& shapes, const phantom::Physique& physique, Calyces calyces) {
  phantom::add_body_layers(shapes, physique.torso);
  phantom::add_trunk_muscles(shapes);
  phantom::add_lungs(shapes);
  phantom::add_liver(shapes);
  phantom::add_mediastinum(shapes);
  phantom::add_upper_abdomen(shapes);
  phantom::add_bowel(shapes, physique.prone);
  phantom::add_kidneys(shapes, calyces);
  phantom::add_great_vessels(shapes);
  phantom::add_spine(shapes);
  phantom::add_pelvis(shapes);
  phantom::add_ribs(shapes);
}

}  // namespace

AnalyticVolume phantom_shapes(const PhantomOptions& options) {
  const Scan scan = scan_of(options.region);
  const phantom::Physique physique = physique_of(options);
  AnalyticVolume analytic;
  analytic.spacing_mm = options.spacing_mm.value_or(physique.scale * scan.spacing_mm);
  // What is lean lies in as much air, what is obese in no less.
  const glm::dvec3 grown = options.region == Region::torso
                               ? glm::dvec3(physique.torso.lateral_mm, physique.torso.front_mm, 0.0)
                           : options.region == Region::groin ? glm::dvec3(physique.groin_mm, physique.groin_mm, 0.0)
                                                             : glm::dvec3(physique.neck_mm, physique.neck_mm, 0.0);
  const glm::dvec3 more_mm = glm::max(-grown, 0.0);
  analytic.origin_mm = physique.scale * (scan.first_voxel_mm - more_mm);
  const glm::dvec3 extent_mm = physique.scale * (scan.extent_mm + 2.0 * more_mm);
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(analytic.spacing_mm[axis] > 0.0);
    analytic.size_voxels[axis] = static_cast<int>(std::floor(extent_mm[axis] / analytic.spacing_mm[axis])) + 1;
  }
  switch (options.region) {
    case Region::torso:
      add_torso(analytic.shapes, physique, options.calyces);
      break;
    case Region::groin:
      phantom::add_groin(analytic.shapes, physique.groin_mm);
      break;
    case Region::neck:
      phantom::add_neck(analytic.shapes, physique.neck_mm);
      break;
  }
  if (physique.scale != 1.0)
    for (Shape& shape : analytic.shapes) shape.geometry = scaled(shape.geometry, physique.scale);
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
