// Force against depth as a tensile tester or `haptics insert` writes it: the part of it that is an insertion.
#pragma once

#include <span>
#include <vector>

#include "sim/base/result.h"

namespace seldinger::haptics {

struct DepthForce {
  double depth_mm = 0.0;  // from the first touch
  double force_n = 0.0;   // > 0 resists insertion
};

// What a curve must have, so that a capsule and a plateau can be told apart in it (design: dents are up to 10 mm,
// thesis §5.3.2).
inline constexpr int kLeastCurveRows = 50;
inline constexpr double kLeastCurveMm = 15.0;
inline constexpr double kLatestTouchMm = 1.0;  // the first row stands no deeper
inline constexpr double kMostPullBackMm = 1.0;
// Beyond these, either way, it is no needle's curve, or in other units (design).
inline constexpr double kMostCurveMm = 1000.0, kMostCurveN = 500.0;

// The rows from the first to the first that is deepest: no rest at depth, no retraction. Refused with every fault
// found: `not_finite`, `out_of_range`, `too_few_rows`, `too_shallow`, `starts_late`, `not_one_insertion` (pulled
// back on the way in), `no_resistance` (no force above 0). Never empty.
base::Result<std::vector<DepthForce>> insertion_in(std::span<const DepthForce> rows);

// At most `most` points, means over equal steps of depth, so that a slow stretch counts no more than a fast one.
// The curve as it is where it has no more points.
std::vector<DepthForce> thinned(std::span<const DepthForce> curve, int most);

}  // namespace seldinger::haptics
