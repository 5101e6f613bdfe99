// Whether an attempt's recording is good enough to be graded.
#pragma once

#include <span>
#include <string>

#include "assessment/metrics/metric.h"

namespace seldinger::assessment {

constexpr double kMaxGapShare = 0.05, kMinSampleRateHz = 60.0;  // our judgement
constexpr double kMaxRepairedShare = 0.01;                      // judgement: one pose in a hundred

// Why an attempt with these metrics is not to be graded, as a stable code; empty when it is. `too_short` (no time
// passed), `tracking_gaps` (over 5 % of the time), `tracking_slow` (under 60 Hz in over 5 % of the time),
// `tracking_jumps` (any that was not repaired), `tracking_repaired` (over 1 % of the poses), `way_impossible`
// (through a cut side of the CT or the table, or out of the body ahead), `quality_not_measured` (stored before
// these were). Of several versions of a metric the newest counts.
std::string why_not_gradable(std::span<const MetricValue> metrics);

}  // namespace seldinger::assessment
