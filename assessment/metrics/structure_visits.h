// A structure with the box around it, and the tip's visits to it: what counts as having been inside.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "assessment/signals/motion.h"
#include "sim/case/structure.h"

namespace seldinger::assessment {

// More way than this inside is a visit, and as much outside ends it (docs/clinical.md: any path longer than this
// inside).
constexpr double kVisitMm = 0.5;

// The box is what most of the way is outside of. The structure outlives it.
class BoxedStructure {
 public:
  explicit BoxedStructure(const cases::Structure& structure);
  // By a formula, which is asked at no cost; else by voxels.
  bool drawn() const;
  // Half of the longest edge of a voxel, mm: so far off its surface may be. 0 of what is drawn.
  double half_voxel_mm() const;
  // The parts of a → b that are inside, in order.
  std::vector<cases::Stretch> stretches(const glm::dvec3& a_lps_mm, const glm::dvec3& b_lps_mm) const;
  // Exact below `enough_mm`, else some lower bound that is not below it. Far is asked in voxels at a high price, so
  // the search widens only as long as it must, from a lower bound that is known.
  double distance_mm(const glm::dvec3& p_lps_mm, double known_mm, double enough_mm) const;
  bool contains(const glm::dvec3& p_lps_mm) const;

 private:
  double beyond_mm(const glm::dvec3& p_lps_mm) const;  // a lower bound of the distance

  const cases::Structure* structure_;
  cases::Bounds box_;
};

// A part of one segment of the way.
struct WayPart {
  std::size_t segment = 0;
  cases::Stretch stretch;
};

// More than kVisitMm of way inside; up to kVisitMm outside in between ends none.
struct Visit {
  std::vector<WayPart> inside;      // from the entry on, in order
  bool began_inside = false;        // with the way itself: it was not entered
  bool through = false;             // left forwards, along the needle: through the far wall
  double from_s = 0.0, to_s = 0.0;  // no earlier than this it began, no later than that it ended
};
std::vector<Visit> visits_of(const BoxedStructure& structure, std::span<const TraceSegment> trace);

// Share of a way that lies in any of the stretches, each part once.
double covered_share(std::vector<cases::Stretch> stretches);

}  // namespace seldinger::assessment
