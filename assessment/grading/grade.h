// Whether an attempt passes its case's rule: every criterion met and no critical error (docs/clinical.md,
// "Passing"). Nothing buys a missed criterion back, and what has no value is never met. Computed when looked at, by
// the versions that the rule names (docs/decisions/0022).
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "assessment/grading/rule.h"
#include "assessment/metrics/metric.h"

namespace seldinger::assessment {

inline constexpr const char* kOtherVersion = "other_version";

enum class Verdict { passed, failed, not_gradable, no_rule };
std::string_view name_of(Verdict verdict) noexcept;

enum class Outcome { met, missed, not_measured };
std::string_view name_of(Outcome outcome) noexcept;

struct CriterionResult {
  Criterion criterion;
  Outcome outcome = Outcome::not_measured;
  std::optional<double> value;  // of the criterion's version of the metric
  std::string unit;             // the metric's; empty for one that is not known
  // Of not_measured, stable snake_case: the null's own reason, kOtherVersion (only other versions of the metric are
  // stored, which are not comparable), `not_stored`, `not_finite`.
  std::string reason;
  bool of_the_time_limit = false;  // the case's limit, not its rule, asks for it

  bool critical_error() const noexcept { return criterion.critical && outcome == Outcome::missed; }
};

struct Grade {
  Verdict verdict = Verdict::no_rule;
  // Why it is not gradable, with a rule or without: as why_not_gradable, how it was cut off, or kOtherVersion (all
  // is met but what is stored in another version than the rule's); empty otherwise.
  std::string reason;
  // Critical errors first, then critical ones without a value, missed ones, ones without a value, and those met;
  // within each as the rule has them. Empty without a rule; told, too, of what is not gradable.
  std::vector<CriterionResult> criteria;

  std::size_t critical_errors() const noexcept;
  std::size_t met() const noexcept;
};

// What of an attempt is graded.
struct Gradable {
  std::span<const MetricValue> metrics;  // every stored version of each
  std::string_view cut_off;  // `interrupted`, `device_lost`: it ended through no decision of the operator's, and is
                             // not gradable; empty otherwise
  std::optional<double> time_limit_s;  // the case's: over it an attempt does not pass ("time only limits")
};

// A rule without criteria is no rule, with a time limit or without.
Grade grade(const PassRule& rule, const Gradable& attempt);

// Of all versions of metrics, the one of this id and version; nullptr when it is not among them.
const MetricValue* find_version(std::span<const MetricValue> metrics, std::string_view id, int version) noexcept;

}  // namespace seldinger::assessment
