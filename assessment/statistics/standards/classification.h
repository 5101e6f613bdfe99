// How far a cut's decisions can be relied on: how often a second, equivalent test would decide the same, and how
// often the decision is right (Peng, Subkoviak, J. Educ. Meas. 17, 1980: Subkoviak's indices with normal scores).
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "assessment/statistics/answer.h"

namespace seldinger::assessment::statistics {

// Share below h in the one and below k in the other of two standard normal variables with the correlation rho.
double bivariate_normal_cdf(double h, double k, double rho);

struct Classification {
  double consistency = 0.0;  // two tests decide the same
  double kappa = 0.0;        // beyond chance
  double accuracy = 0.0;     // decided as the true score would be
  double false_pass = 0.0, false_fail = 0.0;
  double pass = 0.0;
};
// Of normal scores with mean, standard deviation (above 0) and reliability (above 0, below 1); the cut or more
// passes.
Classification classification_of(double mean, double sd, double reliability, double cut);

struct CutScores {
  std::vector<double> scores;  // of persons
  std::size_t missing = 0;
  double cut = 0.0;
  double reliability = 0.0;  // of these scores: alpha, Φ, an ICC
  bool higher_is_better = true;
  // Ends of the scale: with them it is Livingston and Lewis' way, without Peng and Subkoviak's.
  std::optional<Interval> ends{};
};
// The interval: of where the cut stands in the scores, by the non-central t, with the reliability as it is; with
// `ends` there is none.
Answer classification(const CutScores& of);

}  // namespace seldinger::assessment::statistics
