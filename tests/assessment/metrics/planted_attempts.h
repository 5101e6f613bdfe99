// Attempts from formulas in a body that fills y ≥ 0, with one thing in them that a metric must not miss or be
// misled by; and what the metrics say of them.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "assessment/registry.h"
#include "assessment/signals/signals.h"
#include "sim/base/rng.h"
#include "tests/assessment/metrics/flat_body.h"

namespace seldinger::assessment {

inline AttemptSetting planted_setting() {
  AttemptSetting made;
  made.skin = &body();
  made.modality = cases::Modality::ultrasound;
  made.target = cases::Lesion{{0.0, 60.0, 0.0}, 6.0, 20.0};
  return made;
}

// The pose at a time.
using PoseAt = std::function<void(double t_s, cases::PoseSample& pose)>;

// At `rate_hz`, a picture with each pose that shows everything; the probe stands above the needle, which lies in
// its plane. Fired at the end.
inline cases::Recording recorded(const PoseAt& pose_at, double seconds, double rate_hz = 100.0) {
  cases::Recording recording;
  const int rows = static_cast<int>(std::lround(seconds * rate_hz));
  for (int i = 0; i <= rows; ++i) {
    cases::PoseSample pose;
    pose.t_s = i / rate_hz;
    pose.needle_direction = pose.probe_axial = {0.0, 1.0, 0.0};
    pose.probe_lateral = {1.0, 0.0, 0.0};
    pose_at(pose.t_s, pose);
    recording.poses.push_back(pose);
    recording.frames.push_back({pose.t_s, true, true, true, 10.0});
  }
  const cases::PoseSample& last = recording.poses.back();
  recording.endpoint = cases::Endpoint{last.t_s, last.tip_lps_mm, last.needle_direction, last.rest_tip_lps_mm};
  return recording;
}

// Straight down, the tissue at the tip displaced by `breath_mm` along the needle.
inline cases::Recording straight_down(const std::function<double(double)>& depth_mm, double seconds,
                                      const std::function<double(double)>& breath_mm = {}) {
  return recorded(
      [&](double t_s, cases::PoseSample& pose) {
        pose.tip_lps_mm = {0.0, depth_mm(t_s), 0.0};
        if (breath_mm) pose.rest_tip_lps_mm = pose.tip_lps_mm - glm::dvec3(0.0, breath_mm(t_s), 0.0);
      },
      seconds);
}

inline void add_noise(cases::Recording& recording, double sigma_mm, std::uint64_t seed) {
  base::Rng rng(seed);
  for (cases::PoseSample& pose : recording.poses)
    pose.tip_lps_mm += sigma_mm * glm::dvec3(rng.normal(), rng.normal(), rng.normal());
  recording.endpoint->tip_lps_mm = recording.poses.back().tip_lps_mm;
}

inline MetricValue planted_value(const cases::Recording& recording, const std::string& id,
                                 const AttemptSetting& setting = planted_setting()) {
  const auto signals = make_signals(setting, recording);
  EXPECT_TRUE(signals.has_value());
  if (signals)
    for (const MetricValue& metric : measure_all(*signals))
      if (metric.id == id) return metric;
  ADD_FAILURE() << "no metric " << id;
  return {};
}

inline double planted_number(const cases::Recording& recording, const std::string& id,
                             const AttemptSetting& setting = planted_setting()) {
  const MetricValue metric = planted_value(recording, id, setting);
  EXPECT_TRUE(metric.value.has_value()) << id << ": " << metric.reason;
  return metric.value.value_or(std::nan(""));
}

}  // namespace seldinger::assessment
