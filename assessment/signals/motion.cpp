#include "assessment/signals/motion.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "assessment/signals/signals.h"

namespace seldinger::assessment {
namespace {

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

// What is between two poses, 100 times a second.
struct Resampled {
  std::vector<glm::dvec3> tip, probe, probe_axial, probe_lateral;
  std::vector<glm::dvec3> rest;  // the tip's places at rest; empty: they are the tip's
  std::vector<double> depth_mm;
  std::vector<std::size_t> pose;  // the last one not later
};

// Poses first..last, no gap between, by linear interpolation; last_only is what is left after the last whole
// sample.
Resampled resampled(const Signals& signals, std::size_t first, std::size_t last) {
  const auto& poses = signals.poses;
  const double start_s = poses[first].t_s, length_s = poses[last].t_s - start_s;
  const auto steps = static_cast<std::size_t>(std::floor(length_s * kMotionRateHz + 1e-9));
  Resampled out;
  out.tip.reserve(steps + 2);
  for (std::vector<glm::dvec3>* points : {&out.probe, &out.probe_axial, &out.probe_lateral})
    points->reserve(steps + 2);
  out.depth_mm.reserve(steps + 2);
  out.pose.reserve(steps + 2);
  const bool moves = std::any_of(poses.begin() + static_cast<std::ptrdiff_t>(first),
                                 poses.begin() + static_cast<std::ptrdiff_t>(last) + 1,
                                 [](const cases::PoseSample& pose) { return pose.rest_tip_lps_mm.has_value(); });
  std::size_t at = first;
  for (std::size_t i = 0; i <= steps; ++i) {
    const double t_s = start_s + static_cast<double>(i) / kMotionRateHz;
    while (at + 1 < last && poses[at + 1].t_s <= t_s) ++at;
    const std::size_t next = std::min(at + 1, last);
    const double span_s = poses[next].t_s - poses[at].t_s;
    const double share = span_s > 0.0 ? std::clamp((t_s - poses[at].t_s) / span_s, 0.0, 1.0) : 0.0;
    const auto between = [&](const auto& a, const auto& b) { return a + (b - a) * share; };
    out.tip.push_back(between(poses[at].tip_lps_mm, poses[next].tip_lps_mm));
    if (moves) out.rest.push_back(between(poses[at].tip_at_rest_lps_mm(), poses[next].tip_at_rest_lps_mm()));
    out.probe.push_back(between(poses[at].probe_origin_lps_mm, poses[next].probe_origin_lps_mm));
    out.probe_axial.push_back(between(poses[at].probe_axial, poses[next].probe_axial));
    out.probe_lateral.push_back(between(poses[at].probe_lateral, poses[next].probe_lateral));
    out.depth_mm.push_back(between(signals.passages[at].depth_mm, signals.passages[next].depth_mm));
    out.pose.push_back(at);
  }
  return out;
}

// Steps of one stretch without a gap.
void add_steps(const Signals& signals, std::size_t first, std::size_t last, std::vector<Step>& steps) {
  if (last == first) return;
  Resampled way = resampled(signals, first, last);
  way.tip = low_pass(way.tip, kMotionRateHz, kMotionCutoffHz);
  for (std::vector<glm::dvec3>* points : {&way.probe, &way.probe_axial, &way.probe_lateral})
    *points = low_pass(*points, kMotionRateHz, kMotionCutoffHz);
  const bool moves = !way.rest.empty();
  if (moves) way.rest = low_pass(way.rest, kMotionRateHz, kMotionCutoffHz);
  const double start_s = signals.poses[first].t_s, length_s = signals.poses[last].t_s - start_s;
  // What is left after the last whole sample, unfiltered: at most 10 ms.
  const double rest_s = length_s - static_cast<double>(way.tip.size() - 1) / kMotionRateHz;
  if (rest_s > 1e-9) {
    way.tip.push_back(signals.poses[last].tip_lps_mm);
    if (moves) way.rest.push_back(signals.poses[last].tip_at_rest_lps_mm());
    way.probe.push_back(signals.poses[last].probe_origin_lps_mm);
    way.probe_axial.push_back(signals.poses[last].probe_axial);
    way.probe_lateral.push_back(signals.poses[last].probe_lateral);
    way.depth_mm.push_back(signals.passages[last].depth_mm);
    way.pose.push_back(last);
  }
  for (std::size_t i = 0; i + 1 < way.tip.size(); ++i) {
    Step step;
    step.t_s = start_s + static_cast<double>(i) / kMotionRateHz;
    step.length_s = i + 2 == way.tip.size() && rest_s > 1e-9 ? rest_s : 1.0 / kMotionRateHz;
    step.from_lps_mm = way.tip[i];
    step.to_lps_mm = way.tip[i + 1];
    step.rest_from_lps_mm = moves ? way.rest[i] : way.tip[i];
    step.rest_to_lps_mm = moves ? way.rest[i + 1] : way.tip[i + 1];
    step.probe_from_lps_mm = way.probe[i];
    step.probe_to_lps_mm = way.probe[i + 1];
    step.probe_axial_from = way.probe_axial[i];
    step.probe_axial_to = way.probe_axial[i + 1];
    step.probe_lateral_from = way.probe_lateral[i];
    step.probe_lateral_to = way.probe_lateral[i + 1];
    step.needle_direction = signals.poses[way.pose[i]].needle_direction;
    step.depth_from_mm = way.depth_mm[i];
    step.depth_to_mm = way.depth_mm[i + 1];
    step.first = i == 0;
    steps.push_back(step);
  }
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

std::vector<Step> steps_of(const Signals& signals) {
  std::vector<Step> steps;
  for (std::size_t first = 0; first < signals.poses.size();) {
    std::size_t last = first;
    while (last + 1 < signals.poses.size() && !signals.gap(last)) ++last;
    add_steps(signals, first, last, steps);
    first = last + 1;
  }
  return steps;
}

std::vector<TraceSegment> trace_of(const Signals& signals) {
  std::vector<TraceSegment> trace;
  glm::dvec3 point(0.0);
  double point_s = 0.0;
  for (std::size_t i = 0; i < signals.steps.size(); ++i) {
    const Step& step = signals.steps[i];
    if (step.first) {
      point = step.rest_from_lps_mm;
      point_s = step.t_s;
    }
    const bool ends = i + 1 == signals.steps.size() || signals.steps[i + 1].first;
    const double length_mm = glm::distance(point, step.rest_to_lps_mm);
    if (length_mm < kTraceMm && !(ends && length_mm > 0.0)) continue;
    const double now_s = step.t_s + step.length_s;
    trace.push_back(
        {point, step.rest_to_lps_mm, step.needle_direction, step.depth_to_mm > 0.0, false, point_s, now_s});
    point = step.rest_to_lps_mm;
    point_s = now_s;
  }
  const cases::Instrument& needle = signals.setting.instrument;
  if (signals.endpoint && needle.kind == cases::InstrumentKind::core) {
    const cases::Endpoint& fired = *signals.endpoint;
    const glm::dvec3& from = fired.tip_at_rest_lps_mm();
    trace.push_back({from, from + fired.direction * needle.throw_mm, fired.direction,
                     signals.passages.back().in_body, true, fired.t_s, fired.t_s});
  }
  return trace;
}

}  // namespace seldinger::assessment
