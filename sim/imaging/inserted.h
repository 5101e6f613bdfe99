// What is inserted into a picture: the needle as it lies, and lesions. Slices, X-ray and ultrasound share it.
#pragma once

#include <cmath>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "sim/base/vectors.h"
#include "sim/case/case.h"

namespace seldinger::imaging {

// The finite cylinder tip − t·direction, 0 ≤ t ≤ length. Its lumen (inner_radius_mm > 0) is empty and shows as air,
// −1000 HU, over whatever lies there; with a slab the needle shows solid. A pose that is not finite is not shown.
struct NeedlePose {
  glm::dvec3 tip_lps_mm{0.0};
  glm::dvec3 direction{0.0, 0.0, 1.0};  // unit, hub → tip
  double length_mm = 200.0, radius_mm = 0.36, inner_radius_mm = 0.0, hu = 3000.0;
  double bevel_turn_rad = 0.0;  // about the shaft; 0: the bevel faces the probe
};

// The instrument where its tip is, pointing there.
inline NeedlePose needle_pose(const cases::Instrument& instrument, const glm::dvec3& tip_lps_mm,
                              const glm::dvec3& direction) noexcept {
  return {tip_lps_mm,   direction, instrument.length_mm, instrument.radius_mm, instrument.inner_radius_mm,
          instrument.hu};
}

using base::is_finite;

inline bool is_finite(const NeedlePose& needle) noexcept {
  return is_finite(needle.tip_lps_mm) && is_finite(needle.direction) && std::isfinite(needle.length_mm) &&
         std::isfinite(needle.radius_mm) && std::isfinite(needle.inner_radius_mm) &&
         std::isfinite(needle.bevel_turn_rad);
}

struct Inserted {
  std::optional<NeedlePose> needle;
  std::vector<cases::Lesion> lesions;  // at most kMaxLesions; the first that contains a point wins
};
constexpr int kMaxLesions = 16;

}  // namespace seldinger::imaging
