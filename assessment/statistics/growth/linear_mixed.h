// A linear mixed model by REML: fixed effects, and of each person an intercept, or an intercept and a slope, from a
// normal distribution. The criterion is profiled over the Cholesky factor of the relative covariance, as in Bates
// et al., J. Stat. Softw. 67, 2015, person by person: nothing larger than the fixed effects is ever factorised.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace seldinger::assessment::statistics {

// One row for each value. Columns should be centred and of size 1: normal equations lose digits otherwise.
struct MixedRows {
  std::vector<double> y;
  std::vector<double> x;            // `fixed` numbers a row
  std::vector<double> slope;        // of each row, what the random slope multiplies; empty: random intercepts alone
  std::vector<std::size_t> person;  // from 0
  std::size_t fixed = 0, persons = 0;
};

struct MixedFit {
  std::vector<double> beta;
  double sigma = 0.0;                      // of the residuals
  double criterion = 0.0;                  // −2 log of the restricted likelihood
  double l11 = 0.0, l21 = 0.0, l22 = 0.0;  // relative factor: covariance of a person's effects = sigma²·L·Lᵀ
  bool singular = false;                   // a variance of them is 0, or they are perfectly correlated

  // Of a sum of fixed effects with such weights.
  struct Contrast {
    double value = 0.0, se = 0.0, df = 0.0;  // Satterthwaite's
  };
  std::vector<Contrast> contrasts;
};

// Nothing: fixed effects that cannot be told apart, or no residual variation. `contrasts` are rows of weights.
std::optional<MixedFit> fit_mixed(const MixedRows& rows, const std::vector<std::vector<double>>& contrasts);

}  // namespace seldinger::assessment::statistics
