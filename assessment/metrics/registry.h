// Every metric there is. A metric is one entry here and one function in a file of this folder.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "assessment/metrics/metric.h"
#include "assessment/signals.h"

namespace seldinger::assessment {

std::span<const MetricInfo> registry();

// The entry of an id; nullptr when unknown.
const MetricInfo* find_metric(const std::string& id);

// All metrics of an attempt, in the registry's order. A value that is not finite becomes null (`not_finite`).
std::vector<MetricValue> measure_all(const Signals& signals);

// docs/metrics.md, from the registry.
std::string metrics_markdown();

}  // namespace seldinger::assessment
