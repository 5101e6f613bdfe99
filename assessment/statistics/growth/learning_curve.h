// How a value changes with practice: the power law y = a·t^−b + c and the exponential y = a·exp(−b·t) + c.
#pragma once

#include <optional>
#include <span>

#include "assessment/statistics/answer.h"
#include "assessment/statistics/data_table.h"

namespace seldinger::assessment::statistics {

enum class CurveKind { power, exponential };

struct LearningCurve {
  CurveKind kind = CurveKind::power;
  double a = 0.0, b = 0.0, c = 0.0;  // c: the plateau, a: what there is to lose on the way to it at t = 1 or 0
  double rss = 0.0;
  std::optional<double> aicc;  // from 6 attempts
  // Standard errors by the curve's tangent; NaN where the three cannot be told apart.
  double se_a = 0.0, se_b = 0.0, se_c = 0.0;
  bool at_bound = false;  // b is as large or as small as it may be: there is no such curve in these values
};

// The curve of least squares, |b| up to 8; of an exponential, b·(greatest t) up to as many as there are different
// t, 8 to 100. Nothing: fewer than five values, less than four different t, or values that do not vary; for the
// power law also t below 1e-9.
std::optional<LearningCurve> fit_curve(CurveKind kind, std::span<const double> t, std::span<const double> y);

// Of the two the one with the smaller sum of squares.
std::optional<LearningCurve> better_curve(std::span<const double> t, std::span<const double> y);
double value_at(const LearningCurve& curve, double t);

inline constexpr std::size_t kLeastAttempts = 5;

struct LearningCurveOptions {
  bool higher_is_better = false;
  double closed = 0.9;  // of the way from the first attempt to the plateau that counts as having arrived
};
// Said in place of when the plateau is reached, where that would be before the second attempt: the first one
// differs, and nothing lies on the way.
inline constexpr const char* kTooSudden =
    "The change lies between the first attempts and is faster than attempts can show: no course of learning is "
    "told.";
// One person: both curves. Several: the better curve of each, and the median of their rates.
Answer learning_curve(const DataTable& table, const LearningCurveOptions& options);

}  // namespace seldinger::assessment::statistics
