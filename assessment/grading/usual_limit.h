// What a criterion asks for when a case's author adds it: a limit to begin with, that can be met together with a
// hit.
#pragma once

#include "assessment/grading/rule.h"
#include "assessment/metrics/metric.h"

namespace seldinger::assessment {

// Of the version that a case of that law measures.
Criterion usual_criterion(const MetricInfo& info, cases::SightLaw law = cases::kNewestSightLaw);

}  // namespace seldinger::assessment
