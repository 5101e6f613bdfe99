// Rasch's models by conditional maximum likelihood: given a person's score the answers do not depend on ability, so
// that difficulties are estimated without any assumption on it (Andersen, J. R. Stat. Soc. B 32, 1970; the linear
// form: Fischer and Ponocny, Psychometrika 59, 1994).
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace seldinger::assessment::statistics {

// The probability of score h in cell c is as exp(h·ability + Σₖ weights[c][h−1][k]·ηₖ), of score 0 as 1.
struct ScoreModel {
  std::vector<std::vector<std::vector<double>>> weights;
  std::size_t parameters = 0;

  // log of what the score's probability is as, less h·ability; from score 0.
  std::vector<std::vector<double>> logs(const std::vector<double>& eta) const;
};

struct ConditionalFit {
  std::vector<double> eta;
  std::vector<std::vector<double>> covariance;
  double log_likelihood = 0.0;
};

// `scores` of each person for each cell, −1: none. Nothing: a parameter has no bound, or cannot be told from
// others.
std::optional<ConditionalFit> fit_conditional(const ScoreModel& model, const std::vector<std::vector<int>>& scores);

}  // namespace seldinger::assessment::statistics
