#include "assessment/estimand.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string_view>
#include <vector>

namespace seldinger::assessment {
namespace {

// Nulls that say that what is measured was not reached.
constexpr std::string_view kNotReached[] = {"no_endpoint", "never_punctured", "not_in_target_structure",
                                            "not_in_tissue_at_the_end"};

const MetricValue* find_newest(std::span<const MetricValue> attempt, std::string_view id) {
  const MetricValue* newest = nullptr;
  for (const MetricValue& one : attempt)
    if (one.id == id && (newest == nullptr || one.version > newest->version)) newest = &one;
  return newest;
}

bool is(std::span<const MetricValue> attempt, std::string_view id, double value) {
  const MetricValue* found = find_newest(attempt, id);
  return found != nullptr && found->value && *found->value == value;
}

bool fired(std::span<const MetricValue> attempt) {
  return std::none_of(attempt.begin(), attempt.end(),
                      [](const MetricValue& one) { return !one.value && one.reason == "no_endpoint"; });
}

// What is performed without a trigger and without a puncture was said to be deferred.
bool deferred(std::span<const MetricValue> attempt) {
  return !fired(attempt) && is(attempt, "procedure_performed", 1.0) && is(attempt, "skin_punctures", 0.0);
}

// Whether a deferral is judged by it: by what was decided and said. A breath is held for the needle.
bool of_a_deferral(const MetricInfo& info) {
  return info.group == Group::procedure && (info.needs & kBreathes) == 0;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  if (values.size() % 2 == 1) return values[middle];
  const double low = values[middle - 1], high = values[middle];
  return low == high ? low : (low + high) / 2.0;
}

}  // namespace

bool compared(std::span<const MetricValue> attempt) {
  return !is(attempt, "procedure_performed", 0.0);
}

bool tells(const MetricInfo& info, std::span<const MetricValue> attempt) {
  return compared(attempt) && (of_a_deferral(info) || !deferred(attempt));
}

Contribution contribution_of(const MetricInfo& info, std::span<const MetricValue> attempt) {
  const auto found = std::find_if(attempt.begin(), attempt.end(), [&](const MetricValue& one) {
    return one.id == info.id && one.version == info.version;
  });
  if (found == attempt.end() || !compared(attempt)) return {};
  const WithoutEndpoint without = info.estimand.without_endpoint;
  // To defer what was to go ahead is to give it up.
  const bool spared = deferred(attempt) && !is(attempt, "decision_right", 0.0);
  if (without == WithoutEndpoint::censored && !fired(attempt))
    return spared ? Contribution{} : Contribution{Counted::censored, 0.0};
  if (found->value)
    return tells(info, attempt) && std::isfinite(*found->value) ? Contribution{Counted::value, *found->value}
                                                                : Contribution{};
  const bool missed =
      std::find(std::begin(kNotReached), std::end(kNotReached), found->reason) != std::end(kNotReached);
  if (!missed || without == WithoutEndpoint::left_out || spared) return {};
  return {without == WithoutEndpoint::failure ? Counted::failure : Counted::censored, 0.0};
}

OnePerson of_one_person(const MetricInfo& info, std::span<const Contribution> attempts) {
  const bool higher = info.direction == Direction::higher_is_better;
  const bool proportion = info.estimand.aggregation == Aggregation::proportion;
  constexpr double kFar = std::numeric_limits<double>::infinity();
  OnePerson person;
  std::vector<double> ranked;
  for (const Contribution& one : attempts) {
    if (one.counted == Counted::left_out) continue;
    if (one.counted == Counted::value) {
      ++person.values;
      ranked.push_back(one.value);
      continue;
    }
    (one.counted == Counted::failure ? person.failures : person.censored) += 1;
    if (proportion)
      ranked.push_back(higher ? 0.0 : 1.0);
    else
      ranked.push_back(higher ? -kFar : kFar);
  }
  if (ranked.empty()) return person;
  const double estimate =
      info.estimand.aggregation == Aggregation::median
          ? median(std::move(ranked))
          : std::accumulate(ranked.begin(), ranked.end(), 0.0) / static_cast<double>(ranked.size());
  person.worst = !std::isfinite(estimate);
  if (!person.worst) person.estimate = estimate;
  return person;
}

}  // namespace seldinger::assessment
