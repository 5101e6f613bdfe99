#include "sim/case/form/shape.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "sim/base/check.h"

namespace seldinger::cases {
namespace {

double clamp_to(double distance_mm, double limit_mm) {
  return std::clamp(distance_mm, -limit_mm, limit_mm);
}

double distance_to(const Sphere& sphere, const glm::dvec3& point, double limit_mm) {
  return clamp_to(glm::distance(sphere.center_lps_mm, point) - sphere.radius_mm, limit_mm);
}

// D. Eberly, "Distance from a Point to an Ellipse, an Ellipsoid, or a Hyperellipsoid" (Geometric Tools): the
// nearest surface point x is r²y / (t + r²), with t the largest root of Σ (r y / (t + r²))² = 1, found by
// bisection.
double distance_to(const Ellipsoid& ellipsoid, const glm::dvec3& point, double limit_mm) {
  const glm::dvec3 r = ellipsoid.radii_mm;
  const glm::dvec3 y = glm::abs(point - ellipsoid.center_lps_mm);
  const double smallest = std::min({r.x, r.y, r.z}), largest = std::max({r.x, r.y, r.z});
  const auto excess = [&](double t) {
    double sum = -1.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double term = r[axis] * y[axis] / (t + r[axis] * r[axis]);
      sum += term * term;
    }
    return sum;
  };
  const bool inside = excess(0.0) < 0.0;
  double low = -smallest * smallest, high = largest * glm::length(y);
  for (int i = 0; i < 200 && high > low; ++i) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (excess(middle) > 0.0 ? low : high) = middle;
  }
  glm::dvec3 nearest;
  for (int axis = 0; axis < 3; ++axis) {
    const double below = high + r[axis] * r[axis];
    nearest[axis] = below > 0.0 ? r[axis] * r[axis] * y[axis] / below : 0.0;
  }
  // On the plane of symmetry of a short axis the root is the pole itself: what is missing to the surface is in it.
  const double missing = -[&] {
    const glm::dvec3 share = nearest / r;
    return glm::dot(share, share) - 1.0;
  }();
  if (missing > 0.0)
    for (int axis = 0; axis < 3; ++axis)
      if (r[axis] == smallest) {
        const double had = nearest[axis] / r[axis];
        nearest[axis] = r[axis] * std::sqrt(had * had + missing);
        break;
      }
  const double distance = glm::distance(nearest, y);
  return clamp_to(inside ? -distance : distance, limit_mm);
}

double distance_to(const Tube& tube, const glm::dvec3& point, double limit_mm) {
  double nearest = std::numeric_limits<double>::infinity();
  const std::size_t points = tube.points_lps_mm.size();
  for (std::size_t i = 0; i < points; ++i) {
    const glm::dvec3 a = tube.points_lps_mm[i], way = tube.points_lps_mm[std::min(i + 1, points - 1)] - a;
    const double squared = glm::dot(way, way);
    const double at = squared > 0.0 ? std::clamp(glm::dot(point - a, way) / squared, 0.0, 1.0) : 0.0;
    nearest = std::min(nearest, glm::distance(point, a + at * way));
  }
  return clamp_to(nearest - tube.radius_mm, limit_mm);
}

bool has(const VoxelSet& set, const glm::ivec3& voxel) {
  const glm::ivec3 at = voxel - set.low;
  for (int axis = 0; axis < 3; ++axis)
    if (at[axis] < 0 || at[axis] >= set.size[axis]) return false;
  return set.member[(static_cast<std::size_t>(at.z) * static_cast<std::size_t>(set.size.y) +
                     static_cast<std::size_t>(at.y)) *
                        static_cast<std::size_t>(set.size.x) +
                    static_cast<std::size_t>(at.x)] != 0;
}

glm::dvec3 index_of(const VoxelSet& set, const glm::dvec3& point) {
  return glm::dvec3(set.voxel_from_lps * glm::dvec4(point, 1.0));
}

glm::ivec3 voxel_of(const glm::dvec3& index) {
  return glm::ivec3(glm::floor(index + 0.5));
}

// Distance along one axis from an index to the nearest face of a voxel; 0 within.
double beyond_mm(double index, int voxel, double spacing_mm) {
  return std::max(0.0, std::abs(index - voxel) - 0.5) * spacing_mm;
}

double distance_to(const VoxelSet& set, const glm::dvec3& point, double limit_mm) {
  if (set.member.empty()) return limit_mm;
  const glm::dvec3 index = index_of(set, point);
  for (int axis = 0; axis < 3; ++axis)  // also keeps what is far away out of the range of an int
    if (!(std::abs(index[axis]) * set.spacing_mm[axis] < 1e7)) return limit_mm;
  const bool inside = has(set, voxel_of(index));
  double best = limit_mm;
  const glm::dvec3 reach = limit_mm / set.spacing_mm + 0.5;
  glm::ivec3 low = glm::ivec3(glm::floor(index - reach)), high = glm::ivec3(glm::ceil(index + reach));
  if (!inside) {  // members lie in the box only
    low = glm::max(low, set.low);
    high = glm::min(high, set.low + set.size - 1);
  } else {  // one voxel around the box is enough of what is not a member
    low = glm::max(low, set.low - 1);
    high = glm::min(high, set.low + set.size);
  }
  for (int k = low.z; k <= high.z; ++k) {
    const double dz = beyond_mm(index.z, k, set.spacing_mm.z);
    if (dz >= best) continue;
    for (int j = low.y; j <= high.y; ++j) {
      const double dy = beyond_mm(index.y, j, set.spacing_mm.y), dyz = std::sqrt(dy * dy + dz * dz);
      if (dyz >= best) continue;
      for (int i = low.x; i <= high.x; ++i) {
        const double dx = beyond_mm(index.x, i, set.spacing_mm.x), distance = std::sqrt(dx * dx + dyz * dyz);
        if (distance < best && has(set, {i, j, k}) != inside) best = distance;
      }
    }
  }
  return inside ? -best : best;
}

// The part of a → b within an ellipsoid with radii r about the origin; empty when from ≥ to.
Stretch within_ellipsoid(glm::dvec3 a, glm::dvec3 b, const glm::dvec3& r) {
  a /= r;
  b /= r;
  const glm::dvec3 way = b - a;
  const double A = glm::dot(way, way), B = glm::dot(a, way), C = glm::dot(a, a) - 1.0;
  if (A == 0.0) return C <= 0.0 ? Stretch{0.0, 1.0} : Stretch{};
  const double under = B * B - A * C;
  if (under <= 0.0) return {};
  const double root = std::sqrt(under);
  return {std::max(0.0, (-B - root) / A), std::min(1.0, (-B + root) / A)};
}

// The part of a → b within `radius` of the segment p → q. A capsule is convex, so this is one stretch: that of the
// cylinder between its ends, joined to those of the balls at them.
Stretch within_capsule(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& p, const glm::dvec3& q,
                       double radius_mm) {
  Stretch all{1.0, 0.0};
  const auto join = [&](const Stretch& one) {
    if (one.from >= one.to) return;
    all.from = std::min(all.from, one.from);
    all.to = std::max(all.to, one.to);
  };
  join(within_ellipsoid(a - p, b - p, glm::dvec3(radius_mm)));
  join(within_ellipsoid(a - q, b - q, glm::dvec3(radius_mm)));
  const double length = glm::distance(p, q);
  if (length > 0.0) {
    const glm::dvec3 axis = (q - p) / length;
    const auto across = [&](const glm::dvec3& v) { return v - glm::dot(v, axis) * axis; };
    Stretch round = within_ellipsoid(across(a - p), across(b - p), glm::dvec3(radius_mm));
    const double at_a = glm::dot(a - p, axis), at_b = glm::dot(b - p, axis);
    if (at_a == at_b) {
      if (at_a < 0.0 || at_a > length) round = {};
    } else {
      const double one = -at_a / (at_b - at_a), other = (length - at_a) / (at_b - at_a);
      round = {std::max(round.from, std::min(one, other)), std::min(round.to, std::max(one, other))};
    }
    join(round);
  }
  return all;
}

void merge(std::vector<Stretch>& stretches) {
  std::sort(stretches.begin(), stretches.end(),
            [](const Stretch& one, const Stretch& other) { return one.from < other.from; });
  std::size_t kept = 0;
  for (const Stretch& stretch : stretches) {
    if (stretch.from >= stretch.to) continue;
    if (kept > 0 && stretch.from <= stretches[kept - 1].to)
      stretches[kept - 1].to = std::max(stretches[kept - 1].to, stretch.to);
    else
      stretches[kept++] = stretch;
  }
  stretches.resize(kept);
}

std::vector<Stretch> inside_of(const Sphere& sphere, const glm::dvec3& a, const glm::dvec3& b) {
  return {within_ellipsoid(a - sphere.center_lps_mm, b - sphere.center_lps_mm, glm::dvec3(sphere.radius_mm))};
}

std::vector<Stretch> inside_of(const Ellipsoid& ellipsoid, const glm::dvec3& a, const glm::dvec3& b) {
  return {within_ellipsoid(a - ellipsoid.center_lps_mm, b - ellipsoid.center_lps_mm, ellipsoid.radii_mm)};
}

std::vector<Stretch> inside_of(const Tube& tube, const glm::dvec3& a, const glm::dvec3& b) {
  std::vector<Stretch> found;
  const std::size_t points = tube.points_lps_mm.size();
  for (std::size_t i = 0; i < points; ++i)
    found.push_back(within_capsule(a, b, tube.points_lps_mm[i], tube.points_lps_mm[std::min(i + 1, points - 1)],
                                   tube.radius_mm));
  return found;
}

// From face to face of the voxels on the way.
std::vector<Stretch> inside_of(const VoxelSet& set, const glm::dvec3& a, const glm::dvec3& b) {
  if (set.member.empty()) return {};
  const glm::dvec3 from = index_of(set, a), way = index_of(set, b) - from;
  double enter = 0.0, leave = 1.0;  // of the box
  for (int axis = 0; axis < 3; ++axis) {
    const double low = set.low[axis] - 0.5, high = low + set.size[axis];
    if (way[axis] == 0.0) {
      if (!(from[axis] >= low && from[axis] < high)) return {};
      continue;
    }
    const double one = (low - from[axis]) / way[axis], other = (high - from[axis]) / way[axis];
    enter = std::max(enter, std::min(one, other));
    leave = std::min(leave, std::max(one, other));
  }
  if (!(enter < leave)) return {};
  std::vector<double> faces{enter, leave};
  for (int axis = 0; axis < 3; ++axis) {
    if (way[axis] == 0.0) continue;
    const double one = from[axis] + enter * way[axis] + 0.5, other = from[axis] + leave * way[axis] + 0.5;
    for (double face = std::ceil(std::min(one, other)); face < std::max(one, other); ++face) {
      const double at = (face - 0.5 - from[axis]) / way[axis];
      if (at > enter && at < leave) faces.push_back(at);
    }
  }
  std::sort(faces.begin(), faces.end());
  std::vector<Stretch> found;
  for (std::size_t i = 0; i + 1 < faces.size(); ++i)
    if (has(set, voxel_of(from + 0.5 * (faces[i] + faces[i + 1]) * way))) found.push_back({faces[i], faces[i + 1]});
  return found;
}

Bounds box_of(const Sphere& sphere) {
  return {sphere.center_lps_mm - sphere.radius_mm, sphere.center_lps_mm + sphere.radius_mm};
}
Bounds box_of(const Ellipsoid& ellipsoid) {
  return {ellipsoid.center_lps_mm - ellipsoid.radii_mm, ellipsoid.center_lps_mm + ellipsoid.radii_mm};
}
Bounds box_around(std::span<const glm::dvec3> points, double margin_mm) {
  if (points.empty()) return {};
  Bounds box{points[0], points[0]};
  for (const glm::dvec3& point : points) {
    box.low_lps_mm = glm::min(box.low_lps_mm, point);
    box.high_lps_mm = glm::max(box.high_lps_mm, point);
  }
  return {box.low_lps_mm - margin_mm, box.high_lps_mm + margin_mm};
}
Bounds box_of(const Tube& tube) {
  return box_around(tube.points_lps_mm, tube.radius_mm);
}
Bounds box_of(const VoxelSet& set) {
  if (set.member.empty()) return {};
  const glm::dmat4 lps_from_voxel = glm::inverse(set.voxel_from_lps);
  std::vector<glm::dvec3> corners;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 share(corner & 1, (corner >> 1) & 1, corner >> 2);
    corners.emplace_back(lps_from_voxel *
                         glm::dvec4(glm::dvec3(set.low) - 0.5 + share * glm::dvec3(set.size), 1.0));
  }
  return box_around(corners, 0.0);
}

}  // namespace

VoxelSet voxels_with(const volume::Volume& volume, std::span<const std::uint8_t> values, std::uint8_t value) {
  CHECK(values.size() == volume.hu.size());
  const glm::ivec3 size = volume.size_voxels;
  glm::ivec3 low = size, high(-1);
  std::size_t at = 0;
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i, ++at)
        if (values[at] == value) {
          low = glm::min(low, glm::ivec3(i, j, k));
          high = glm::max(high, glm::ivec3(i, j, k));
        }
  VoxelSet set;
  set.spacing_mm = volume.spacing_mm;
  set.voxel_from_lps = volume::voxel_from_lps(volume);
  if (high.x < 0) return set;
  set.low = low;
  set.size = high - low + 1;
  set.member.reserve(static_cast<std::size_t>(set.size.x) * static_cast<std::size_t>(set.size.y) *
                     static_cast<std::size_t>(set.size.z));
  for (int k = low.z; k <= high.z; ++k)
    for (int j = low.y; j <= high.y; ++j)
      for (int i = low.x; i <= high.x; ++i) set.member.push_back(values[volume.index(i, j, k)] == value ? 1 : 0);
  return set;
}

double signed_distance_mm(const Shape& shape, const glm::dvec3& point_lps_mm, double limit_mm) {
  return std::visit([&](const auto& one) { return distance_to(one, point_lps_mm, limit_mm); }, shape);
}

std::vector<Stretch> stretches_inside(const Shape& shape, const glm::dvec3& a_lps_mm, const glm::dvec3& b_lps_mm) {
  if (a_lps_mm == b_lps_mm) {
    const bool inside = signed_distance_mm(shape, a_lps_mm, 1e-3) <= 0.0;
    return inside ? std::vector<Stretch>{{0.0, 1.0}} : std::vector<Stretch>{};
  }
  auto found = std::visit([&](const auto& one) { return inside_of(one, a_lps_mm, b_lps_mm); }, shape);
  merge(found);
  return found;
}

Bounds bounds_of(const Shape& shape) {
  return std::visit([](const auto& one) { return box_of(one); }, shape);
}

}  // namespace seldinger::cases
