#include "sim/volume/analytic.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/base/check.h"

namespace seldinger::volume {
namespace {

struct Bounds {
  glm::dvec3 min_mm, max_mm;
};

Bounds bounds_of(const Geometry& geometry) {
  if (const auto* box = std::get_if<Box>(&geometry)) return {box->min_mm, box->max_mm};
  if (const auto* sphere = std::get_if<Sphere>(&geometry))
    return {sphere->center_mm - sphere->radius_mm, sphere->center_mm + sphere->radius_mm};
  if (const auto* ellipsoid = std::get_if<Ellipsoid>(&geometry))
    return {ellipsoid->center_mm - ellipsoid->radii_mm, ellipsoid->center_mm + ellipsoid->radii_mm};
  const auto& cylinder = std::get<Cylinder>(geometry);
  return {glm::min(cylinder.from_mm, cylinder.to_mm) - cylinder.radius_mm,
          glm::max(cylinder.from_mm, cylinder.to_mm) + cylinder.radius_mm};
}

struct Row {
  double from_mm, to_mm;
};

// Along x at (y, z): holds all of the shape, up to rounding. Empty (from > to) where the row misses it.
Row row_bounds(const Geometry& geometry, const Bounds& bounds, double y_mm, double z_mm) {
  const glm::dvec3 center_mm = 0.5 * (bounds.min_mm + bounds.max_mm),
                   radii_mm = 0.5 * (bounds.max_mm - bounds.min_mm);
  if (!std::holds_alternative<Sphere>(geometry) && !std::holds_alternative<Ellipsoid>(geometry))
    return {bounds.min_mm.x, bounds.max_mm.x};
  const double y = (y_mm - center_mm.y) / radii_mm.y, z = (z_mm - center_mm.z) / radii_mm.z;
  const double rest = 1.0 - y * y - z * z;
  if (rest < -1e-9) return {1.0, -1.0};
  const double half_mm = radii_mm.x * std::sqrt(std::max(rest, 0.0));
  return {center_mm.x - half_mm, center_mm.x + half_mm};
}

// The labels that a shape may overwrite.
std::array<bool, 256> overwritable(const std::vector<std::string>& over, const LabelMap& labels) {
  std::array<bool, 256> may{};
  may.fill(over.empty());
  for (const std::string& name : over) {
    const auto found = std::find(labels.names.begin(), labels.names.end(), name);
    if (found != labels.names.end()) may[static_cast<std::size_t>(found - labels.names.begin())] = true;
  }
  return may;
}

std::uint8_t label_of(const std::string& name, LabelMap& labels) {
  if (name.empty()) return 0;
  const auto found = std::find(labels.names.begin(), labels.names.end(), name);
  if (found != labels.names.end()) return static_cast<std::uint8_t>(found - labels.names.begin());
  CHECK(labels.names.size() < 255);
  labels.names.push_back(name);
  return static_cast<std::uint8_t>(labels.names.size() - 1);
}

}  // namespace

bool contains(const Geometry& geometry, const glm::dvec3& p) noexcept {
  if (const auto* box = std::get_if<Box>(&geometry)) {
    for (int axis = 0; axis < 3; ++axis)
      if (!(p[axis] >= box->min_mm[axis] && p[axis] <= box->max_mm[axis])) return false;
    return true;
  }
  if (const auto* sphere = std::get_if<Sphere>(&geometry)) {
    const glm::dvec3 d = p - sphere->center_mm;
    return glm::dot(d, d) <= sphere->radius_mm * sphere->radius_mm;
  }
  if (const auto* ellipsoid = std::get_if<Ellipsoid>(&geometry)) {
    const glm::dvec3 d = (p - ellipsoid->center_mm) / ellipsoid->radii_mm;
    return glm::dot(d, d) <= 1.0;
  }
  const auto& cylinder = std::get<Cylinder>(geometry);
  const glm::dvec3 axis = cylinder.to_mm - cylinder.from_mm;
  const glm::dvec3 d = p - cylinder.from_mm;
  const double length2 = glm::dot(axis, axis);
  if (!(length2 > 0.0)) return false;  // without a length there is no axis
  const double along = glm::dot(d, axis);
  if (!(along >= 0.0 && along <= length2)) return false;
  return glm::dot(d, d) * length2 - along * along <= cylinder.radius_mm * cylinder.radius_mm * length2;
}

Volume rasterize(const AnalyticVolume& analytic) {
  LabelMap ignored;
  return rasterize(analytic, ignored);
}

Volume rasterize(const AnalyticVolume& analytic, LabelMap& labels) {
  Volume volume = make_volume(analytic.size_voxels, analytic.spacing_mm, glm::dmat3(1.0), analytic.origin_mm);
  const auto to_hu = [](double hu) {
    return static_cast<std::int16_t>(std::clamp(std::round(hu), static_cast<double>(kAirHu), 32767.0));
  };
  std::fill(volume.hu.begin(), volume.hu.end(), to_hu(analytic.background_hu));
  labels.label.assign(volume.hu.size(), 0);
  labels.names.assign(1, "none");
  for (const Shape& shape : analytic.shapes) {
    const std::array<bool, 256> may_overwrite = overwritable(shape.over, labels);
    const std::uint8_t label = label_of(shape.class_name, labels);
    const std::int16_t hu = to_hu(shape.hu);
    const Bounds bounds = bounds_of(shape.geometry);
    glm::ivec3 low, high;
    for (int axis = 0; axis < 3; ++axis) {
      const double first = (bounds.min_mm[axis] - analytic.origin_mm[axis]) / analytic.spacing_mm[axis];
      const double last = (bounds.max_mm[axis] - analytic.origin_mm[axis]) / analytic.spacing_mm[axis];
      const double n = analytic.size_voxels[axis];
      low[axis] = static_cast<int>(std::clamp(std::floor(first), 0.0, n));
      high[axis] = static_cast<int>(std::clamp(std::ceil(last), -1.0, n - 1.0));
    }
    for (int k = low.z; k <= high.z; ++k)
      for (int j = low.y; j <= high.y; ++j) {
        const auto point = [&](int i) { return analytic.origin_mm + glm::dvec3(i, j, k) * analytic.spacing_mm; };
        const Row row = row_bounds(shape.geometry, bounds, point(0).y, point(0).z);
        const auto index = [&](double x_mm) {
          return std::clamp((x_mm - analytic.origin_mm.x) / analytic.spacing_mm.x, -2.0, high.x + 2.0);
        };
        // Every shape is convex: between the first and the last voxel inside it, all are.
        int first = std::max(low.x, static_cast<int>(std::floor(index(row.from_mm))) - 1);
        int last = std::min(high.x, static_cast<int>(std::ceil(index(row.to_mm))) + 1);
        while (first <= last && !contains(shape.geometry, point(first))) ++first;
        while (first <= last && !contains(shape.geometry, point(last))) --last;
        for (int i = first; i <= last; ++i) {
          const std::size_t at = volume.index(i, j, k);
          if (!may_overwrite[labels.label[at]]) continue;
          volume.hu[at] = hu;
          labels.label[at] = label;
        }
      }
  }
  return volume;
}

}  // namespace seldinger::volume
