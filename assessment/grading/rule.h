// When an attempt passes: every criterion must be met, and one marked critical must not be missed whatever else is
// good (docs/clinical.md, "Passing"). Plain data of a case; graded elsewhere.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "assessment/signals/needs.h"
#include "sim/base/result.h"
#include "sim/case/structure.h"

namespace seldinger::assessment {

enum class Comparison { at_most, at_least, equal };

struct Criterion {
  std::string metric;  // id in the registry
  int version = 1;     // of its definition
  Comparison comparison = Comparison::equal;
  double value = 0.0;     // in the metric's unit
  bool critical = false;  // missing it is a critical error
};

struct PassRule {
  std::vector<Criterion> criteria;
};

std::string_view sign_of(Comparison comparison) noexcept;  // "<=", ">=", "="
std::optional<Comparison> comparison_from(std::string_view sign) noexcept;

// What a criterion that names no version means at a case of that law of sight; 1 of a metric that is not known.
int version_in_force(const std::string& metric, cases::SightLaw law);

// "core_in_target >= 10", and back. As text a version is told where it is not the newest ("hit@2 >= 1"); read, a
// criterion without one is of the version that is in force at a case of that law. Nothing when it is not such a
// text. What is stored names every version (rule_json.h).
std::string text_of(const Criterion& criterion);
std::optional<Criterion> criterion_from(std::string_view text, cases::SightLaw law = cases::kNewestSightLaw);

// What a case is practised with, and what it does not have of what metrics need.
struct Guidance {
  Manner manner;
  Needs absent = 0;                  // Need, or-ed: no critical structure, no planned entry, …
  std::optional<double> notch_mm{};  // of a core needle: no core is longer
  bool defer_is_right = false;
  cases::SightLaw sight_law = cases::kNewestSightLaw;
};
Needs absent_needs(std::span<const cases::Structure> structures, bool planned_entry,
                   cases::Subject subject = cases::Subject::patient);

// What a rule may name there: the ids of the metrics that can have a value.
std::vector<std::string> meaningful_metrics(const Guidance& guidance);

// What is wrong with the rule there: `unknown_metric`, `other_version`, `not_meaningful`, `twice`, `not_finite`.
std::vector<base::Problem> problems_of(const PassRule& rule, const Guidance& guidance);

}  // namespace seldinger::assessment
