#include "assessment/metrics/path.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "assessment/signals.h"

namespace seldinger::assessment {
namespace {

constexpr double kRateHz = 100.0;  // canonical signal (assessment.md §8)
constexpr double kCutoffHz = 10.0;

// Second-order Butterworth by the bilinear transform, started in the steady state of its first value.
void second_order(std::vector<glm::dvec3>& x, double b0, double b1, double b2, double a1, double a2) {
  glm::dvec3 x1 = x.front(), x2 = x.front(), y1 = x.front(), y2 = x.front();
  for (glm::dvec3& value : x) {
    const glm::dvec3 y = b0 * value + b1 * x1 + b2 * x2 - a1 * y1 - a2 * y2;
    x2 = x1;
    x1 = value;
    y2 = y1;
    y1 = y;
    value = y;
  }
}

// Poses first..last (no gap between) at kRateHz by linear interpolation, the last one kept.
std::vector<glm::dvec3> resampled(const Signals& signals, std::size_t first, std::size_t last) {
  const auto& poses = signals.poses;
  const double start_s = poses[first].t_s, length_s = poses[last].t_s - start_s;
  const auto steps = static_cast<std::size_t>(std::floor(length_s * kRateHz + 1e-9));
  std::vector<glm::dvec3> out;
  out.reserve(steps + 2);
  std::size_t at = first;
  for (std::size_t i = 0; i <= steps; ++i) {
    const double t_s = start_s + static_cast<double>(i) / kRateHz;
    while (at + 1 < last && poses[at + 1].t_s <= t_s) ++at;
    const std::size_t next = std::min(at + 1, last);
    const double span_s = poses[next].t_s - poses[at].t_s;
    const double share = span_s > 0.0 ? std::clamp((t_s - poses[at].t_s) / span_s, 0.0, 1.0) : 0.0;
    out.push_back(poses[at].tip_lps_mm + (poses[next].tip_lps_mm - poses[at].tip_lps_mm) * share);
  }
  return out;
}

}  // namespace

std::vector<glm::dvec3> low_pass(std::span<const glm::dvec3> positions, double rate_hz, double cutoff_hz) {
  if (positions.size() < 3) return {positions.begin(), positions.end()};
  const auto pad =
      static_cast<std::ptrdiff_t>(std::ceil(rate_hz / cutoff_hz)) * 6;  // the filter forgets in a third
  const auto count = static_cast<std::ptrdiff_t>(positions.size());
  std::vector<glm::dvec3> x;
  x.reserve(static_cast<std::size_t>(count + 2 * pad));
  // Reflection through an end point repeats when the signal is shorter than the padding.
  const auto reflected = [&](std::ptrdiff_t i) {
    glm::dvec3 offset(0.0);
    double sign = 1.0;
    for (;;) {
      if (i < 0) {
        offset += sign * 2.0 * positions.front();
        i = -i;
      } else if (i >= count) {
        offset += sign * 2.0 * positions.back();
        i = 2 * (count - 1) - i;
      } else {
        return offset + sign * positions[static_cast<std::size_t>(i)];
      }
      sign = -sign;
    }
  };
  for (std::ptrdiff_t i = -pad; i < count + pad; ++i) x.push_back(reflected(i));
  const double corrected_hz = cutoff_hz / std::pow(std::sqrt(2.0) - 1.0, 0.25);
  const double w = std::tan(std::numbers::pi * corrected_hz / rate_hz);
  const double scale = 1.0 / (1.0 + std::numbers::sqrt2 * w + w * w);
  const double b0 = w * w * scale, a1 = 2.0 * (w * w - 1.0) * scale;
  const double a2 = (1.0 - std::numbers::sqrt2 * w + w * w) * scale;
  for (int pass = 0; pass < 2; ++pass) {
    second_order(x, b0, 2.0 * b0, b0, a1, a2);
    std::reverse(x.begin(), x.end());
  }
  return {x.begin() + pad, x.begin() + pad + count};
}

Measured path_tip(const Signals& signals) {
  if (signals.only_gaps()) return Measured::none("only_gaps");
  double path_mm = 0.0;
  for (std::size_t first = 0; first < signals.poses.size();) {
    std::size_t last = first;
    while (last + 1 < signals.poses.size() && !signals.gap(last)) ++last;
    std::vector<glm::dvec3> way = low_pass(resampled(signals, first, last), kRateHz, kCutoffHz);
    // What is left after the last whole sample, unfiltered: at most 10 ms.
    if (last > first) {
      const double rest_s =
          (signals.poses[last].t_s - signals.poses[first].t_s) - static_cast<double>(way.size() - 1) / kRateHz;
      if (rest_s > 1e-9) way.push_back(signals.poses[last].tip_lps_mm);
    }
    for (std::size_t i = 0; i + 1 < way.size(); ++i) path_mm += glm::length(way[i + 1] - way[i]);
    first = last + 1;
  }
  return Measured::of(path_mm);
}

}  // namespace seldinger::assessment
