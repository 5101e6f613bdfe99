#include "assessment/statistics/growth/linear_mixed.h"

#define EIGEN_MPL2_ONLY
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <cmath>
#include <limits>
#include <numbers>

#include "assessment/statistics/nelder_mead.h"

namespace seldinger::assessment::statistics {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kLeastPivot = 1e-10;     // of a column of size 1, beside the others
constexpr double kLeastResidual = 1e-12;  // share of the squares
constexpr double kMostRatio = 1e5;        // of a person's SD to the residuals'
constexpr double kSingular = 1e-4;        // as lme4's isSingular()
constexpr double kSameCriterion = 1e-9;
constexpr double kStep = 1e-2;  // of differences, each taken twice so that the error is of its fourth power

// θ holds l11, or l11, l21 and l22. Signs of a column do not matter, so no bound is needed.
class Criterion {
 public:
  explicit Criterion(const MixedRows& rows);

  struct Parts {
    double logs = 0.0;  // log|L|² + log|Rx|²
    double rss = 0.0;   // penalised
    MatrixXd factor;    // Cholesky of the augmented normal equations: Rxᵀ, and y's row last
    bool sound = false;
  };
  Parts at(const std::vector<double>& theta) const;

  double degrees() const { return degrees_; }
  std::size_t parameters() const { return slopes_ ? 3 : 1; }
  double squares() const { return whole_(fixed_, fixed_); }
  Index fixed() const { return fixed_; }

  // Profiled over σ.
  double operator()(const std::vector<double>& theta) const {
    const Parts parts = at(theta);
    if (!parts.sound) return kInfinite;
    return parts.logs + degrees_ * (1.0 + std::log(2.0 * std::numbers::pi * parts.rss / degrees_));
  }

 private:
  Index fixed_;
  bool slopes_;
  double degrees_;
  MatrixXd whole_;  // [X y]ᵀ[X y]
  struct Person {
    double n = 0.0, sum = 0.0, squares = 0.0;  // ZᵀZ
    MatrixXd columns;                          // Zᵀ[X y], two rows
  };
  std::vector<Person> persons_;
};

Criterion::Criterion(const MixedRows& rows)
    : fixed_(static_cast<Index>(rows.fixed)),
      slopes_(!rows.slope.empty()),
      degrees_(static_cast<double>(rows.y.size()) - static_cast<double>(rows.fixed)),
      whole_(MatrixXd::Zero(fixed_ + 1, fixed_ + 1)),
      persons_(rows.persons) {
  for (Person& person : persons_) person.columns = MatrixXd::Zero(2, fixed_ + 1);
  VectorXd row(fixed_ + 1);
  for (std::size_t i = 0; i < rows.y.size(); ++i) {
    for (Index j = 0; j < fixed_; ++j) row[j] = rows.x[i * rows.fixed + static_cast<std::size_t>(j)];
    row[fixed_] = rows.y[i];
    whole_.noalias() += row * row.transpose();
    Person& person = persons_[rows.person[i]];
    const double slope = slopes_ ? rows.slope[i] : 0.0;
    person.n += 1.0;
    person.sum += slope;
    person.squares += slope * slope;
    person.columns.row(0) += row.transpose();
    person.columns.row(1) += slope * row.transpose();
  }
}

Criterion::Parts Criterion::at(const std::vector<double>& theta) const {
  Parts parts;
  const double l11 = theta[0], l21 = slopes_ ? theta[1] : 0.0, l22 = slopes_ ? theta[2] : 0.0;
  for (const double one : theta)
    if (!(std::abs(one) <= kMostRatio)) return parts;
  MatrixXd left = whole_;
  VectorXd first(fixed_ + 1), second(fixed_ + 1);
  for (const Person& person : persons_) {
    // The Cholesky factor of ΛᵀZᵀZΛ + I, two by two, and what it makes of ΛᵀZᵀ[X y].
    const double w11 = 1.0 + l11 * l11 * person.n + 2.0 * l11 * l21 * person.sum + l21 * l21 * person.squares;
    const double c11 = std::sqrt(w11), c21 = l22 * (l11 * person.sum + l21 * person.squares) / c11;
    const double c22 = std::sqrt(std::max(1.0, 1.0 + l22 * l22 * person.squares - c21 * c21));
    parts.logs += 2.0 * std::log(c11 * c22);
    first.noalias() =
        (l11 / c11) * person.columns.row(0).transpose() + (l21 / c11) * person.columns.row(1).transpose();
    for (Index i = 0; i <= fixed_; ++i)
      for (Index j = 0; j <= i; ++j) left(i, j) -= first[i] * first[j];
    if (l22 == 0.0) continue;
    second.noalias() = (l22 / c22) * person.columns.row(1).transpose() - (c21 / c22) * first;
    for (Index i = 0; i <= fixed_; ++i)
      for (Index j = 0; j <= i; ++j) left(i, j) -= second[i] * second[j];
  }
  const Eigen::LLT<MatrixXd> cholesky(left);
  if (cholesky.info() != Eigen::Success) return parts;
  parts.factor = cholesky.matrixL();
  for (Index j = 0; j < fixed_; ++j) parts.logs += 2.0 * std::log(parts.factor(j, j));
  parts.rss = parts.factor(fixed_, fixed_) * parts.factor(fixed_, fixed_);
  parts.sound = parts.rss > kLeastResidual * squares() && std::isfinite(parts.logs);
  return parts;
}

bool full_rank(const Criterion& of) {
  std::vector<double> none(of.parameters());
  const Criterion::Parts parts = of.at(none);
  if (!parts.sound) return false;
  for (Index j = 0; j < of.fixed(); ++j) {
    const double size = parts.factor.row(j).head(j + 1).squaredNorm();
    if (!(parts.factor(j, j) * parts.factor(j, j) > kLeastPivot * size)) return false;
  }
  return true;
}

// Differences of `of`, any function of θ, in directions i and j, by Richardson's extrapolation.
template <typename Function>
auto first_difference(const Function& of, std::vector<double> at, std::size_t i) {
  const double h = kStep * std::max(1.0, std::abs(at[i])), middle = at[i];
  const auto central = [&](double step) {
    at[i] = middle + step;
    const auto above = of(at);
    at[i] = middle - step;
    const auto below = of(at);
    return ((above - below) / (2.0 * step));
  };
  const auto wide = central(h), narrow = central(0.5 * h);
  return ((4.0 * narrow - wide) / 3.0);
}

template <typename Function>
MatrixXd second_differences(const Function& of, const std::vector<double>& at) {
  const std::size_t n = at.size();
  MatrixXd hessian(static_cast<Index>(n), static_cast<Index>(n));
  const auto with = [&](double scale, std::size_t i, std::size_t j, double to_i, double to_j) {
    std::vector<double> moved = at;
    moved[i] += to_i * scale * kStep * std::max(1.0, std::abs(at[i]));
    moved[j] += to_j * scale * kStep * std::max(1.0, std::abs(at[j]));
    return of(moved);
  };
  const auto central = [&](double scale, std::size_t i, std::size_t j) {
    const double hi = scale * kStep * std::max(1.0, std::abs(at[i]));
    const double hj = scale * kStep * std::max(1.0, std::abs(at[j]));
    if (i == j) return (with(scale, i, j, 1, 0) - 2.0 * of(at) + with(scale, i, j, -1, 0)) / (hi * hi);
    return (with(scale, i, j, 1, 1) - with(scale, i, j, 1, -1) - with(scale, i, j, -1, 1) +
            with(scale, i, j, -1, -1)) /
           (4.0 * hi * hj);
  };
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      const double value = (4.0 * central(0.5, i, j) - central(1.0, i, j)) / 3.0;
      hessian(static_cast<Index>(i), static_cast<Index>(j)) =
          hessian(static_cast<Index>(j), static_cast<Index>(i)) = value;
    }
  return hessian;
}

// A few steps of Newton's from where the simplex ended, as long as they lead down.
void polish(const Criterion& of, Lowest& lowest) {
  for (int i = 0; i < 4; ++i) {
    const MatrixXd hessian = second_differences(of, lowest.at);
    VectorXd gradient(static_cast<Index>(lowest.at.size()));
    for (std::size_t k = 0; k < lowest.at.size(); ++k)
      gradient[static_cast<Index>(k)] = first_difference(of, lowest.at, k);
    const Eigen::LLT<MatrixXd> cholesky(hessian);
    if (cholesky.info() != Eigen::Success || !hessian.allFinite() || !gradient.allFinite()) return;
    const VectorXd step = cholesky.solve(gradient);
    std::vector<double> next = lowest.at;
    for (std::size_t k = 0; k < next.size(); ++k) next[k] -= step[static_cast<Index>(k)];
    const double value = of(next);
    if (!(value <= lowest.value + kSameCriterion)) return;
    lowest = {next, value};
    if (step.norm() < 1e-9) return;
  }
}

// Variances that the criterion does not miss are 0.
void settle_at_zero(const Criterion& of, Lowest& lowest) {
  const auto without = [&](std::vector<double> at) {
    const double value = of(at);
    if (value <= lowest.value + kSameCriterion) lowest = {std::move(at), value};
  };
  if (lowest.at.size() == 1) {
    without({0.0});
    return;
  }
  without({lowest.at[0], lowest.at[1], 0.0});
  without({0.0, 0.0, std::hypot(lowest.at[1], lowest.at[2])});
}

Lowest least_criterion(const Criterion& of) {
  Lowest best{{}, kInfinite};
  std::vector<std::vector<double>> starts{{1.0}, {0.1}};
  if (of.parameters() == 3) starts = {{1.0, 0.0, 0.5}, {0.3, 0.0, 0.1}, {3.0, 0.0, 3.0}};
  for (const auto& start : starts) {
    Lowest found = nelder_mead(of, start, 0.5 * start.front(), 1e-9);
    if (best.at.empty() || found.value < best.value) best = std::move(found);
  }
  if (!std::isfinite(best.value)) return best;
  polish(of, best);
  settle_at_zero(of, best);
  return best;
}

MatrixXd covariance_over_sigma2(const Criterion::Parts& parts, Index fixed) {
  if (!parts.sound) return MatrixXd::Constant(fixed, fixed, std::nan(""));
  const MatrixXd root = parts.factor.topLeftCorner(fixed, fixed)
                            .triangularView<Eigen::Lower>()
                            .solve(MatrixXd::Identity(fixed, fixed));
  return root.transpose() * root;
}

// Those of θ that the criterion can move: a variance of 0 is a place of symmetry, where nothing depends on it.
std::vector<std::size_t> free_parameters(const std::vector<double>& theta) {
  if (theta[0] == 0.0)
    return theta.size() == 3 && theta[2] != 0.0 ? std::vector<std::size_t>{2} : std::vector<std::size_t>{};
  if (theta.size() == 3 && theta[2] == 0.0) return {0, 1};
  return theta.size() == 3 ? std::vector<std::size_t>{0, 1, 2} : std::vector<std::size_t>{0};
}

// Giesbrecht and Burns, Biometrics 41, 1985, in θ and log σ: the covariance of these is twice the inverse of the
// criterion's second derivatives, and each contrast's variance changes with them.
void add_contrasts(MixedFit& fit, const Criterion& of, const std::vector<double>& theta,
                   const std::vector<std::vector<double>>& contrasts) {
  const std::vector<std::size_t> free = free_parameters(theta);
  const auto all = [&](const std::vector<double>& some) {
    std::vector<double> whole = theta;
    for (std::size_t k = 0; k < free.size(); ++k) whole[free[k]] = some[k];
    return whole;
  };
  std::vector<double> at;
  for (const std::size_t k : free) at.push_back(theta[k]);
  const double sigma2 = fit.sigma * fit.sigma;
  const auto m = static_cast<Index>(free.size());
  MatrixXd hessian = MatrixXd::Zero(m + 1, m + 1);
  hessian(m, m) = 4.0 * of.degrees();
  if (m > 0) {
    const auto fixed_sigma = [&](const std::vector<double>& some) {
      const Criterion::Parts parts = of.at(all(some));
      return parts.logs + parts.rss / sigma2;
    };
    hessian.topLeftCorner(m, m) = second_differences(fixed_sigma, at);
    for (Index k = 0; k < m; ++k)
      hessian(k, m) = hessian(m, k) =
          -2.0 / sigma2 *
          first_difference([&](const std::vector<double>& some) { return of.at(all(some)).rss; }, at,
                           static_cast<std::size_t>(k));
  }
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(hessian);
  MatrixXd spread = MatrixXd::Zero(m + 1, m + 1);
  for (Index k = 0; k <= m; ++k)
    if (eigen.eigenvalues()[k] > 1e-8 * eigen.eigenvalues()[m])
      spread +=
          2.0 / eigen.eigenvalues()[k] * eigen.eigenvectors().col(k) * eigen.eigenvectors().col(k).transpose();
  for (const std::vector<double>& weights : contrasts) {
    const VectorXd w = Eigen::Map<const VectorXd>(weights.data(), of.fixed());
    const auto variance = [&](const std::vector<double>& some) {
      return w.dot(covariance_over_sigma2(of.at(all(some)), of.fixed()) * w);
    };
    const double now = sigma2 * variance(at);
    VectorXd change(m + 1);
    for (Index k = 0; k < m; ++k) change[k] = sigma2 * first_difference(variance, at, static_cast<std::size_t>(k));
    change[m] = 2.0 * now;
    const VectorXd beta = Eigen::Map<const VectorXd>(fit.beta.data(), of.fixed());
    fit.contrasts.push_back({w.dot(beta), std::sqrt(now), 2.0 * now * now / change.dot(spread * change)});
  }
}

}  // namespace

std::optional<MixedFit> fit_mixed(const MixedRows& rows, const std::vector<std::vector<double>>& contrasts) {
  const Criterion of(rows);
  if (!(of.degrees() >= 1.0) || !full_rank(of)) return std::nullopt;
  const Lowest lowest = least_criterion(of);
  const Criterion::Parts parts = of.at(lowest.at);
  if (!parts.sound || !(parts.rss > 10.0 * kLeastResidual * of.squares())) return std::nullopt;
  for (const double one : lowest.at)
    if (std::abs(one) > 0.5 * kMostRatio) return std::nullopt;
  MixedFit fit;
  const Index p = of.fixed();
  const VectorXd right = parts.factor.row(p).head(p).transpose();
  const VectorXd beta = parts.factor.topLeftCorner(p, p).transpose().triangularView<Eigen::Upper>().solve(right);
  fit.beta.assign(beta.begin(), beta.end());
  fit.sigma = std::sqrt(parts.rss / of.degrees());
  fit.criterion = lowest.value;
  fit.l11 = lowest.at[0];
  if (lowest.at.size() == 3) {
    fit.l21 = lowest.at[1];
    fit.l22 = lowest.at[2];
  }
  fit.singular = std::abs(fit.l11) < kSingular || (lowest.at.size() == 3 && std::abs(fit.l22) < kSingular);
  add_contrasts(fit, of, lowest.at, contrasts);
  return fit;
}

}  // namespace seldinger::assessment::statistics
