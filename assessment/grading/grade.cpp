#include "assessment/grading/grade.h"

#include <algorithm>
#include <cmath>

#include "assessment/metrics/quality.h"
#include "assessment/registry.h"

namespace seldinger::assessment {
namespace {

constexpr std::string_view kVerdicts[] = {"passed", "failed", "not_gradable", "no_rule"};  // as Verdict
constexpr std::string_view kOutcomes[] = {"met", "missed", "not_measured"};                // as Outcome

// Fails on NaN, whichever way it compares.
bool holds(double value, Comparison comparison, double limit) {
  switch (comparison) {
    case Comparison::at_most:
      return value <= limit;
    case Comparison::at_least:
      return value >= limit;
    case Comparison::equal:
      return value == limit;
  }
  return false;
}

CriterionResult result_of(const Criterion& criterion, std::span<const MetricValue> metrics) {
  CriterionResult result;
  result.criterion = criterion;
  if (const MetricInfo* info = find_metric(criterion.metric)) result.unit = info->unit;
  const MetricValue* found = find_version(metrics, criterion.metric, criterion.version);
  if (found == nullptr) {
    const bool other =
        std::any_of(metrics.begin(), metrics.end(), [&](const auto& m) { return m.id == criterion.metric; });
    result.reason = other ? kOtherVersion : "not_stored";
    return result;
  }
  result.unit = found->unit;
  if (!found->value) {
    result.reason = found->reason.empty() ? "no_reason_stored" : found->reason;
  } else if (!std::isfinite(*found->value)) {
    result.reason = "not_finite";
  } else {
    result.value = found->value;
    result.outcome = holds(*found->value, criterion.comparison, criterion.value) ? Outcome::met : Outcome::missed;
  }
  return result;
}

int place_of(const CriterionResult& one) {
  const int critical = one.criterion.critical ? 0 : 1;
  switch (one.outcome) {
    case Outcome::missed:
      return 2 * critical;
    case Outcome::not_measured:
      return 2 * critical + 1;
    case Outcome::met:
      return 4;
  }
  return 4;
}

}  // namespace

std::string_view name_of(Verdict verdict) noexcept {
  return kVerdicts[static_cast<std::size_t>(verdict)];
}

std::string_view name_of(Outcome outcome) noexcept {
  return kOutcomes[static_cast<std::size_t>(outcome)];
}

std::size_t Grade::critical_errors() const noexcept {
  return static_cast<std::size_t>(
      std::count_if(criteria.begin(), criteria.end(), [](const auto& one) { return one.critical_error(); }));
}

std::size_t Grade::met() const noexcept {
  return static_cast<std::size_t>(
      std::count_if(criteria.begin(), criteria.end(), [](const auto& one) { return one.outcome == Outcome::met; }));
}

const MetricValue* find_version(std::span<const MetricValue> metrics, std::string_view id, int version) noexcept {
  const auto found = std::find_if(metrics.begin(), metrics.end(),
                                  [&](const MetricValue& m) { return m.id == id && m.version == version; });
  return found == metrics.end() ? nullptr : &*found;
}

Grade grade(const PassRule& rule, const Gradable& attempt) {
  Grade made;
  made.reason = attempt.cut_off.empty() ? why_not_gradable(attempt.metrics) : std::string(attempt.cut_off);
  if (rule.criteria.empty()) return made;
  for (const Criterion& criterion : rule.criteria) made.criteria.push_back(result_of(criterion, attempt.metrics));
  if (attempt.time_limit_s) {
    // A limit names no version: the newest that is stored.
    Criterion limit{"time_total", 1, Comparison::at_most, *attempt.time_limit_s, false};
    for (const MetricValue& metric : attempt.metrics)
      if (metric.id == limit.metric) limit.version = std::max(limit.version, metric.version);
    made.criteria.push_back(result_of(limit, attempt.metrics));
    made.criteria.back().of_the_time_limit = true;
  }
  std::stable_sort(made.criteria.begin(), made.criteria.end(),
                   [](const auto& a, const auto& b) { return place_of(a) < place_of(b); });
  // Nothing is told of a criterion of another version; what is not met fails the attempt whatever that would be.
  const std::size_t not_comparable = static_cast<std::size_t>(std::count_if(
      made.criteria.begin(), made.criteria.end(), [](const auto& one) { return one.reason == kOtherVersion; }));
  const bool all_others_met = made.met() + not_comparable == made.criteria.size();
  if (made.reason.empty() && not_comparable > 0 && all_others_met) made.reason = kOtherVersion;
  if (!made.reason.empty())
    made.verdict = Verdict::not_gradable;
  else
    made.verdict = all_others_met ? Verdict::passed : Verdict::failed;
  return made;
}

}  // namespace seldinger::assessment
