#include "sim/haptics/proxy/iso_surface.h"

#include <algorithm>
#include <cmath>

namespace seldinger::haptics {
namespace {

constexpr int kTaps = 6;
constexpr double kAside = 0.2;  // of a voxel's neighbour, against noise (design)

// Weights of six neighbours, and their slopes, at `part` of the way from the third to the fourth: the uniform cubic
// B-spline of values that were smoothed by (a, 1 − 2a, a).
struct Weights {
  explicit Weights(double part) {
    const double rest = 1.0 - part, part2 = part * part, rest2 = rest * rest;
    const double spline[4] = {rest2 * rest / 6.0, 2.0 / 3.0 - 0.5 * part2 * (2.0 - part),
                              2.0 / 3.0 - 0.5 * rest2 * (2.0 - rest), part2 * part / 6.0};
    const double rise[4] = {-0.5 * rest2, part * (1.5 * part - 2.0), rest * (2.0 - 1.5 * rest), 0.5 * part2};
    for (int i = 0; i < kTaps; ++i) value[i] = slope[i] = 0.0;
    constexpr double kSmooth[3] = {kAside, 1.0 - 2.0 * kAside, kAside};
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 3; ++j) {
        value[i + j] += kSmooth[j] * spline[i];
        slope[i + j] += kSmooth[j] * rise[i];
      }
  }
  double value[kTaps], slope[kTaps];
};

}  // namespace

IsoSurface::IsoSurface(const volume::Volume& volume, double iso_hu)
    : volume_(&volume),
      iso_hu_(iso_hu),
      step_mm_(0.25 * std::min({volume.spacing_mm.x, volume.spacing_mm.y, volume.spacing_mm.z})),
      voxel_from_lps_(volume::voxel_from_lps(volume)),
      lps_rise_(glm::transpose(glm::dmat3(voxel_from_lps_))) {}

IsoSurface::Value IsoSurface::at(const glm::dvec3& p_lps_mm) const noexcept {
  const glm::dvec3 index(voxel_from_lps_ * glm::dvec4(p_lps_mm, 1.0));
  const glm::ivec3 size = volume_->size_voxels;
  constexpr double kAir = volume::kAirHu;
  for (int axis = 0; axis < 3; ++axis)
    if (!(index[axis] > -3.0 && index[axis] < size[axis] + 2.0)) return {kAir - iso_hu_, glm::dvec3(0.0)};
  const glm::dvec3 low(std::floor(index.x), std::floor(index.y), std::floor(index.z));
  const Weights wx(index.x - low.x), wy(index.y - low.y), wz(index.z - low.z);
  const glm::ivec3 first = glm::ivec3(low) - 2;
  const bool whole = first.x >= 0 && first.y >= 0 && first.z >= 0 && first.x + kTaps <= size.x &&
                     first.y + kTaps <= size.y && first.z + kTaps <= size.z;
  double hu = 0.0;
  glm::dvec3 rise(0.0);
  for (int k = 0; k < kTaps; ++k) {
    double plane = 0.0, plane_x = 0.0, plane_y = 0.0;
    for (int j = 0; j < kTaps; ++j) {
      double value = 0.0, rise_x = 0.0;
      for (int i = 0; i < kTaps; ++i) {
        const glm::ivec3 at(first.x + i, first.y + j, first.z + k);
        const bool inside =
            whole || (at.x >= 0 && at.y >= 0 && at.z >= 0 && at.x < size.x && at.y < size.y && at.z < size.z);
        const double voxel = inside ? volume_->at(at.x, at.y, at.z) : kAir;
        value += wx.value[i] * voxel;
        rise_x += wx.slope[i] * voxel;
      }
      plane += wy.value[j] * value;
      plane_x += wy.value[j] * rise_x;
      plane_y += wy.slope[j] * value;
    }
    hu += wz.value[k] * plane;
    rise += glm::dvec3(wz.value[k] * plane_x, wz.value[k] * plane_y, wz.slope[k] * plane);
  }
  return {hu - iso_hu_, lps_rise_ * rise};
}

}  // namespace seldinger::haptics
