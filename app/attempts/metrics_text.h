// Metrics for the terminal.
#pragma once

#include <vector>

#include "assessment/metrics/metric.h"

namespace seldinger::app {

void print_metrics(const std::vector<assessment::MetricValue>& metrics);

}  // namespace seldinger::app
