// Every metric there is. A metric is one row in a table of this folder and the function beside it (tables.h).
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "assessment/metrics/metric.h"
#include "assessment/signals/signals.h"

namespace seldinger::assessment {

std::span<const MetricInfo> registry();

// The entry of an id; nullptr when unknown.
const MetricInfo* find_metric(const std::string& id);

// What it is where pictures were told by that law of sight.
int version_of(const MetricInfo& info, cases::SightLaw law) noexcept;

// All metrics of an attempt, in the registry's order. A value that is not finite becomes null (`not_finite`).
std::vector<MetricValue> measure_all(const Signals& signals);

// Whether a stored value could be one, practising in this manner. An id that is not known any more is shown.
bool applies(const MetricValue& metric, const Manner& manner);

// As documents, exports and pages write them: "ratio", "left out", "median".
std::string_view words(Scale scale) noexcept;
std::string_view words(WithoutEndpoint without) noexcept;
std::string_view words(Aggregation aggregation) noexcept;

// docs/metrics.md, from the registry.
std::string metrics_markdown();

}  // namespace seldinger::assessment
