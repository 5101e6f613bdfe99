// Metrics of the recording's own quality.
#include <algorithm>

#include "assessment/metrics/quality.h"
#include "assessment/metrics/tables.h"
#include "assessment/signals/signals.h"

namespace seldinger::assessment {
namespace {

Measured gap_share(const Signals& signals) {
  const double total_s = signals.poses.back().t_s - signals.poses.front().t_s;
  if (!(total_s > 0.0)) return Measured::none("too_short");
  double gap_s = 0.0;
  for (std::size_t i = 0; i + 1 < signals.poses.size(); ++i)
    if (signals.gap(i)) gap_s += signals.interval_s(i);
  return Measured::of(gap_s / total_s);
}

Measured sample_rate_p5(const Signals& signals) {
  if (!signals.sample_rate_p5_hz) return Measured::none("too_short");
  return Measured::of(*signals.sample_rate_p5_hz);
}

Measured tracking_jumps(const Signals& signals) {
  int jumps = 0;
  for (const Gap gap : signals.gaps) jumps += gap == Gap::jump ? 1 : 0;
  return Measured::of(jumps);
}

constexpr MetricInfo kRecordingMetrics[] = {
    {"gap_share", 2, "share", "Tracking gaps", Group::recording, Direction::lower_is_better, 0,
     "Share of the time in gaps between poses: of over 0.25 s, or in which the tip jumped (tracking_jumps); gaps "
     "belong "
     "to no other metric's denominator. An attempt with over 5 % is not graded. Null: too_short.",
     "data quality", &gap_share},
    {"sample_rate_p5", 1, "Hz", "Tracking rate", Group::recording, Direction::higher_is_better, 0,
     "Rate of the poses that was kept for 95 % of the time outside gaps. An attempt under 60 Hz is not graded. "
     "Null: "
     "too_short (or nothing but gaps).",
     "data quality", &sample_rate_p5},
    {"tracking_jumps", 1, "count", "Tracking jumps", Group::recording, Direction::lower_is_better, 0,
     "Times the tip went more than 50 mm at more than 10 m/s from one pose to the next: no hand does, the tracker "
     "lost "
     "it. An attempt with any is not graded.",
     "data quality", &tracking_jumps},
};

}  // namespace

std::span<const MetricInfo> recording_metrics() {
  return kRecordingMetrics;
}

std::string why_not_gradable(std::span<const MetricValue> metrics) {
  const auto find = [&](const char* id) {
    return std::find_if(metrics.begin(), metrics.end(), [&](const MetricValue& metric) { return metric.id == id; });
  };
  const auto gaps = find("gap_share"), rate = find("sample_rate_p5"), jumps = find("tracking_jumps");
  if (gaps == metrics.end() || rate == metrics.end() || jumps == metrics.end()) return "quality_not_measured";
  if (!gaps->value) return "too_short";
  if (!(*gaps->value <= kMaxGapShare)) return "tracking_gaps";
  if (!rate->value || !(*rate->value >= kMinSampleRateHz * (1.0 - 1e-6))) return "tracking_slow";
  if (!jumps->value || *jumps->value > 0.0) return "tracking_jumps";
  return "";
}

}  // namespace seldinger::assessment
