// A logistic model with a random intercept per person, by maximum likelihood; the integral over the intercept by
// Gauss–Hermite quadrature around its mode for each person (Pinheiro and Bates, J. Comput. Graph. Stat. 4, 1995).
#pragma once

#include <cstddef>
#include <vector>

namespace seldinger::assessment::statistics {

struct LogisticRows {
  std::vector<double> y;  // 0 or 1
  std::vector<double> x;  // `fixed` numbers a row, centred and of size 1
  std::vector<std::size_t> person;
  std::size_t fixed = 0, persons = 0;
};

struct LogisticFit {
  std::vector<double> beta;
  std::vector<std::vector<double>> covariance;  // of beta, from the observed information with the SD in it
  double sd = 0.0;                              // of the persons' intercepts
  double log_likelihood = 0.0;
};

enum class LogisticFailure { none, separated, no_convergence };
struct LogisticOutcome {
  LogisticFailure failure = LogisticFailure::none;
  LogisticFit fit;
};
LogisticOutcome fit_logistic(const LogisticRows& rows, std::size_t nodes);

}  // namespace seldinger::assessment::statistics
