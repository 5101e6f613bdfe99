// What a recording of an attempt at a case is worth: its signals, its metrics, and what became of each step.
#pragma once

#include <vector>

#include "assessment/metrics/metric.h"
#include "assessment/procedure/steps.h"
#include "assessment/signals/signals.h"
#include "sim/base/result.h"
#include "sim/case/case.h"
#include "sim/case/record/recording.h"

namespace seldinger::assessment {

// What metrics measure of a recording made in this scene, which must outlive it. Refused as make_signals.
base::Result<Signals> signals_of(const cases::Case& scene, const cases::Recording& recording);

struct Scored {
  std::vector<MetricValue> metrics;
  std::vector<StepResult> steps;
};
Scored score(const Signals& signals);
base::Result<Scored> score(const cases::Case& scene, const cases::Recording& recording);

// The metrics alone.
base::Result<std::vector<MetricValue>> measure(const cases::Case& scene, const cases::Recording& recording);

}  // namespace seldinger::assessment
