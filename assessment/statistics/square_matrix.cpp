#include "assessment/statistics/square_matrix.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace seldinger::assessment::statistics {
namespace {

// Of a diagonal of ones, what a pivot must leave: less is rounding.
constexpr double kLeastPivot = 1e-10;

void rotate(SquareMatrix& a, SquareMatrix& vectors, std::size_t p, std::size_t q) {
  const double theta = (a.at(q, q) - a.at(p, p)) / (2.0 * a.at(p, q));
  const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
  const double c = 1.0 / std::sqrt(t * t + 1.0), s = t * c;
  for (std::size_t i = 0; i < a.n; ++i) {
    const double ip = a.at(i, p), iq = a.at(i, q);
    a.at(i, p) = c * ip - s * iq;
    a.at(i, q) = s * ip + c * iq;
  }
  for (std::size_t i = 0; i < a.n; ++i) {
    const double pi = a.at(p, i), qi = a.at(q, i);
    a.at(p, i) = c * pi - s * qi;
    a.at(q, i) = s * pi + c * qi;
  }
  for (std::size_t i = 0; i < a.n; ++i) {
    const double ip = vectors.at(i, p), iq = vectors.at(i, q);
    vectors.at(i, p) = c * ip - s * iq;
    vectors.at(i, q) = s * ip + c * iq;
  }
}

}  // namespace

double SquareMatrix::sum() const {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

double SquareMatrix::trace() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < n; ++i) sum += at(i, i);
  return sum;
}

SquareMatrix covariance_of(std::span<const std::vector<double>> columns) {
  SquareMatrix found(columns.size());
  if (columns.empty()) return found;
  const double n = static_cast<double>(columns.front().size());
  std::vector<double> means;
  for (const auto& column : columns) means.push_back(std::accumulate(column.begin(), column.end(), 0.0) / n);
  for (std::size_t i = 0; i < found.n; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = 0.0;
      for (std::size_t row = 0; row < columns[i].size(); ++row)
        sum += (columns[i][row] - means[i]) * (columns[j][row] - means[j]);
      found.at(i, j) = found.at(j, i) = sum / (n - 1.0);
    }
  return found;
}

SquareMatrix correlation_of(const SquareMatrix& covariance) {
  SquareMatrix found(covariance.n);
  for (std::size_t i = 0; i < found.n; ++i)
    for (std::size_t j = 0; j < found.n; ++j)
      found.at(i, j) =
          i == j ? 1.0 : covariance.at(i, j) / (std::sqrt(covariance.at(i, i)) * std::sqrt(covariance.at(j, j)));
  return found;
}

std::optional<SquareMatrix> inverse_of(const SquareMatrix& symmetric) {
  const std::size_t n = symmetric.n;
  SquareMatrix lower(n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      double rest = symmetric.at(i, j);
      for (std::size_t k = 0; k < j; ++k) rest -= lower.at(i, k) * lower.at(j, k);
      if (i != j) {
        lower.at(i, j) = rest / lower.at(j, j);
      } else {
        if (!(rest > kLeastPivot * symmetric.at(i, i))) return std::nullopt;
        lower.at(i, i) = std::sqrt(rest);
      }
    }
  SquareMatrix found(n);
  std::vector<double> x(n);
  for (std::size_t column = 0; column < n; ++column) {
    for (std::size_t i = 0; i < n; ++i) {
      x[i] = i == column ? 1.0 : 0.0;
      for (std::size_t k = 0; k < i; ++k) x[i] -= lower.at(i, k) * x[k];
      x[i] /= lower.at(i, i);
    }
    for (std::size_t i = n; i-- > 0;) {
      for (std::size_t k = i + 1; k < n; ++k) x[i] -= lower.at(k, i) * x[k];
      x[i] /= lower.at(i, i);
      found.at(i, column) = x[i];
    }
  }
  return found;
}

EigenSystem eigen_of(const SquareMatrix& symmetric) {
  SquareMatrix a = symmetric, vectors(a.n);
  for (std::size_t i = 0; i < a.n; ++i) vectors.at(i, i) = 1.0;
  // Quadratic at its end: a dozen sweeps do for any size that fits here.
  for (int sweep = 0; sweep < 60; ++sweep) {
    double off = 0.0, all = 0.0;
    for (std::size_t i = 0; i < a.n; ++i)
      for (std::size_t j = 0; j < a.n; ++j) (i == j ? all : off) += a.at(i, j) * a.at(i, j);
    if (!(off > 1e-32 * all)) break;
    for (std::size_t p = 0; p < a.n; ++p)
      for (std::size_t q = p + 1; q < a.n; ++q)
        if (a.at(p, q) != 0.0) rotate(a, vectors, p, q);
  }
  std::vector<std::size_t> order(a.n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return a.at(i, i) > a.at(j, j); });
  EigenSystem found{{}, SquareMatrix(a.n)};
  for (std::size_t j = 0; j < a.n; ++j) {
    found.values.push_back(a.at(order[j], order[j]));
    for (std::size_t i = 0; i < a.n; ++i) found.vectors.at(i, j) = vectors.at(i, order[j]);
  }
  return found;
}

}  // namespace seldinger::assessment::statistics
