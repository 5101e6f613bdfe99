// Attempts straight down into a body, from a depth over time, and what the metrics say of them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "assessment/registry.h"
#include "assessment/signals/signals.h"
#include "tests/assessment/metrics/flat_body.h"

namespace seldinger::assessment {

inline AttemptSetting setting() {
  AttemptSetting s;
  s.skin = &body();
  s.target = cases::Lesion{{0.0, 60.0, 0.0}, 6.0, 20.0};
  return s;
}

// Tip depth as a function of time, straight down, at rate_hz; all frames show everything.
inline cases::Recording straight(const std::function<double(double)>& depth_mm, double seconds,
                                 double rate_hz = 100.0) {
  cases::Recording recording;
  const int n = static_cast<int>(std::lround(seconds * rate_hz));
  for (int i = 0; i <= n; ++i) {
    cases::PoseSample pose;
    pose.t_s = i / rate_hz;
    pose.tip_lps_mm = {0.0, depth_mm(pose.t_s), 0.0};
    pose.needle_direction = {0.0, 1.0, 0.0};
    recording.poses.push_back(pose);
    recording.frames.push_back({pose.t_s, true, true, true, 10.0});
  }
  recording.endpoint =
      cases::Endpoint{recording.poses.back().t_s, recording.poses.back().tip_lps_mm, {0.0, 1.0, 0.0}};
  return recording;
}

inline MetricValue value(const cases::Recording& recording, const std::string& id,
                         const AttemptSetting& s = setting()) {
  const auto signals = make_signals(s, recording);
  EXPECT_TRUE(signals.has_value()) << signals.error().text;
  for (const MetricValue& metric : measure_all(*signals))
    if (metric.id == id) return metric;
  ADD_FAILURE() << id;
  return {};
}

inline double number(const cases::Recording& recording, const std::string& id,
                     const AttemptSetting& s = setting()) {
  const MetricValue metric = value(recording, id, s);
  EXPECT_TRUE(metric.value.has_value()) << id << ": " << metric.reason;
  return metric.value.value_or(std::nan(""));
}

inline double ramp(double t_s, double mm_s) {
  return -20.0 + mm_s * t_s;
}

// From one depth to the next in a tenth of a second, as a hand may, each kept until its time: what went there from
// one pose to the next would be the tracker's leap.
inline std::function<double(double)> in_turn(std::vector<std::pair<double, double>> until_s_depth_mm) {
  return [=](double t_s) {
    for (std::size_t i = 0; i < until_s_depth_mm.size(); ++i) {
      const auto& [until_s, depth_mm] = until_s_depth_mm[i];
      if (t_s >= until_s && i + 1 < until_s_depth_mm.size()) continue;
      const double since_s = i == 0 ? 1.0 : t_s - until_s_depth_mm[i - 1].first;
      const double before_mm = i == 0 ? depth_mm : until_s_depth_mm[i - 1].second;
      return before_mm + (depth_mm - before_mm) * std::clamp(since_s / 0.1, 0.0, 1.0);
    }
    return 0.0;
  };
}

}  // namespace seldinger::assessment
