// Small symmetric matrices: covariances of items, their inverses and eigenvectors.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace seldinger::assessment::statistics {

struct SquareMatrix {
  explicit SquareMatrix(std::size_t size) : n(size), values(size * size) {}
  double& at(std::size_t i, std::size_t j) { return values[i * n + j]; }
  double at(std::size_t i, std::size_t j) const { return values[i * n + j]; }
  double sum() const;
  double trace() const;

  std::size_t n;
  std::vector<double> values;
};

// Of columns of equal length, of n − 1.
SquareMatrix covariance_of(std::span<const std::vector<double>> columns);
// Of a covariance matrix without a zero on its diagonal.
SquareMatrix correlation_of(const SquareMatrix& covariance);

// By Cholesky; nothing where the matrix is not positive definite, or so nearly not that rounding decides.
std::optional<SquareMatrix> inverse_of(const SquareMatrix& symmetric);

struct EigenSystem {
  std::vector<double> values;  // falling
  SquareMatrix vectors;        // the column j is that of value j
};
// Of a symmetric matrix of finite numbers, by Jacobi's rotations.
EigenSystem eigen_of(const SquareMatrix& symmetric);

}  // namespace seldinger::assessment::statistics
