// Tissue and views of the ultrasound tests. The probe's face is centred on the origin, y goes into the body.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <vector>

#include "sim/imaging/ultrasound/line.h"
#include "sim/imaging/ultrasound/ultrasound.h"

namespace seldinger::imaging {

using volume::TissueClass;

struct Scene {
  volume::Volume volume;
  std::vector<TissueClass> classes;
  TissueVolume tissue() const { return {&volume, classes}; }
};

// From 30 mm above the face to below the depth; `class_at` is asked at voxel centres.
inline Scene scene(const std::function<TissueClass(const glm::dvec3&)>& class_at, glm::ivec3 size = {150, 120, 30},
                   double voxel_mm = 2.0) {
  Scene s;
  s.volume =
      volume::make_volume(size, glm::dvec3(voxel_mm), glm::dmat3(1.0),
                          {-0.5 * (size.x - 1) * voxel_mm, -30.0 + 0.5 * voxel_mm, -0.5 * (size.z - 1) * voxel_mm});
  s.classes.resize(s.volume.hu.size());
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i)
        s.classes[s.volume.index(i, j, k)] = class_at(glm::dvec3(s.volume.lps_from_voxel * glm::dvec4(i, j, k, 1)));
  return s;
}
inline Scene all_of(TissueClass tissue) {
  return scene([=](const glm::dvec3&) { return tissue; });
}

inline UltrasoundView curved_view(double depth_mm = 150.0) {
  UltrasoundView view;
  view.depth_mm = depth_mm;
  return view;
}
inline UltrasoundView straight_view(double depth_mm = 50.0) {
  UltrasoundView view;
  view.probe = kL115v;
  view.depth_mm = depth_mm;
  return view;
}

inline PolarPicture polar_of(const Scene& s, const UltrasoundView& view, const Inserted& inserted = {},
                             std::span<const float> depth_below_skin_mm = {}) {
  PolarPicture picture;
  ultrasound_polar(s.tissue(), view, inserted, depth_below_skin_mm, picture);
  return picture;
}

inline float at(const PolarPicture& picture, int beam, int sample) {
  return picture.envelope[static_cast<std::size_t>(beam) * static_cast<std::size_t>(picture.samples) +
                          static_cast<std::size_t>(sample)];
}

inline Line line_of(const Scene& s, const UltrasoundView& view, int beam, const Inserted& inserted = {}) {
  const TissueAt tissue_at(s.tissue(), inserted);
  const LineWalker walker(view, tissue_at, s.volume, inserted);
  Line line;
  walker.walk(beam, true, line);
  return line;
}

inline double decibels(double amplitude) {
  return 20.0 * std::log10(amplitude);
}

inline int sample_at(const UltrasoundView& view, double depth_mm) {
  return static_cast<int>(depth_mm / view.depth_mm * view.samples);
}

// Mean square of the envelope, in dB.
inline double level_db(const PolarPicture& picture, int first_beam, int end_beam, int first_sample,
                       int end_sample) {
  double sum = 0.0;
  for (int b = first_beam; b < end_beam; ++b)
    for (int k = first_sample; k < end_sample; ++k) sum += double{at(picture, b, k)} * at(picture, b, k);
  return 10.0 * std::log10(sum / ((end_beam - first_beam) * (end_sample - first_sample)));
}

// Correlation of two equally long rows of numbers.
inline double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  double sum_a = 0, sum_b = 0, aa = 0, bb = 0, ab = 0;
  const double n = static_cast<double>(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum_a += a[i], sum_b += b[i];
    aa += a[i] * a[i], bb += b[i] * b[i], ab += a[i] * b[i];
  }
  return (ab - sum_a * sum_b / n) / std::sqrt((aa - sum_a * sum_a / n) * (bb - sum_b * sum_b / n));
}

}  // namespace seldinger::imaging
