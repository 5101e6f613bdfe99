// Metrics of time.
#include "assessment/metrics/tables.h"
#include "assessment/signals/signals.h"

namespace seldinger::assessment {
namespace {

Measured time_total(const Signals& signals) {
  return Measured::of(signals.poses.back().t_s - signals.poses.front().t_s);
}

Measured time_in_tissue(const Signals& signals) {
  double time_s = 0.0;
  for (std::size_t i = 0; i + 1 < signals.poses.size(); ++i)
    if (signals.passages[i].in_body && !signals.gap(i)) time_s += signals.interval_s(i);
  return Measured::of(time_s);
}

Measured time_puncture_to_target(const Signals& signals) {
  const PunctureCounts counts = count_punctures(signals);
  if (!counts.first_s) return Measured::none("never_punctured");
  return Measured::of(signals.endpoint->t_s - *counts.first_s);
}

constexpr MetricInfo kTimeMetrics[] = {
    {"time_total", 1, "s", "Time", Group::time, Direction::lower_is_better, 0,
     "From the first pose to the endpoint; without an endpoint to the last pose.", kJohnson, &time_total},
    {"time_in_tissue", 1, "s", "Time in tissue", Group::time, Direction::lower_is_better, kSkin | kMotion,
     "Time with the tip below the skin; gaps over 0.25 s belong to none.", "Perk Tutor's TissueTime",
     &time_in_tissue},
    {"time_puncture_to_target", 1, "s", "From puncture to trigger", Group::time, Direction::lower_is_better,
     kEndpoint | kSkin | kMotion,
     "From the first skin puncture that counts, 2 mm deep, to the endpoint. Null: never_punctured.", kJohnson,
     &time_puncture_to_target},
};

}  // namespace

std::span<const MetricInfo> time_metrics() {
  return kTimeMetrics;
}

}  // namespace seldinger::assessment
