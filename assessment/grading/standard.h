// What consultants do on a task: the named set of their attempts, the band of each metric, and a score against it
// that stands beside a grade and changes nothing of it. Who counts as a consultant, and which set is the standard,
// is the library's to say (casedb/grading/standards.h); simulated operators never set one (docs/clinical.md,
// "Passing").
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "assessment/grading/grade.h"

namespace seldinger::assessment {

// docs/clinical.md, "Passing": provisional until 8 consultants have made their attempts on a case.
constexpr std::size_t kStandardConsultants = 8;
// Of each consultant's completed attempts the last three count, once there are five: the first ones are spent on
// getting used to the simulator. Judgement.
constexpr std::size_t kFamiliarAttempts = 5, kCountedAttempts = 3;
// A tolerance interval holds this share of consultants with this confidence.
constexpr double kToleranceShare = 0.9, kToleranceConfidence = 0.95;

// Whose attempts: numbers come from consultants only, a replay to watch from the simulated expert too.
enum class SetKind { consultants, simulated };

// One attempt of somebody whose values may enter.
struct ExpertAttempt {
  std::string attempt_id, person_id;
  std::int64_t started_us = 0;
  std::vector<MetricValue> metrics;  // every stored version
  bool completed = true;             // not given up, cut off or out of time
};

struct Interval {
  double low = 0.0, high = 0.0;
};

// Over one value a person, as the metric's estimand has it of the attempts that count (estimand.h), so that who
// attempts more counts no more.
struct MetricBand {
  std::string id, unit;
  int version = 1;
  std::size_t n = 0;             // people
  double low = 0.0, high = 0.0;  // 10th and 90th percentile, type 7 of Hyndman and Fan (Am. Stat. 50, 1996, 361)
  double mean = 0.0, sd = 0.0;   // sd over n − 1
  // Where kToleranceShare of all consultants lie, with kToleranceConfidence, were they normal (tolerance.h); within
  // what the metric can be. None: of a yes and no.
  std::optional<Interval> tolerance{};
};

struct ExpertSet {
  std::string id;                        // tells whether two scores were against the same values; empty: none
  std::string standard_id;               // the stored standard's; empty: nobody has made it one
  std::int64_t set_us = 0;               // when the standard was set
  std::int64_t newest_us = 0;            // when its last attempt began
  std::size_t people = 0, attempts = 0;  // stay when an attempt is erased
  std::vector<std::string> attempt_ids;  // sorted
  std::vector<std::string> person_ids;   // sorted
  std::vector<MetricBand> bands;         // in the registry's order; empty under kStandardConsultants people

  bool standard() const noexcept { return !standard_id.empty(); }
  bool enough_people() const noexcept { return people >= kStandardConsultants; }
  const MetricBand* find(std::string_view metric, int version) const noexcept;
  // Whether it has the metric, but not in this version: neither is held against the other.
  bool only_other_version(std::string_view metric, int version) const noexcept;
};

// The set of those with kFamiliarAttempts completed and gradable attempts, of the last kCountedAttempts of each, by
// what version of a metric is in force. A metric has a band where kStandardConsultants people have a value.
ExpertSet expert_set(std::vector<ExpertAttempt> attempts);

// The quantile of sorted values, 0 ≤ p ≤ 1, type 7: linear between the order statistics around (n − 1) p.
double quantile(std::span<const double> sorted, double p);

// --- score ------------------------------------------------------------------------------------------------------
inline constexpr std::string_view kScoreFormula =
    "50 + 50/3 times the mean over the metrics of z, where z = (value - mean) / sd of the standard's consultants, "
    "sd no "
    "less than the metric's smallest worthwhile difference, signed so that better is more, between -3 and 3; every "
    "metric weighs the same; how long the attempt took is not among them; 0 with a critical error";

struct ScorePart {
  std::string id, unit;
  int version = 1;
  std::optional<double> value, z;
  std::string reason;           // without a z
  double mean = 0.0, sd = 0.0;  // of the set
  double least_sd = 0.0;        // the smallest worthwhile difference: z takes sd for no less
};

struct Score {
  std::optional<double> value;  // 0 to 100; 50 is what the set's people do on average
  // Null: why it is not gradable (grade.h), `no_expert_set` (no standard), `of_the_set` (its person set the
  // standard), `missing_metric` (never weighted anew), `other_version` (a metric is stored in another version than
  // the standard's). Beside a value: `critical_error` or empty.
  std::string reason;
  std::string set_id;
  std::vector<ScorePart> parts;
};

// `person_id`: whose attempt; empty for nobody's.
Score score(const ExpertSet& set, const Grade& grade, const Gradable& attempt, std::string_view person_id);

// What a score is made of where it applies: few, since many metrics of one aspect would weigh it many times. How
// long the attempt took is not among them: speed never buys back a blind advance (docs/clinical.md, "Passing").
std::span<const std::string_view> scored_metrics();

}  // namespace seldinger::assessment
