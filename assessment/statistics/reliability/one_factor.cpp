#include "assessment/statistics/reliability/one_factor.h"

#include <algorithm>
#include <cmath>

#include "sim/base/check.h"

namespace seldinger::assessment::statistics {
namespace {

constexpr int kMostSteps = 2000;
constexpr double kFlat = 1e-11;  // of a slope

// The discrepancy once the loadings are the best for these uniquenesses (Jöreskog, Psychometrika 32, 1967), by the
// uniquenesses' logarithms.
struct Discrepancy {
  double value = 0.0;
  std::vector<double> slope;
  EigenSystem system;
};

Discrepancy discrepancy_at(const SquareMatrix& correlation, const std::vector<double>& logs) {
  const std::size_t p = correlation.n;
  SquareMatrix scaled(p);
  for (std::size_t i = 0; i < p; ++i)
    for (std::size_t j = 0; j < p; ++j)
      scaled.at(i, j) = correlation.at(i, j) * std::exp(-0.5 * (logs[i] + logs[j]));
  Discrepancy found{0.0, std::vector<double>(p), eigen_of(scaled)};
  for (std::size_t m = 1; m < p; ++m) {
    const double e = found.system.values[m];
    found.value += e - std::log(e) - 1.0;
    for (std::size_t i = 0; i < p; ++i) {
      const double u = found.system.vectors.at(i, m);
      found.slope[i] += (1.0 - e) * u * u;
    }
  }
  return found;
}

// Down the slope by what the curvature is where the factor fits, for the uniquenesses that are `free`.
std::vector<double> step_down(const Discrepancy& here, const std::vector<std::size_t>& free) {
  const std::size_t p = here.slope.size();
  SquareMatrix curvature(free.size());
  for (std::size_t a = 0; a < free.size(); ++a)
    for (std::size_t b = 0; b < free.size(); ++b) {
      double sum = 0.0;
      for (std::size_t m = 1; m < p; ++m)
        sum += here.system.vectors.at(free[a], m) * here.system.vectors.at(free[b], m);
      curvature.at(a, b) = sum * sum;
    }
  const std::optional<SquareMatrix> inverse = inverse_of(curvature);
  std::vector<double> step(p);
  for (std::size_t a = 0; a < free.size(); ++a) {
    if (!inverse) {
      step[free[a]] = -here.slope[free[a]];
      continue;
    }
    for (std::size_t b = 0; b < free.size(); ++b) step[free[a]] -= inverse->at(a, b) * here.slope[free[b]];
  }
  return step;
}

// Those that do not press against a bound.
std::vector<std::size_t> free_ones(const std::vector<double>& logs, const std::vector<double>& slope) {
  std::vector<std::size_t> free;
  for (std::size_t i = 0; i < logs.size(); ++i) {
    const bool pressed_down = logs[i] <= std::log(kLeastUniqueness) && slope[i] >= 0.0;
    const bool pressed_up = logs[i] >= 0.0 && slope[i] <= 0.0;
    if (!pressed_down && !pressed_up) free.push_back(i);
  }
  return free;
}

OneFactor factor_at(const Discrepancy& here, const std::vector<double>& logs) {
  OneFactor factor;
  factor.chi_squared_per_n = here.value;
  const double length = std::sqrt(std::max(0.0, here.system.values.front() - 1.0));
  double sum = 0.0;
  for (std::size_t i = 0; i < logs.size(); ++i) {
    factor.uniquenesses.push_back(std::exp(logs[i]));
    factor.loadings.push_back(std::exp(0.5 * logs[i]) * length * here.system.vectors.at(i, 0));
    factor.at_bound = factor.at_bound || logs[i] <= std::log(kLeastUniqueness);
    sum += factor.loadings.back();
  }
  if (sum < 0.0)
    for (double& loading : factor.loadings) loading = -loading;
  return factor;
}

}  // namespace

std::optional<OneFactor> one_factor(const SquareMatrix& correlation) {
  const std::size_t p = correlation.n;
  CHECK(p >= 3);
  const std::optional<SquareMatrix> inverse = inverse_of(correlation);
  if (!inverse) return std::nullopt;
  const double lowest = std::log(kLeastUniqueness);
  std::vector<double> logs(p);
  for (std::size_t i = 0; i < p; ++i)
    logs[i] = std::clamp(std::log((1.0 - 0.5 / static_cast<double>(p)) / inverse->at(i, i)), lowest, 0.0);
  Discrepancy here = discrepancy_at(correlation, logs);
  for (int i = 0; i < kMostSteps; ++i) {
    const std::vector<std::size_t> free = free_ones(logs, here.slope);
    const bool flat =
        std::all_of(free.begin(), free.end(), [&](std::size_t one) { return std::abs(here.slope[one]) < kFlat; });
    if (flat) return factor_at(here, logs);
    const std::vector<double> step = step_down(here, free);
    bool moved = false;
    for (double share = 1.0; share > 1e-6 && !moved; share *= 0.5) {
      std::vector<double> next = logs;
      for (std::size_t j = 0; j < p; ++j) next[j] = std::clamp(logs[j] + share * step[j], lowest, 0.0);
      Discrepancy there = discrepancy_at(correlation, next);
      // Within rounding of each other both are as good, and the step is the better judge.
      if (!(there.value <= here.value + 1e-14)) continue;
      moved = next != logs;
      logs = std::move(next);
      here = std::move(there);
    }
    if (!moved) return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace seldinger::assessment::statistics
