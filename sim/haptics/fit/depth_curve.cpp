#include "sim/haptics/fit/depth_curve.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "sim/base/check.h"

namespace seldinger::haptics {
namespace {

std::string millimetres(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g mm", value);
  return text;
}

}  // namespace

base::Result<std::vector<DepthForce>> insertion_in(std::span<const DepthForce> rows) {
  base::Error error;
  const auto bad = [&](const char* code, const std::string& text) { error.findings.push_back({code, text}); };
  const auto unusable = [](const DepthForce& row) {
    return !std::isfinite(row.depth_mm) || !std::isfinite(row.force_n);
  };
  const auto beyond = [](const DepthForce& row) {
    return std::abs(row.depth_mm) > kMostCurveMm || std::abs(row.force_n) > kMostCurveN;
  };
  if (const auto found = std::find_if(rows.begin(), rows.end(), unusable); found != rows.end()) {
    bad("not_finite", "row " + std::to_string(found - rows.begin() + 1) + " is not of finite numbers");
  } else if (const auto far = std::find_if(rows.begin(), rows.end(), beyond); far != rows.end()) {
    bad("out_of_range", "row " + std::to_string(far - rows.begin() + 1) +
                            " is beyond 1000 mm or 500 N: are they millimetres and newtons?");
  } else if (!rows.empty()) {
    const auto deepest = std::max_element(
        rows.begin(), rows.end(), [](const DepthForce& a, const DepthForce& b) { return a.depth_mm < b.depth_mm; });
    rows = rows.first(static_cast<std::size_t>(deepest - rows.begin()) + 1);
    const double way_mm = deepest->depth_mm - rows.front().depth_mm;
    if (!(way_mm >= kLeastCurveMm))
      bad("too_shallow", "the depth rises by " + millimetres(way_mm) + ", of which it takes " +
                             millimetres(kLeastCurveMm) + " to tell a capsule from a plateau");
    if (rows.front().depth_mm > kLatestTouchMm)
      bad("starts_late", "the first row is " + millimetres(rows.front().depth_mm) +
                             " deep: depth counts from the first touch, at which the curve must start");
    double reached_mm = rows.front().depth_mm;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      reached_mm = std::max(reached_mm, rows[i].depth_mm);
      if (rows[i].depth_mm >= reached_mm - kMostPullBackMm) continue;
      bad("not_one_insertion", "row " + std::to_string(i + 1) + " has been pulled back by more than " +
                                   millimetres(kMostPullBackMm) + " on the way in");
      break;
    }
    if (std::none_of(rows.begin(), rows.end(), [](const DepthForce& row) { return row.force_n > 0.0; }))
      bad("no_resistance", "no force is above 0; one that resists insertion is");
  }
  if (rows.size() < static_cast<std::size_t>(kLeastCurveRows))
    bad("too_few_rows",
        "an insertion of " + std::to_string(rows.size()) + " rows; it takes " + std::to_string(kLeastCurveRows));
  if (error.findings.empty()) return std::vector<DepthForce>(rows.begin(), rows.end());
  error.code = error.findings.front().code;
  error.text = error.findings.front().text;
  error.findings.erase(error.findings.begin());
  return error;
}

std::vector<DepthForce> thinned(std::span<const DepthForce> curve, int most) {
  CHECK(most > 0);
  if (curve.size() <= static_cast<std::size_t>(most)) return {curve.begin(), curve.end()};
  const auto [least, deepest] = std::minmax_element(
      curve.begin(), curve.end(), [](const DepthForce& a, const DepthForce& b) { return a.depth_mm < b.depth_mm; });
  const double from_mm = least->depth_mm, way_mm = deepest->depth_mm - from_mm;
  std::vector<DepthForce> sums(static_cast<std::size_t>(most));
  std::vector<int> counts(sums.size());
  for (const DepthForce& point : curve) {
    const double share = way_mm > 0.0 ? (point.depth_mm - from_mm) / way_mm : 0.0;
    const auto at = std::min(sums.size() - 1, static_cast<std::size_t>(share * most));
    sums[at].depth_mm += point.depth_mm;
    sums[at].force_n += point.force_n;
    ++counts[at];
  }
  std::vector<DepthForce> means;
  for (std::size_t i = 0; i < sums.size(); ++i)
    if (counts[i] > 0) means.push_back({sums[i].depth_mm / counts[i], sums[i].force_n / counts[i]});
  return means;
}

}  // namespace seldinger::haptics
