// What one attempt's metric says when people are compared, and what a person's attempts say together: the rows'
// estimands, applied (ICH E9(R1), 2019).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "assessment/metrics/metric.h"

namespace seldinger::assessment {

// Beside the metric that is asked for, what decides how an attempt counts: these, and whether any metric has no
// value for want of an endpoint.
inline constexpr std::string_view kMetricsThatCount[] = {"procedure_performed", "skin_punctures", "decision_right"};

// Whether an attempt counts among those that are compared: it was performed, or nobody measured whether (stored
// before procedure_performed was).
bool compared(std::span<const MetricValue> attempt);

// Whether its value of the metric is of anything that was done: who parks has performed nothing, and who defers has
// the best value of whatever counts errors of a puncture.
bool tells(const MetricInfo& info, std::span<const MetricValue> attempt);

enum class Counted : std::uint8_t {
  left_out,  // it says nothing
  value,
  failure,   // the worst there is: neither fired nor rightly deferred, or what is measured was never reached
  censored,  // it was still running: longer than any that ended
};
struct Contribution {
  Counted counted = Counted::left_out;
  double value = 0.0;  // of Counted::value
};
// Of the metric as it is measured now, among all that is stored of one attempt.
Contribution contribution_of(const MetricInfo& info, std::span<const MetricValue> attempt);

// A person's attempts as one value.
struct OnePerson {
  std::size_t values = 0, failures = 0, censored = 0;
  std::optional<double> estimate;  // nothing: there is no value, or it lies among the failures
  bool worst = false;              // it lies among the failures or the censored: worse than any value
};
OnePerson of_one_person(const MetricInfo& info, std::span<const Contribution> attempts);

}  // namespace seldinger::assessment
