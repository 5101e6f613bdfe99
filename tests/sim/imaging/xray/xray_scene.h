// Volumes, geometries and comparisons of the X-ray tests.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "sim/base/rng.h"
#include "sim/imaging/xray/projection/projection.h"
#include "sim/volume/volume.h"

namespace seldinger::imaging {

constexpr double kWaterPerMm = 0.018366;  // at 80 keV: nepers per mm of water, to speak of errors in nepers

// Centred on the origin, axes along LPS.
inline volume::Volume centered(glm::ivec3 size, glm::dvec3 spacing_mm, int hu) {
  volume::Volume volume =
      volume::make_volume(size, spacing_mm, glm::dmat3(1.0), -0.5 * glm::dvec3(size - 1) * spacing_mm);
  std::fill(volume.hu.begin(), volume.hu.end(), static_cast<std::int16_t>(hu));
  return volume;
}

// HU uniform in [low, high]: the worst case for an integrator.
inline volume::Volume noisy(glm::ivec3 size, glm::dvec3 spacing_mm, int low = -700, int high = 3000) {
  volume::Volume volume = centered(size, spacing_mm, 0);
  for (std::size_t i = 0; i < volume.hu.size(); ++i)
    volume.hu[i] = static_cast<std::int16_t>(low + base::uniform_at(7, i) * (high - low));
  return volume;
}

// A source and a detector face to face along `axis`, SAD 1000 and SID 1500 mm from the origin.
inline XrayGeometry facing(const glm::dvec3& axis, double side_mm, int size_px) {
  XrayGeometry g;
  const glm::dvec3 d = glm::normalize(axis);
  g.source_lps_mm = -1000.0 * d;
  g.detector_center_lps_mm = 500.0 * d;
  g.u = glm::normalize(glm::cross(d, std::abs(d.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0)));
  g.v = glm::cross(d, g.u);
  g.width_px = g.height_px = size_px;
  g.pixel_mm = side_mm / size_px;
  return g;
}

inline XrayGeometry parallel(const glm::dvec3& axis, double side_mm, int size_px) {
  XrayGeometry g = facing(axis, side_mm, size_px);
  g.direction = glm::normalize(axis);
  g.source_lps_mm.reset();
  return g;
}

// One ray as a picture of one pixel, so that the fast projectors can be asked for it.
inline XrayGeometry one_ray(const glm::dvec3& from, const glm::dvec3& to) {
  XrayGeometry g;
  const glm::dvec3 d = glm::normalize(to - from);
  g.source_lps_mm = from;
  g.detector_center_lps_mm = to;
  g.u = glm::normalize(glm::cross(d, std::abs(d.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0)));
  g.v = glm::cross(d, g.u);
  g.width_px = g.height_px = 1;
  return g;
}

inline std::vector<Instructions> all_instructions() {
  std::vector<Instructions> all = {Instructions::scalar};
  if (best_instructions() >= Instructions::avx2) all.push_back(Instructions::avx2);
  if (best_instructions() >= Instructions::avx512) all.push_back(Instructions::avx512);
  return all;
}

inline double total_mm(const PathLengths& lengths, std::size_t i) {
  return static_cast<double>(lengths.water_mm[i]) +
         (lengths.mineral_mm.empty() ? 0.0 : static_cast<double>(lengths.mineral_mm[i]));
}

struct Errors {
  double median_relative = 0.0, max_relative = 0.0;  // where p > 0.05
  double max_nepers = 0.0;
  std::size_t compared = 0;
};

// NaN anywhere makes every error infinite.
inline Errors errors_of(const PathLengths& result, const PathLengths& reference) {
  Errors errors;
  std::vector<double> relative;
  const double infinite = std::numeric_limits<double>::infinity();
  if (result.water_mm.size() != reference.water_mm.size()) return {infinite, infinite, infinite, 0};
  for (std::size_t i = 0; i < result.water_mm.size(); ++i) {
    const double p = kWaterPerMm * total_mm(reference, i);
    const double difference = std::abs(kWaterPerMm * total_mm(result, i) - p);
    if (!(difference >= 0.0)) return {infinite, infinite, infinite, 0};
    errors.max_nepers = std::max(errors.max_nepers, difference);
    if (p > 0.05) relative.push_back(difference / p);
  }
  errors.compared = relative.size();
  if (relative.empty()) return errors;
  std::sort(relative.begin(), relative.end());
  errors.median_relative = relative[relative.size() / 2];
  errors.max_relative = relative.back();
  return errors;
}

// A box's chord in closed form: the part of from → to inside low … high.
inline double box_chord_mm(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec3& from,
                           const glm::dvec3& to) {
  double enter = 0.0, leave = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double d = to[axis] - from[axis];
    if (d == 0.0) {
      if (from[axis] < low[axis] || from[axis] >= high[axis]) return 0.0;
      continue;
    }
    enter = std::max(enter, std::min((low[axis] - from[axis]) / d, (high[axis] - from[axis]) / d));
    leave = std::min(leave, std::max((low[axis] - from[axis]) / d, (high[axis] - from[axis]) / d));
  }
  return std::max(0.0, leave - enter) * glm::length(to - from);
}

}  // namespace seldinger::imaging
