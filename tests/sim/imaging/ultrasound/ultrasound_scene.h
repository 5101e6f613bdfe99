// Tissue and views of the ultrasound tests. The probe's face is centred on the origin, y goes into the body.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <vector>

#include "app/measure/ultrasound_goals/goal.h"
#include "app/measure/ultrasound_goals/polar_levels.h"
#include "sim/imaging/ultrasound/line.h"
#include "sim/imaging/ultrasound/view/ultrasound.h"

namespace seldinger::imaging {

using volume::TissueClass;

using measure::at;
using measure::correlation;
using measure::decibels;
using measure::level_db;
using measure::sample_at;
using Scene = measure::TissueBlock;

inline Scene scene(const std::function<TissueClass(const glm::dvec3&)>& class_at, glm::ivec3 size = {150, 120, 30},
                   double voxel_mm = 2.0) {
  return measure::tissue_block(class_at, size, voxel_mm);
}
inline Scene all_of(TissueClass tissue) {
  return measure::block_of(tissue);
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

inline Line line_of(const Scene& s, const UltrasoundView& view, int beam, const Inserted& inserted = {}) {
  const TissueAt tissue_at(s.tissue(), inserted);
  const LineWalker walker(view, tissue_at, s.volume, inserted);
  Line line;
  walker.walk(beam, true, line);
  return line;
}

// What a goal's function tells; `holds` asserts of one reading.
inline measure::Readings readings_of(const measure::Setting& setting,
                                     void (*measure)(const measure::Setting&, measure::Readings&)) {
  measure::Readings readings;
  measure(setting, readings);
  for (const measure::Reading& reading : readings)
    printf("goal %d: %s, %s: %.4g %s of %g\n", reading.goal, reading.probe.c_str(), reading.what.c_str(),
           reading.off, reading.unit, reading.tolerance(setting.quality));
  return readings;
}
inline void expect_holds(const measure::Setting& setting, const measure::Reading& reading) {
  EXPECT_TRUE(reading.holds(setting.quality))
      << reading.probe << ": " << reading.what << " is off by " << reading.off << " " << reading.unit;
}
inline void expect_holds(const measure::Setting& setting,
                         void (*measure)(const measure::Setting&, measure::Readings&)) {
  const measure::Readings readings = readings_of(setting, measure);
  ASSERT_FALSE(readings.empty());
  for (const measure::Reading& reading : readings) expect_holds(setting, reading);
}
inline measure::Setting practised(const Probe& probe) {
  return measure::Setting::of(UltrasoundMethod::scatterers, probe, measure::Quality::fast);
}
// Those that are learnt on; `seldinger goals` measures the thesis' two as well.
constexpr Probe kRealProbes[] = {kC52v, kL115v};

// Fat and muscle over liver, a cyst and a piece of bone in it.
inline Scene layers() {
  return scene(
      [](const glm::dvec3& p) {
        if (p.y < 8.0) return TissueClass::fat;
        if (p.y < 15.0 + 0.2 * p.x) return TissueClass::muscle;
        if (glm::length(p - glm::dvec3(6.0, 32.0, 1.0)) < 7.0) return TissueClass::fluid;
        return glm::length(p - glm::dvec3(-9.0, 36.0, 1.0)) < 5.0 ? TissueClass::bone : TissueClass::liver;
      },
      {110, 130, 40}, 1.5);
}

}  // namespace seldinger::imaging
