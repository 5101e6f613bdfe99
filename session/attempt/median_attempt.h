// Which of several attempts at one task stands for all of them.
#pragma once

#include <cstddef>
#include <vector>

#include "assessment/metrics/metric.h"

namespace seldinger::session {

// The index of the attempt that is as most are in `hit`, and among those is nearest the middle: the sum over all
// metrics of how many ranks its value is off the middle one, equal values sharing theirs, is least; of equals the
// first. Without unit or weight, so that no metric decides alone. A metric that has no value in some attempts ranks
// those behind the others. CHECKs that there is one.
std::size_t index_of_median(const std::vector<std::vector<assessment::MetricValue>>& attempts);

}  // namespace seldinger::session
