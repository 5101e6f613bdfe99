#include "assessment/statistics/growth/rasch/conditional_likelihood.h"

#define EIGEN_MPL2_ONLY
#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace seldinger::assessment::statistics {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMostSteps = 60;
constexpr double kMostLogit = 12.0;  // further apart nothing was ever measured: there is no bound
constexpr double kLeastInformation = 1e-9;
constexpr double kDifference = 1e-4;

// Persons with the same cells and the same total.
struct Alike {
  std::vector<std::size_t> cells;
  std::vector<double> persons;  // by total score
};

class Conditional {
 public:
  Conditional(const ScoreModel& model, const std::vector<std::vector<int>>& scores)
      : model_(model), observed_(VectorXd::Zero(static_cast<Index>(model.parameters))) {
    std::map<std::vector<std::size_t>, std::vector<double>> by_cells;
    for (const std::vector<int>& own : scores) {
      std::vector<std::size_t> cells;
      std::size_t total = 0, most = 0;
      for (std::size_t c = 0; c < own.size(); ++c) {
        if (own[c] < 0) continue;
        cells.push_back(c);
        total += static_cast<std::size_t>(own[c]);
        most += model.weights[c].size();
      }
      if (total == 0 || total == most) continue;  // certain, given the total
      auto& persons = by_cells[cells];
      persons.resize(most + 1);
      persons[total] += 1.0;
      for (const std::size_t c : cells)
        if (own[c] > 0) add(observed_, c, static_cast<std::size_t>(own[c]), 1.0);
    }
    for (auto& [cells, persons] : by_cells) alike_.push_back({cells, std::move(persons)});
  }

  bool empty() const { return alike_.empty(); }

  double at(const VectorXd& eta, VectorXd& gradient) const {
    const std::vector<double> values(eta.data(), eta.data() + eta.size());
    epsilon_ = model_.logs(values);
    for (auto& cell : epsilon_)
      for (double& one : cell) one = std::exp(one);
    gradient = observed_;
    double sum = observed_.dot(eta);
    for (const Alike& one : alike_) sum -= of_alike(one, gradient);
    return sum;
  }

 private:
  void add(VectorXd& to, std::size_t cell, std::size_t score, double times) const {
    const std::vector<double>& weights = model_.weights[cell][score - 1];
    for (std::size_t k = 0; k < weights.size(); ++k) to[static_cast<Index>(k)] += times * weights[k];
  }

  // Σ log γ over these persons, γ of a total being the sum of products over all ways to it: built cell by cell, and
  // taken back cell by cell for how often each score is expected.
  double of_alike(const Alike& alike, VectorXd& gradient) const {
    std::vector<std::vector<double>> built{{1.0}};
    for (const std::size_t c : alike.cells) {
      const std::vector<double>& before = built.back();
      std::vector<double> after(before.size() + epsilon_[c].size() - 1);
      for (std::size_t h = 0; h < epsilon_[c].size(); ++h)
        for (std::size_t r = 0; r < before.size(); ++r) after[r + h] += epsilon_[c][h] * before[r];
      built.push_back(std::move(after));
    }
    double sum = 0.0;
    std::vector<double> back(built.back().size());
    for (std::size_t r = 0; r < back.size(); ++r) {
      if (alike.persons[r] == 0.0) continue;
      sum += alike.persons[r] * std::log(built.back()[r]);
      back[r] = alike.persons[r] / built.back()[r];
    }
    for (std::size_t k = alike.cells.size(); k-- > 0;) {
      const std::size_t c = alike.cells[k];
      const std::vector<double>& before = built[k];
      std::vector<double> further(before.size());
      for (std::size_t h = 0; h < epsilon_[c].size(); ++h) {
        double expected = 0.0;
        for (std::size_t r = 0; r < before.size(); ++r) {
          expected += before[r] * back[r + h];
          further[r] += epsilon_[c][h] * back[r + h];
        }
        if (h > 0) add(gradient, c, h, -epsilon_[c][h] * expected);
      }
      back = std::move(further);
    }
    return sum;
  }

  const ScoreModel& model_;
  VectorXd observed_;
  std::vector<Alike> alike_;
  mutable std::vector<std::vector<double>> epsilon_;
};

MatrixXd information_of(const Conditional& of, const VectorXd& at) {
  MatrixXd found(at.size(), at.size());
  VectorXd above, below;
  for (Index k = 0; k < at.size(); ++k) {
    VectorXd moved = at;
    moved[k] = at[k] + kDifference;
    of.at(moved, above);
    moved[k] = at[k] - kDifference;
    of.at(moved, below);
    found.col(k) = (below - above) / (2.0 * kDifference);
  }
  return 0.5 * (found + found.transpose());
}

ConditionalFit fit_at(const VectorXd& at, const MatrixXd& covariance, double value) {
  ConditionalFit fit;
  fit.log_likelihood = value;
  fit.eta.assign(at.data(), at.data() + at.size());
  for (Index i = 0; i < at.size(); ++i) {
    const VectorXd row = covariance.row(i);
    fit.covariance.emplace_back(row.data(), row.data() + row.size());
  }
  return fit;
}

}  // namespace

std::vector<std::vector<double>> ScoreModel::logs(const std::vector<double>& eta) const {
  std::vector<std::vector<double>> all;
  for (const auto& cell : weights) {
    all.push_back({0.0});
    for (const std::vector<double>& score : cell) {
      double sum = 0.0;
      for (std::size_t k = 0; k < score.size(); ++k) sum += score[k] * eta[k];
      all.back().push_back(sum);
    }
  }
  return all;
}

// The likelihood is concave: Newton's steps, halved where they go too far, find its only top.
std::optional<ConditionalFit> fit_conditional(const ScoreModel& model,
                                              const std::vector<std::vector<int>>& scores) {
  const Conditional of(model, scores);
  if (of.empty() || model.parameters == 0) return std::nullopt;
  VectorXd at = VectorXd::Zero(static_cast<Index>(model.parameters)), gradient;
  double value = of.at(at, gradient);
  for (int i = 0; i < kMostSteps; ++i) {
    const MatrixXd information = information_of(of, at);
    const Eigen::LLT<MatrixXd> cholesky(information);
    if (cholesky.info() != Eigen::Success || !(cholesky.rcond() > kLeastInformation)) return std::nullopt;
    VectorXd step = cholesky.solve(gradient);
    if (step.cwiseAbs().maxCoeff() < 1e-9)
      return fit_at(at, cholesky.solve(MatrixXd::Identity(at.size(), at.size())), value);
    step *= std::min(1.0, 2.0 / step.cwiseAbs().maxCoeff());
    VectorXd next_gradient;
    double next = of.at(at + step, next_gradient);
    for (int k = 0; k < 30 && !(next >= value - 1e-10 * std::abs(value)); ++k) {
      step *= 0.5;
      next = of.at(at + step, next_gradient);
    }
    if (!std::isfinite(next)) return std::nullopt;
    at += step;
    value = next;
    gradient = next_gradient;
    if (at.cwiseAbs().maxCoeff() > kMostLogit) return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace seldinger::assessment::statistics
