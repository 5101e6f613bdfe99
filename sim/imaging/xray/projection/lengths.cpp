// The oracle of X-ray projection: plain double, one ray at a time, shaped for reading and not for speed. It shares
// nothing with the fast projectors but the formulas of a voxel's share.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "shaders/shared/xray.glsl.h"
#include "sim/base/check.h"
#include "sim/imaging/xray/projection/projection.h"

namespace seldinger::imaging {
namespace {

// A ray in voxel indices (centres at integers) from t = 0 to 1, and the part of it inside the volume's faces.
struct IndexRay {
  glm::dvec3 from, along;
  double length_mm;
  double enter = 0.0, leave = 1.0;
};

IndexRay index_ray(const volume::Volume& volume, const glm::dvec3& from_lps_mm, const glm::dvec3& to_lps_mm) {
  const glm::dmat4 voxel_from_lps = volume::voxel_from_lps(volume);
  IndexRay ray{glm::dvec3(voxel_from_lps * glm::dvec4(from_lps_mm, 1.0)),
               glm::dmat3(voxel_from_lps) * (to_lps_mm - from_lps_mm), glm::length(to_lps_mm - from_lps_mm)};
  for (int axis = 0; axis < 3; ++axis) {
    const double low = -0.5, high = volume.size_voxels[axis] - 0.5;
    const double from = ray.from[axis], along = ray.along[axis];
    if (along == 0.0) {
      if (!(from >= low && from < high)) ray.leave = -1.0;  // the lower face belongs to the volume, the upper not
      continue;
    }
    const double one = (low - from) / along, other = (high - from) / along;
    ray.enter = std::max(ray.enter, std::min(one, other));
    ray.leave = std::min(ray.leave, std::max(one, other));
  }
  return ray;
}

// t where the ray crosses the planes first, first + 1, … of each axis, and both ends, in order.
std::vector<double> cuts(const IndexRay& ray, const glm::ivec3& size_voxels, double first) {
  std::vector<double> t = {ray.enter, ray.leave};
  for (int axis = 0; axis < 3; ++axis) {
    const double from = ray.from[axis], along = ray.along[axis];
    if (along == 0.0) continue;
    // Planes that the part inside can meet, one more on each side for rounding.
    const double one = from + ray.enter * along - first, other = from + ray.leave * along - first;
    const auto lowest = std::max(0, static_cast<int>(std::floor(std::min(one, other))));
    const auto highest = std::min(size_voxels[axis] - 1, static_cast<int>(std::ceil(std::max(one, other))));
    for (int plane = lowest; plane <= highest; ++plane) {
      const double at = (first + plane - from) / along;
      if (at > ray.enter && at < ray.leave) t.push_back(at);
    }
  }
  std::sort(t.begin(), t.end());
  return t;
}

// Sum without loss (Neumaier, ZAMM 54 (1974) 39).
class Sum {
 public:
  void add(double value) noexcept {
    const double next = sum_ + value;
    lost_ += std::abs(sum_) >= std::abs(value) ? (sum_ - next) + value : (value - next) + sum_;
    sum_ = next;
  }
  double value() const noexcept { return sum_ + lost_; }

 private:
  double sum_ = 0.0, lost_ = 0.0;
};

struct Share {
  double water = 0.0, mineral = 0.0;
};

Share share_at(const volume::Volume& volume, const glm::ivec3& voxel) {
  const double hu = volume.at(voxel.x, voxel.y, voxel.z);
  return {shaders::xray_water(hu), shaders::xray_mineral(hu)};
}

// Interpolated over the axes that `axes` names; the others are at whole indices. Clamped to the outermost centres.
Share share_between(const volume::Volume& volume, const glm::dvec3& index, const std::array<bool, 3>& axes) {
  glm::ivec3 low;
  glm::dvec3 part;
  for (int axis = 0; axis < 3; ++axis) {
    const double clamped = std::clamp(index[axis], 0.0, volume.size_voxels[axis] - 1.0);
    low[axis] = std::min(static_cast<int>(clamped), std::max(0, volume.size_voxels[axis] - 2));
    part[axis] = axes[static_cast<std::size_t>(axis)] ? clamped - low[axis] : std::round(clamped - low[axis]);
  }
  Share sum;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::ivec3 step(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1);
    double weight = 1.0;
    for (int axis = 0; axis < 3; ++axis) weight *= step[axis] == 1 ? part[axis] : 1.0 - part[axis];
    if (weight == 0.0) continue;
    const Share share = share_at(volume, low + step);
    sum.water += weight * share.water;
    sum.mineral += weight * share.mineral;
  }
  return sum;
}

int main_axis(const glm::dvec3& along) {
  const glm::dvec3 size = glm::abs(along);
  return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

}  // namespace

RayLengths lengths_between(const volume::Volume& volume, const glm::dvec3& from_lps_mm, const glm::dvec3& to_lps_mm,
                           ProjectionMethod method) {
  const IndexRay ray = index_ray(volume, from_lps_mm, to_lps_mm);
  if (!(ray.leave > ray.enter) || !(ray.length_mm > 0.0)) return {};
  Sum water, mineral;
  const auto add = [&](const Share& share, double t_length) {
    water.add(share.water * t_length);
    mineral.add(share.mineral * t_length);
  };
  const auto at = [&](double t) { return ray.from + t * ray.along; };
  if (method == ProjectionMethod::slab) {
    const int axis = main_axis(ray.along);
    std::array<bool, 3> minor = {true, true, true};
    minor[static_cast<std::size_t>(axis)] = false;
    IndexRay along_main = ray;
    for (int other = 0; other < 3; ++other)
      if (other != axis) along_main.along[other] = 0.0;
    const std::vector<double> t = cuts(along_main, volume.size_voxels, -0.5);
    for (std::size_t i = 0; i + 1 < t.size(); ++i)
      add(share_between(volume, at(0.5 * (t[i] + t[i + 1])), minor), t[i + 1] - t[i]);
  } else if (method == ProjectionMethod::trilinear) {
    // Between planes of voxel centres the field is a cubic in t: two Gauss points are exact.
    const double gauss = 0.5 / std::sqrt(3.0);
    const std::vector<double> t = cuts(ray, volume.size_voxels, 0.0);
    for (std::size_t i = 0; i + 1 < t.size(); ++i) {
      const double middle = 0.5 * (t[i] + t[i + 1]), length = t[i + 1] - t[i];
      for (const double side : {-gauss, gauss})
        add(share_between(volume, at(middle + side * length), {true, true, true}), 0.5 * length);
    }
  } else {
    const std::vector<double> t = cuts(ray, volume.size_voxels, -0.5);
    for (std::size_t i = 0; i + 1 < t.size(); ++i) {
      const glm::dvec3 middle = at(0.5 * (t[i] + t[i + 1])) + 0.5;
      add(share_at(volume, glm::clamp(glm::ivec3(glm::floor(middle)), glm::ivec3(0), volume.size_voxels - 1)),
          t[i + 1] - t[i]);
    }
  }
  return {water.value() * ray.length_mm, mineral.value() * ray.length_mm};
}

PathLengths xray_reference(const volume::Volume& volume, const XrayGeometry& geometry, ProjectionMethod method) {
  CHECK(check_geometry(geometry).has_value());
  PathLengths lengths{geometry.width_px, geometry.height_px, {}, {}, {}};
  for (int row = 0; row < geometry.height_px; ++row)
    for (int column = 0; column < geometry.width_px; ++column) {
      const RaySegment ray = ray_of(geometry, volume, column, row);
      const RayLengths of_ray = lengths_between(volume, ray.from_lps_mm, ray.to_lps_mm, method);
      lengths.water_mm.push_back(static_cast<float>(of_ray.water_mm));
      lengths.mineral_mm.push_back(static_cast<float>(of_ray.mineral_mm));
    }
  return lengths;
}

}  // namespace seldinger::imaging
