#include "sim/case/paint.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "sim/base/check.h"

namespace seldinger::cases {
namespace {

constexpr double kFinestPaintMm = 0.5;  // a voxel is asked at points about so far apart, at most 8 along an axis
constexpr double kTouchMm = 1e-3;

struct Box {
  glm::ivec3 low, high;  // inclusive
};

// The voxels that a shape may touch.
Box voxels_around(const Shape& shape, double margin_mm, const volume::Volume& volume,
                  const glm::dmat4& voxel_from_lps) {
  const Bounds bounds = bounds_of(shape);
  Box box{glm::ivec3(0), glm::ivec3(-1)};
  if (bounds.low_lps_mm.x > bounds.high_lps_mm.x) return box;
  glm::dvec3 low(1e9), high(-1e9);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 share(corner & 1, (corner >> 1) & 1, corner >> 2);
    const glm::dvec3 p =
        bounds.low_lps_mm - margin_mm + share * (bounds.high_lps_mm - bounds.low_lps_mm + 2.0 * margin_mm);
    const glm::dvec3 index(voxel_from_lps * glm::dvec4(p, 1.0));
    low = glm::min(low, index);
    high = glm::max(high, index);
  }
  const glm::dvec3 last(volume.size_voxels - 1);
  box.low = glm::ivec3(glm::clamp(glm::floor(low), glm::dvec3(0.0), last));
  box.high = glm::ivec3(glm::clamp(glm::ceil(high), glm::dvec3(-1.0), last));
  return box;
}

// work(i, j, k, centre)
template <typename Work>
void over_box(const Box& box, const volume::Volume& volume, const Work& work) {
  for (int k = box.low.z; k <= box.high.z; ++k)
    for (int j = box.low.y; j <= box.high.y; ++j)
      for (int i = box.low.x; i <= box.high.x; ++i)
        work(i, j, k, glm::dvec3(volume.lps_from_voxel * glm::dvec4(i, j, k, 1.0)));
}

double ramp(double distance_mm, double edge_mm) {
  if (edge_mm == 0.0) return distance_mm <= 0.0 ? 1.0 : 0.0;
  return std::clamp(0.5 - distance_mm / edge_mm, 0.0, 1.0);
}

}  // namespace

Painted paint(const Shape& shape, const Brush& brush, volume::Volume& volume) {
  CHECK(brush.edge_mm >= 0.0);
  const glm::dmat4 voxel_from_lps = volume::voxel_from_lps(volume);
  glm::ivec3 points;
  for (int axis = 0; axis < 3; ++axis)
    points[axis] = std::clamp(static_cast<int>(std::ceil(volume.spacing_mm[axis] / kFinestPaintMm)), 1, 8);
  const double reach_mm = 0.5 * (glm::length(volume.spacing_mm) + brush.edge_mm) + kTouchMm;
  const double ramp_mm = 0.5 * brush.edge_mm + kTouchMm;
  const auto share_inside = [&](int i, int j, int k) {
    double sum = 0.0;
    for (int z = 0; z < points.z; ++z)
      for (int y = 0; y < points.y; ++y)
        for (int x = 0; x < points.x; ++x) {
          const glm::dvec3 index = glm::dvec3(i, j, k) - 0.5 + (glm::dvec3(x, y, z) + 0.5) / glm::dvec3(points);
          const glm::dvec3 p(volume.lps_from_voxel * glm::dvec4(index, 1.0));
          sum += ramp(signed_distance_mm(shape, p, ramp_mm), brush.edge_mm);
        }
    return sum / (points.x * points.y * points.z);
  };
  Painted painted;
  over_box(
      voxels_around(shape, reach_mm, volume, voxel_from_lps), volume,
      [&](int i, int j, int k, const glm::dvec3& center) {
        const double distance_mm = signed_distance_mm(shape, center, reach_mm);
        if (distance_mm >= reach_mm) return;
        const double share = distance_mm <= -reach_mm ? 1.0 : share_inside(i, j, k);
        std::int16_t& hu = volume.hu[volume.index(i, j, k)];
        const double before = hu;
        const double after = brush.adds ? before + share * brush.hu : before + share * (brush.hu - before);
        hu = static_cast<std::int16_t>(std::clamp(std::round(after), static_cast<double>(volume::kAirHu), 32767.0));
        if (distance_mm > 0.0) return;
        ++painted.voxels;
        painted.hu += hu;
        painted.before_hu += before;
      });
  if (painted.voxels > 0) {
    painted.hu /= static_cast<double>(painted.voxels);
    painted.before_hu /= static_cast<double>(painted.voxels);
  }
  return painted;
}

void paint_class(const Shape& shape, volume::TissueClass tissue, const volume::Volume& volume,
                 std::span<volume::TissueClass> classes) {
  CHECK(classes.size() == volume.hu.size());
  over_box(voxels_around(shape, kTouchMm, volume, volume::voxel_from_lps(volume)), volume,
           [&](int i, int j, int k, const glm::dvec3& center) {
             if (signed_distance_mm(shape, center, kTouchMm) <= 0.0) classes[volume.index(i, j, k)] = tissue;
           });
}

void over_voxels_in(const Shape& shape, const volume::Volume& volume, double deepest_mm,
                    const std::function<void(std::size_t voxel, double depth_mm)>& tell) {
  const double limit_mm = std::max(deepest_mm, kTouchMm);
  over_box(voxels_around(shape, kTouchMm, volume, volume::voxel_from_lps(volume)), volume,
           [&](int i, int j, int k, const glm::dvec3& center) {
             const double distance_mm = signed_distance_mm(shape, center, limit_mm);
             if (distance_mm <= 0.0) tell(static_cast<std::size_t>(volume.index(i, j, k)), -distance_mm);
           });
}

}  // namespace seldinger::cases
