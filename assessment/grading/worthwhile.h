// The smallest difference of a metric that is worth a word to a trainee. As a table: scores, sentences, pages and
// docs/differences.md take it from there.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "assessment/metrics/metric.h"

namespace seldinger::assessment {

struct Worthwhile {
  std::string_view what;  // a metric's id; or a unit, for every metric of it that has no row of its own
  double difference = 0.0;
  std::string_view source;  // or "judgement"
};

std::span<const Worthwhile> worthwhile_differences();
// CHECKs that there is a row for the metric or its unit; a test holds that for the whole registry.
const Worthwhile& worthwhile(const MetricInfo& metric);

// docs/differences.md.
std::string worthwhile_markdown();

}  // namespace seldinger::assessment
