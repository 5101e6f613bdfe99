#include "app/window/editor/editor_grip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace seldinger::app {
namespace {

constexpr double kLeastRadiusMm = 0.5;

// A ball or an ellipsoid, whose axes are LPS's as the planes' are.
struct Round {
  glm::dvec3 center{0.0}, radii{1.0};
};

glm::dvec3 normal_of(const PlaneKind& plane) {
  return glm::cross(plane.u, plane.v);
}
glm::dvec3 within_plane(const PlaneKind& plane, const glm::dvec3& way) {
  const glm::dvec3 normal = normal_of(plane);
  return way - normal * glm::dot(way, normal);
}

std::optional<Grip> grip_of(const Round& round, const PlaneKind& plane, const glm::dvec3& at, double reach_mm) {
  const glm::dvec3 way = at - round.center;
  const double across = glm::dot(way, normal_of(plane)) / glm::dot(glm::abs(normal_of(plane)), round.radii);
  if (std::abs(across) >= 1.0) return std::nullopt;  // not on the plane
  const glm::dvec3 aside = within_plane(plane, way);
  const double mm = glm::length(aside);
  // A small one is moved from within, and grows from outside.
  const double least =
      std::min(glm::dot(glm::abs(plane.u), round.radii), glm::dot(glm::abs(plane.v), round.radii)) *
      std::sqrt(1.0 - across * across);
  if (mm <= std::min(reach_mm, 0.5 * least)) return Grip{GripPart::middle, 0};
  // How far the rim is away on the ray from the middle.
  const glm::dvec3 scaled = aside / round.radii;
  const double rim_mm = mm * std::sqrt(1.0 - across * across) / glm::length(scaled);
  if (std::abs(mm - rim_mm) <= reach_mm) return Grip{GripPart::rim, 0};
  return std::nullopt;
}

// The rim through `to`.
double sphere_radius_mm(const Round& round, const glm::dvec3& to) {
  return std::max(kLeastRadiusMm, glm::distance(round.center, to));
}

void drag_ellipsoid_rim(const PlaneKind& plane, const glm::dvec3& to, Round& round) {
  const glm::dvec3 way = to - round.center;
  const glm::dvec3 aside = glm::abs(within_plane(plane, way)) / round.radii;
  const int axis = aside.x >= aside.y && aside.x >= aside.z ? 0 : aside.y >= aside.z ? 1 : 2;
  // The other axes stay: (way_axis / radius)² + the rest = 1.
  double rest = 0.0;
  for (int other = 0; other < 3; ++other)
    if (other != axis) rest += way[other] * way[other] / (round.radii[other] * round.radii[other]);
  round.radii[axis] = std::max(kLeastRadiusMm, std::abs(way[axis]) / std::sqrt(std::max(0.05, 1.0 - rest)));
}

glm::dvec3 moved(const PlaneKind& plane, const glm::dvec3& from, const glm::dvec3& to) {
  return from + within_plane(plane, to - from);
}

}  // namespace

std::optional<Grip> grip_of(const cases::LesionForm& form, const PlaneKind& plane, const glm::dvec3& at_lps_mm,
                            double reach_mm) {
  return grip_of(Round{form.center_lps_mm, form.radii_mm}, plane, at_lps_mm, reach_mm);
}

std::optional<Grip> grip_of(const cases::Shape& shape, const PlaneKind& plane, const glm::dvec3& at_lps_mm,
                            double reach_mm) {
  if (const auto* sphere = std::get_if<cases::Sphere>(&shape))
    return grip_of(Round{sphere->center_lps_mm, glm::dvec3(sphere->radius_mm)}, plane, at_lps_mm, reach_mm);
  if (const auto* ellipsoid = std::get_if<cases::Ellipsoid>(&shape))
    return grip_of(Round{ellipsoid->center_lps_mm, ellipsoid->radii_mm}, plane, at_lps_mm, reach_mm);
  const auto* tube = std::get_if<cases::Tube>(&shape);
  if (tube == nullptr) return std::nullopt;
  std::optional<Grip> nearest;
  double nearest_mm = reach_mm;
  for (std::size_t i = 0; i < tube->points_lps_mm.size(); ++i) {
    const glm::dvec3 way = at_lps_mm - tube->points_lps_mm[i];
    if (std::abs(glm::dot(way, normal_of(plane))) > tube->radius_mm + reach_mm) continue;
    const double mm = glm::length(within_plane(plane, way));
    if (mm > nearest_mm) continue;
    nearest_mm = mm;
    nearest = Grip{GripPart::point, i};
  }
  return nearest;
}

void drag(const Grip& grip, const PlaneKind& plane, const glm::dvec3& to_lps_mm, cases::LesionForm& form) {
  Round round{form.center_lps_mm, form.radii_mm};
  if (grip.part == GripPart::middle)
    form.center_lps_mm = moved(plane, form.center_lps_mm, to_lps_mm);
  else if (form.outline == cases::LesionOutline::ellipsoid) {
    drag_ellipsoid_rim(plane, to_lps_mm, round);
    form.radii_mm = round.radii;
  } else {
    form.radii_mm = glm::dvec3(sphere_radius_mm(round, to_lps_mm));
  }
}

void drag(const Grip& grip, const PlaneKind& plane, const glm::dvec3& to_lps_mm, cases::Shape& shape) {
  if (auto* sphere = std::get_if<cases::Sphere>(&shape)) {
    if (grip.part == GripPart::middle)
      sphere->center_lps_mm = moved(plane, sphere->center_lps_mm, to_lps_mm);
    else
      sphere->radius_mm = sphere_radius_mm({sphere->center_lps_mm, {}}, to_lps_mm);
  } else if (auto* ellipsoid = std::get_if<cases::Ellipsoid>(&shape)) {
    if (grip.part == GripPart::middle) {
      ellipsoid->center_lps_mm = moved(plane, ellipsoid->center_lps_mm, to_lps_mm);
    } else {
      Round round{ellipsoid->center_lps_mm, ellipsoid->radii_mm};
      drag_ellipsoid_rim(plane, to_lps_mm, round);
      ellipsoid->radii_mm = round.radii;
    }
  } else if (auto* tube = std::get_if<cases::Tube>(&shape)) {
    if (grip.point < tube->points_lps_mm.size())
      tube->points_lps_mm[grip.point] = moved(plane, tube->points_lps_mm[grip.point], to_lps_mm);
  }
}

}  // namespace seldinger::app
