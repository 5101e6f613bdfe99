// What a criterion asks for when a case's author adds it: a limit to begin with, that can be met together with a
// hit.
#pragma once

#include "assessment/grading/rule.h"
#include "assessment/metrics/metric.h"

namespace seldinger::assessment {

Criterion usual_criterion(const MetricInfo& info);

}  // namespace seldinger::assessment
