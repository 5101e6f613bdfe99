// What consultants do on a case: the named set of their attempts, the band of each metric, and a score against it
// that stands beside a grade and changes nothing of it. Who counts as a consultant is the library's to say
// (casedb/standards.h); simulated operators never set a standard (clinical.md, "Passing").
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "assessment/grading/grade.h"

namespace seldinger::assessment {

// clinical.md: provisional "until at least 8 consultants have 3 attempts each on a case".
constexpr std::size_t kStandardConsultants = 8, kStandardAttempts = 3;
// Of fewer people nothing is shown: a band would tell one reader what one colleague did (assessment.md §4, k = 5).
constexpr std::size_t kLeastShown = 5;

// One gradable attempt of somebody whose values may enter.
struct ExpertAttempt {
  std::string attempt_id, person_id;
  std::int64_t started_us = 0;
  std::vector<MetricValue> metrics;  // every stored version
};

// Over each person's median: of that person's attempts, so that who attempts more counts no more.
struct MetricBand {
  std::string id, unit;
  int version = 1;
  std::size_t n = 0;             // people
  double low = 0.0, high = 0.0;  // 10th and 90th percentile, type 7 of Hyndman and Fan (Am. Stat. 50, 1996, 361)
  double mean = 0.0, sd = 0.0;   // sd over n − 1
};

enum class SetKind { consultants, simulated };

struct ExpertSet {
  SetKind kind = SetKind::consultants;
  std::string id;                        // tells whether two scores were against the same attempts; empty: none
  std::int64_t newest_us = 0;            // when its last attempt began
  std::vector<std::string> attempt_ids;  // sorted
  std::vector<std::string> person_ids;   // sorted; of a simulated set its attempts': each seed is one
  std::vector<MetricBand> bands;         // in the registry's order; empty under kLeastShown people

  bool standard() const noexcept {
    return kind == SetKind::consultants && person_ids.size() >= kStandardConsultants;
  }
  const MetricBand* find(std::string_view metric, int version) const noexcept;
};

// The set of those with at least three such attempts (of a simulated one: of all), by what version of a metric is
// in force. Only values that everybody in the set has make a band.
ExpertSet expert_set(SetKind kind, std::vector<ExpertAttempt> attempts);

// The quantile of sorted values, 0 ≤ p ≤ 1, type 7: linear between the order statistics around (n − 1) p.
double quantile(std::span<const double> sorted, double p);

// --- score ------------------------------------------------------------------------------------------------------
inline constexpr std::string_view kScoreFormula =
    "50 + 50/3 times the mean over the metrics of z, where z = (value - mean) / sd of the set's consultants, "
    "signed so "
    "that better is more, between -3 and 3; every metric weighs the same; 0 with a critical error";

struct ScorePart {
  std::string id, unit;
  int version = 1;
  std::optional<double> value, z;
  std::string reason;           // without a z
  double mean = 0.0, sd = 0.0;  // of the set
};

struct Score {
  std::optional<double> value;  // 0 to 100; 50 is what the set's people do on average
  // Null: why it is not gradable (grade.h), `no_expert_set`, `of_the_set` (its person set the standard),
  // `missing_metric` (never weighted anew), `no_spread`. Beside a value: `critical_error` or empty.
  std::string reason;
  std::string set_id;
  std::vector<ScorePart> parts;  // those with mean and sd, and what has none for want of spread
};

// `person_id`: whose attempt; empty for nobody's.
Score score(const ExpertSet& set, const Grade& grade, const Gradable& attempt, std::string_view person_id);

// What a score is made of where it applies: few, since many metrics of one aspect would weigh it many times.
std::span<const std::string_view> scored_metrics();

}  // namespace seldinger::assessment
