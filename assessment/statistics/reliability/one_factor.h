// One factor behind several items: loadings and uniquenesses by maximum likelihood.
#pragma once

#include <optional>
#include <vector>

#include "assessment/statistics/square_matrix.h"

namespace seldinger::assessment::statistics {

struct OneFactor {
  std::vector<double> loadings;      // of standardised items; their sum is not negative
  std::vector<double> uniquenesses;  // not below kLeastUniqueness
  bool at_bound = false;             // a uniqueness stands there (a Heywood case)
  double chi_squared_per_n = 0.0;    // the discrepancy; 0: the correlations are the factor's
};
// As factanal() of R has it.
inline constexpr double kLeastUniqueness = 0.005;

// Of a positive definite correlation matrix of at least three items. Nothing: it did not converge.
std::optional<OneFactor> one_factor(const SquareMatrix& correlation);

}  // namespace seldinger::assessment::statistics
