#include "sim/haptics/fit/least_squares.h"

#define EIGEN_MPL2_ONLY
#include <Eigen/QR>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <limits>

namespace seldinger::haptics {
namespace {

constexpr int kMostSteps = 300;
constexpr double kSettled = 1e-12;  // relative, of squares and of parameters; absolute, of the gradient
// Damping and its rule: H. B. Nielsen, Damping parameter in Marquardt's method, IMM-REP-1999-05, DTU 1999, eq. 2.4.
constexpr double kFirstDamping = 1e-4, kMostDamping = 1e32;
// Of the decrease that the tangent foretold, what makes a step worth taking (Nocedal & Wright, Numerical
// Optimization, 2nd ed., algorithm 4.1).
constexpr double kWorthTaking = 1e-3;
// A parameter without influence keeps this much of a scale: else the step along it has no limit.
constexpr double kLeastScale = 1e-6;
// Singular values below this share of the greatest are rounding: the root of a double's epsilon.
constexpr double kLeastSingular = 1.5e-8;

using Jacobian = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Eigen::Index;
using Eigen::VectorXd;

Eigen::Map<const VectorXd> vector_of(const std::vector<double>& values) {
  return {values.data(), static_cast<Index>(values.size())};
}

// Those that a step downhill may move: within their bounds, or at one that the step leads away from.
std::vector<Index> free_of(const VectorXd& at, const VectorXd& gradient, const Bounds& bounds) {
  std::vector<Index> free;
  for (Index i = 0; i < at.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (at[i] <= bounds.least[k] && gradient[i] > 0.0) continue;
    if (at[i] >= bounds.most[k] && gradient[i] < 0.0) continue;
    free.push_back(i);
  }
  return free;
}

// Of the free parameters, the step that is least squares of tangent and damping together; 0 of the others.
VectorXd damped_step(const Jacobian& jacobian, const VectorXd& residuals, const std::vector<Index>& free,
                     double damping) {
  const Index rows = jacobian.rows(), columns = static_cast<Index>(free.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(rows + columns, columns);
  VectorXd right = VectorXd::Zero(rows + columns);
  right.head(rows) = -residuals;
  for (Index j = 0; j < columns; ++j) {
    matrix.col(j).head(rows) = jacobian.col(free[static_cast<std::size_t>(j)]);
    const double scale = std::max(kLeastScale, matrix.col(j).head(rows).norm());
    matrix(rows + j, j) = std::sqrt(damping) * scale;
  }
  const VectorXd of_free = matrix.householderQr().solve(right);
  VectorXd step = VectorXd::Zero(jacobian.cols());
  for (Index j = 0; j < columns; ++j) step[free[static_cast<std::size_t>(j)]] = of_free[j];
  return step;
}

}  // namespace

Minimum least_squares(const Residuals& of, std::size_t count, const Bounds& bounds, std::vector<double> start) {
  for (std::size_t i = 0; i < start.size(); ++i) start[i] = std::clamp(start[i], bounds.least[i], bounds.most[i]);
  const VectorXd least = vector_of(bounds.least), most = vector_of(bounds.most);
  std::vector<double> residuals(count), tried(count);
  Jacobian jacobian(static_cast<Index>(count), static_cast<Index>(start.size()));
  VectorXd at = vector_of(start);
  of(at.data(), residuals, jacobian.data());
  double squares = vector_of(residuals).squaredNorm();
  double damping = kFirstDamping, growth = 2.0;
  for (int i = 0; i < kMostSteps && std::isfinite(squares); ++i) {
    const VectorXd gradient = jacobian.transpose() * vector_of(residuals);
    const std::vector<Index> free = free_of(at, gradient, bounds);
    double steepest = 0.0;
    for (const Index one : free) steepest = std::max(steepest, std::abs(gradient[one]));
    if (!(steepest > kSettled)) break;
    const VectorXd next =
        (at + damped_step(jacobian, vector_of(residuals), free, damping)).cwiseMax(least).cwiseMin(most);
    const VectorXd step = next - at;
    if (!(step.norm() > kSettled * (at.norm() + kSettled))) break;
    const double foretold = squares - (vector_of(residuals) + jacobian * step).squaredNorm();
    of(next.data(), tried, nullptr);
    const double decrease = squares - vector_of(tried).squaredNorm();
    const double gain = decrease / foretold;
    if (!(foretold > 0.0 && gain > kWorthTaking)) {
      damping *= growth;
      growth *= 2.0;
      if (!(damping < kMostDamping)) break;
      continue;
    }
    at = next;
    of(at.data(), residuals, jacobian.data());
    const bool settled = decrease <= kSettled * squares;
    squares = vector_of(residuals).squaredNorm();
    damping *= std::max(1.0 / 3.0, 1.0 - std::pow(2.0 * gain - 1.0, 3));
    growth = 2.0;
    if (settled) break;
  }
  return {{at.begin(), at.end()}, squares};
}

std::vector<double> unit_errors(const Residuals& of, std::size_t count, const Bounds& bounds,
                                const std::vector<double>& at) {
  std::vector<double> errors(at.size(), std::numeric_limits<double>::quiet_NaN());
  std::vector<Index> within;
  for (std::size_t i = 0; i < at.size(); ++i)
    if (at[i] > bounds.least[i] && at[i] < bounds.most[i]) within.push_back(static_cast<Index>(i));
  if (within.empty() || count < within.size()) return errors;
  std::vector<double> residuals(count);
  Jacobian jacobian(static_cast<Index>(count), static_cast<Index>(at.size()));
  of(at.data(), residuals, jacobian.data());
  Eigen::MatrixXd columns(jacobian.rows(), static_cast<Index>(within.size()));
  for (std::size_t j = 0; j < within.size(); ++j) columns.col(static_cast<Index>(j)) = jacobian.col(within[j]);
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(columns, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const VectorXd& singular = svd.singularValues();
  if (!(singular.minCoeff() > kLeastSingular * singular.maxCoeff())) return errors;
  const Eigen::MatrixXd inverse = svd.matrixV() * singular.cwiseInverse().asDiagonal();
  for (std::size_t j = 0; j < within.size(); ++j)
    errors[static_cast<std::size_t>(within[j])] = inverse.row(static_cast<Index>(j)).norm();
  return errors;
}

}  // namespace seldinger::haptics
