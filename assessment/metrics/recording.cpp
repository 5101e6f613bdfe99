// Metrics of the recording's own quality.
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
    if (signals.gaps[i] == Gap::silence || signals.gaps[i] == Gap::jump) gap_s += signals.interval_s(i);
  return Measured::of(gap_s / total_s);
}

Measured sample_rate_p5(const Signals& signals) {
  if (!signals.sample_rate_p5_hz) return Measured::none("too_short");
  return Measured::of(*signals.sample_rate_p5_hz);
}

Measured tracking_jumps(const Signals& signals) {
  return Measured::of(signals.tracking.jumps);
}

Measured jumps_unrepaired(const Signals& signals) {
  return Measured::of(signals.tracking.left);
}

Measured repaired_share(const Signals& signals) {
  return Measured::of(static_cast<double>(signals.tracking.repaired) / static_cast<double>(signals.poses.size()));
}

constexpr std::uint32_t kOfTracker = kInAnyFrame | kMirrored | kOneDarkFrame;

constexpr MetricInfo kRecordingMetrics[] = {
    {"gap_share", 3, "share", "Tracking gaps", Group::recording, Direction::lower_is_better, 0,
     "Share of the time in gaps between poses: gaps of over 0.25 s, or with a jump of the tip that was not "
     "repaired (jumps_unrepaired); gaps belong to no other metric's denominator. An attempt with over 5 % is not "
     "graded. Null: too_short.",
     "data quality", &gap_share, kMedianShare, kOfTracker,
     "1: only of over 0.25 s; 2: with jumps as tracking_jumps' version 1 had them."},
    {"sample_rate_p5", 1, "Hz", "Tracking rate", Group::recording, Direction::higher_is_better, 0,
     "Rate of the poses that was kept up for 95 % of the time outside gaps. An attempt under 60 Hz is not graded. "
     "Null: too_short (or nothing but gaps).",
     "data quality", &sample_rate_p5, kMedianRatio, kOfTracker},
    {"tracking_jumps", 2, "count", "Tracking jumps", Group::recording, Direction::lower_is_better, 0,
     "Times the needle's tip, over 10 ms, moved faster than 2 m/s or accelerated by more than 100 m/s²: no hand "
     "does that, the tracker lost it. A jump within 0.1 s of another counts as one with it: there and back. "
     "Counted before anything is repaired; moves made by the program (needle guide, change of hands, start) do not "
     "count.",
     "data quality", &tracking_jumps, kMeanCount, kOfTracker,
     "1: only more than 50 mm at more than 10 m/s, so that 80 mm in 10 ms counted as the hand's."},
    {"jumps_unrepaired", 1, "count", "Jumps not repaired", Group::recording, Direction::lower_is_better, 0,
     "Of tracking_jumps, those left after single poses far from their neighbours were put back between them "
     "(repaired_share). They are gaps, and an attempt with any is not graded.",
     "data quality", &jumps_unrepaired, kMeanCount, kOfTracker},
    {"repaired_share", 1, "share", "Poses repaired", Group::recording, Direction::lower_is_better, 0,
     "Share of the poses that were part of a jump, that a Hampel filter (seven poses, three times 1.4826 the "
     "median absolute deviation) found far from their neighbours, and that were put back between them, at most "
     "three in a row: every metric is measured on the repaired poses. An attempt with over 1 % is not graded.",
     "Hampel filter: Pearson, IEEE Trans. Control Syst. Technol. 10 (2002) 55", &repaired_share, kMedianShare,
     kOfTracker},
};

}  // namespace

std::span<const MetricInfo> recording_metrics() {
  return kRecordingMetrics;
}

std::string why_not_gradable(std::span<const MetricValue> metrics) {
  const auto newest = [&](const char* id) {
    const MetricValue* found = nullptr;
    for (const MetricValue& metric : metrics)
      if (metric.id == id && (found == nullptr || metric.version > found->version)) found = &metric;
    return found;
  };
  const MetricValue *gaps = newest("gap_share"), *rate = newest("sample_rate_p5"),
                    *jumps = newest("tracking_jumps");
  if (gaps == nullptr || rate == nullptr || jumps == nullptr) return "quality_not_measured";
  if (!gaps->value) return "too_short";
  if (!(*gaps->value <= kMaxGapShare)) return "tracking_gaps";
  if (!rate->value || !(*rate->value >= kMinSampleRateHz * (1.0 - 1e-6))) return "tracking_slow";
  // Stored before anything was repaired, an attempt with any jump is spoiled.
  const MetricValue *left = newest("jumps_unrepaired"), *repaired = newest("repaired_share");
  if (left == nullptr) left = jumps;
  if (!left->value || *left->value > 0.0) return "tracking_jumps";
  if (repaired != nullptr && !(repaired->value && *repaired->value <= kMaxRepairedShare))
    return "tracking_repaired";
  // Stored before it was asked, an attempt keeps its grade.
  const MetricValue* impossible = newest("way_impossible");
  if (impossible != nullptr && impossible->value && !(*impossible->value == 0.0)) return "way_impossible";
  return "";
}

}  // namespace seldinger::assessment
