// How well a surrogate does: attempts that were simulated whole, and that it was not fitted to, held against what
// it draws for the same people. Differences are told beside what chance alone makes of so few attempts.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "assessment/population/surrogate.h"

namespace seldinger::assessment::population {

struct MetricAgreement {
  std::string metric;
  std::size_t values = 0;  // of the attempts, that are not null
  // The surrogate's minus the attempts': of the quantiles 10, 50 and 90 the largest, in standard deviations; of
  // nulls and of zeros in points of 100. Of a count they are those of grouped data, each number spread over its
  // unit: a plain quantile jumps by a whole unit where a share passes its mark.
  double quantile_sd = 0.0, quantile_error_sd = 0.0;  // and one standard error of that quantile (Woodruff 1952)
  // How far beyond .1 SD the furthest of the three quantiles is, in standard errors of the share of attempts that
  // lie below it, were the surrogate right: the sign test, for which it does not matter how densely they lie there.
  double quantile_errors = 0.0;
  double null_points = 0.0, null_error_points = 0.0;
  double zero_points = 0.0, zero_error_points = 0.0;
};
// How many are further apart than .1 SD, 3 points, .1.
struct Off {
  std::size_t quantiles = 0, shares = 0, pairs = 0;
};
struct Agreement {
  std::size_t attempts = 0, draws = 0;
  std::vector<MetricAgreement> metrics;  // those with 30 values or more
  std::size_t pairs = 0;
  double worst_rank_correlation = 0.0, rank_correlation_error = 0.0;  // of the pairs' Spearman correlations
  std::string worst_pair;
  // How many comparisons there were, and how far the furthest lies beyond .1 SD, 3 points, .1, in standard errors.
  std::size_t comparisons = 0;
  double furthest_errors = 0.0;
  // Found; and beyond by more than 3 standard errors.
  Off off, beyond_chance;
  // The same of a surrogate without fault: of kFaultless sets of as many attempts that it drew itself, for the same
  // places, the middle and the most of each. Metrics hang together, so one fluctuation moves many at once.
  static constexpr std::size_t kFaultless = 20;
  Off off_without_fault, most_off_without_fault;
  // What is left of the differences when chance is taken away, root mean square: the surrogate's own error.
  double quantile_own_sd = 0.0, rank_correlation_own = 0.0;
};
// Both are drawn for the same places.
Agreement agreement_of(const Surrogate& surrogate, std::span<const SimulatedPoint> held_out, std::size_t draws_each,
                       std::uint64_t seed);

// Whether the surrogate was fitted to one of these attempts: then they tell nothing about it.
bool was_fitted_to(const Surrogate& surrogate, std::span<const SimulatedPoint> attempts);

// How two groups of attempts that were simulated whole differ, and how what the surrogate draws for the same people
// does: more minus less.
struct EffectAgreement {
  std::string metric;
  double area = 0.5, area_error = 0.0, area_drawn = 0.5;  // under the ROC curve, with DeLong's standard error
  double d = 0.0, d_error = 0.0, d_drawn = 0.0;           // in pooled standard deviations
  double pairs = 0.0;  // Spearman's correlation of those of the same number in the two groups; 0: of too few
};
std::vector<EffectAgreement> effects_of(const Surrogate& surrogate, std::span<const SimulatedPoint> less,
                                        std::span<const SimulatedPoint> more, std::size_t draws_each,
                                        std::uint64_t seed);

}  // namespace seldinger::assessment::population
