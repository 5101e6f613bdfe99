#include "assessment/statistics/growth/logistic_fit.h"

#define EIGEN_MPL2_ONLY
#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

#include "assessment/statistics/growth/gauss.h"

namespace seldinger::assessment::statistics {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMostNewtonSteps = 100, kMostHalvings = 40;
constexpr double kSettledGradient = 1e-7;
// Log odds, of columns of size 1, beyond which an outcome goes with one side throughout: odds of 10⁷.
constexpr double kSeparated = 16.0;
constexpr double kNoSd = 1e-4;
constexpr double kGradientStep = 1e-4;

double log_one_plus_exp(double v) {
  return v > 0.0 ? v + std::log1p(std::exp(-v)) : std::log1p(std::exp(v));
}
double logistic(double v) {
  return 1.0 / (1.0 + std::exp(-v));
}

// The log-likelihood and its gradient, by β and, last, by the SD; even in that.
class Likelihood {
 public:
  Likelihood(const LogisticRows& rows, std::size_t nodes)
      : rows_(rows), nodes_(gauss_hermite(nodes)), of_person_(rows.persons) {
    for (std::size_t i = 0; i < rows.y.size(); ++i) of_person_[rows.person[i]].push_back(i);
  }

  Index parameters() const { return static_cast<Index>(rows_.fixed) + 1; }

  double at(const VectorXd& parameters, VectorXd* gradient) const {
    const double sd = parameters[parameters.size() - 1];
    double sum = 0.0;
    if (gradient != nullptr) gradient->setZero(parameters.size());
    for (const std::vector<std::size_t>& own : of_person_) {
      eta_.clear();
      for (const std::size_t i : own) eta_.push_back(fixed_part(parameters, i));
      sum += of_one(own, sd, gradient);
    }
    return sum;
  }

 private:
  double fixed_part(const VectorXd& parameters, std::size_t row) const {
    double eta = 0.0;
    for (std::size_t j = 0; j < rows_.fixed; ++j)
      eta += parameters[static_cast<Index>(j)] * rows_.x[row * rows_.fixed + j];
    return eta;
  }

  // Where the integrand over z, the intercept in SDs, is greatest, and how wide it is there.
  std::pair<double, double> mode(const std::vector<std::size_t>& own, double sd) const {
    double z = 0.0, width = 1.0;
    for (int i = 0; i < kMostNewtonSteps; ++i) {
      double slope = -z, curve = 1.0;
      for (std::size_t k = 0; k < own.size(); ++k) {
        const double p = logistic(eta_[k] + sd * z);
        slope += sd * (rows_.y[own[k]] - p);
        curve += sd * sd * p * (1.0 - p);
      }
      const double step = std::clamp(slope / curve, -1.0, 1.0);
      z += step;
      width = 1.0 / std::sqrt(curve);
      if (std::abs(step) < 1e-10) break;
    }
    return {z, width};
  }

  double of_one(const std::vector<std::size_t>& own, double sd, VectorXd* gradient) const {
    const auto [centre, width] = mode(own, sd);
    logs_.clear();
    for (const double node : nodes_.at) {
      const double z = centre + width * node;
      double log = -0.5 * z * z + 0.5 * node * node;
      for (std::size_t k = 0; k < own.size(); ++k) {
        const double eta = eta_[k] + sd * z;
        log += rows_.y[own[k]] * eta - log_one_plus_exp(eta);
      }
      logs_.push_back(log);
    }
    const double most = *std::max_element(logs_.begin(), logs_.end());
    double sum = 0.0;
    for (std::size_t q = 0; q < logs_.size(); ++q) sum += nodes_.weights[q] * std::exp(logs_[q] - most);
    if (gradient != nullptr)
      for (std::size_t q = 0; q < logs_.size(); ++q)
        add_score(own, sd, centre + width * nodes_.at[q], nodes_.weights[q] * std::exp(logs_[q] - most) / sum,
                  *gradient);
    return most + std::log(width * sum);
  }

  void add_score(const std::vector<std::size_t>& own, double sd, double z, double share, VectorXd& gradient) const {
    double all = 0.0;
    for (std::size_t k = 0; k < own.size(); ++k) {
      const double left = share * (rows_.y[own[k]] - logistic(eta_[k] + sd * z));
      all += left;
      for (std::size_t j = 0; j < rows_.fixed; ++j)
        gradient[static_cast<Index>(j)] += left * rows_.x[own[k] * rows_.fixed + j];
    }
    gradient[gradient.size() - 1] += z * all;
  }

  const LogisticRows& rows_;
  Nodes nodes_;
  std::vector<std::vector<std::size_t>> of_person_;
  mutable std::vector<double> eta_, logs_;
};

// Minus the second derivatives, by differences of the gradient.
MatrixXd information(const Likelihood& of, const VectorXd& at) {
  const Index n = at.size();
  MatrixXd found(n, n);
  VectorXd above, below;
  for (Index k = 0; k < n; ++k) {
    VectorXd moved = at;
    moved[k] = at[k] + kGradientStep;
    of.at(moved, &above);
    moved[k] = at[k] - kGradientStep;
    of.at(moved, &below);
    found.col(k) = (below - above) / (2.0 * kGradientStep);
  }
  return 0.5 * (found + found.transpose());
}

// Newton's step; where the likelihood is not concave, as much of the gradient is mixed in as it takes.
VectorXd uphill(MatrixXd matrix, const VectorXd& gradient) {
  for (double mixed = 1e-3 * (1.0 + matrix.diagonal().cwiseAbs().maxCoeff());; mixed *= 10.0) {
    const Eigen::LLT<MatrixXd> cholesky(matrix);
    if (cholesky.info() == Eigen::Success) return cholesky.solve(gradient);
    if (!(mixed < 1e12)) return gradient;
    matrix.diagonal().array() += mixed;
  }
}

LogisticFit made_of(const Likelihood& of, VectorXd at, double value) {
  LogisticFit fit;
  const Index p = at.size() - 1;
  if (std::abs(at[p]) < kNoSd) at[p] = 0.0;
  MatrixXd matrix = information(of, at);
  if (at[p] == 0.0) {  // by symmetry nothing changes with it
    matrix.row(p).setZero();
    matrix.col(p).setZero();
    matrix(p, p) = 1.0;
  }
  const MatrixXd covariance = matrix.ldlt().solve(MatrixXd::Identity(p + 1, p + 1));
  fit.beta.assign(at.data(), at.data() + p);
  fit.sd = std::abs(at[p]);
  fit.log_likelihood = value;
  for (Index i = 0; i < p; ++i) {
    fit.covariance.emplace_back();
    for (Index j = 0; j < p; ++j) fit.covariance.back().push_back(covariance(i, j));
  }
  return fit;
}

}  // namespace

LogisticOutcome fit_logistic(const LogisticRows& rows, std::size_t nodes) {
  const Likelihood of(rows, nodes);
  VectorXd at = VectorXd::Zero(of.parameters()), gradient;
  at[at.size() - 1] = 1.0;
  double value = of.at(at, &gradient);
  for (int i = 0; i < kMostNewtonSteps; ++i) {
    if (!(gradient.cwiseAbs().maxCoeff() > kSettledGradient))
      return {LogisticFailure::none, made_of(of, at, value)};
    const VectorXd step = uphill(information(of, at), gradient);
    double share = std::min(1.0, 3.0 / step.cwiseAbs().maxCoeff());
    VectorXd next = at;
    double reached = value;
    for (int k = 0; k < kMostHalvings; ++k, share *= 0.5) {
      next = at + share * step;
      reached = of.at(next, nullptr);
      if (reached > value) break;
    }
    // No step leads up any more, to the last digit: this is the top.
    if (!(reached > value)) {
      const bool at_top = gradient.cwiseAbs().maxCoeff() < 1e-3;
      return at_top ? LogisticOutcome{LogisticFailure::none, made_of(of, at, value)}
                    : LogisticOutcome{LogisticFailure::no_convergence, {}};
    }
    at = next;
    value = of.at(at, &gradient);
    if (at.cwiseAbs().maxCoeff() > kSeparated) return {LogisticFailure::separated, {}};
  }
  return {LogisticFailure::no_convergence, {}};
}

}  // namespace seldinger::assessment::statistics
