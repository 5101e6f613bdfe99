// How well a value tells two groups apart: the area under the ROC curve, and the areas of two values on the same
// persons compared.
#pragma once

#include <span>
#include <vector>

#include "assessment/statistics/answer.h"
#include "assessment/statistics/data_table.h"
#include "assessment/statistics/procedure.h"

namespace seldinger::assessment::statistics {

// P(value of a positive > value of a negative) + ½ P(equal), with what each person adds to it (DeLong's
// components).
struct RocArea {
  double area = 0.0;
  std::vector<double> of_positive, of_negative;

  // DeLong's; both sides have two or more.
  double variance() const;
};
RocArea roc_area(std::span<const double> positive, std::span<const double> negative);
// DeLong's covariance of two areas on the same persons in the same order.
double roc_covariance(const RocArea& a, const RocArea& b);

// 95 %: logit of DeLong's; where that has no width, and at 0 and 1, Newcombe's score interval (his method 5).
Interval roc_interval(const RocArea& area);
Interval newcombe_area_interval(double area, std::size_t positive, std::size_t negative);

// Value by two groups; the option `positive` names the one that should have more.
Answer auc(const DataTable& table, const ProcedureOptions& options);
// Two values by two groups: the difference of their areas.
Answer delong(const DataTable& table, const ProcedureOptions& options);

}  // namespace seldinger::assessment::statistics
