// Time until an event, where some were not followed to theirs: survival curves, their comparison, and the mean time
// up to a horizon. Who gives up is censored then.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "assessment/statistics/answer.h"
#include "assessment/statistics/data_table.h"
#include "assessment/statistics/procedure.h"

namespace seldinger::assessment::statistics {

struct Followed {
  double time = 0.0;
  bool event = false;
};

// At one time with an event. Greenwood's standard error; 95 % by log(−log). At survival 0, where there is none, low
// is 0 and high is what it was before.
struct SurvivalStep {
  double time = 0.0;
  std::size_t at_risk = 0, events = 0;
  double survival = 1.0, standard_error = 0.0;
  Interval ci95;
};
std::vector<SurvivalStep> kaplan_meier_of(std::vector<Followed> persons);

// Where the curve, and the limits of its interval, first come to one half; nothing where they do not.
struct MedianTime {
  std::optional<double> time, low, high;
};
MedianTime median_time(std::span<const SurvivalStep> steps, double last_followed);

// The area under the curve up to tau.
struct RestrictedMean {
  double mean = 0.0, standard_error = 0.0;
};
RestrictedMean restricted_mean(std::span<const SurvivalStep> steps, double tau);

struct LogRank {
  double chi_squared = 0.0;
  std::vector<double> observed, expected;
  double variance = 0.0;  // of the first group's events, when there are two
  std::size_t df = 0;     // 0: at no event are two groups at risk
};
LogRank log_rank_of(std::span<const std::vector<Followed>> groups);

// Value: time; x: 1 event, 0 censored.
Answer kaplan_meier(const DataTable& table, const ProcedureOptions& options);
Answer log_rank(const DataTable& table, const ProcedureOptions& options);
Answer rmst(const DataTable& table, const ProcedureOptions& options);

}  // namespace seldinger::assessment::statistics
