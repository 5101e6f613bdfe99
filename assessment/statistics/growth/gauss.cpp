#include "assessment/statistics/growth/gauss.h"

#define EIGEN_MPL2_ONLY
#include <Eigen/Eigenvalues>

#include <cmath>

#include "sim/base/check.h"

namespace seldinger::assessment::statistics {
namespace {

// Golub and Welsch, Math. Comp. 23, 1969: nodes are the eigenvalues of the recurrence's matrix, weights the squares
// of its eigenvectors' first elements. `off` of i: the root of the recurrence's coefficient, i from 1.
template <typename Off>
Nodes golub_welsch(std::size_t nodes, const Off& off) {
  CHECK(nodes >= 1);
  const auto n = static_cast<Eigen::Index>(nodes);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 1; i < n; ++i) matrix(i, i - 1) = matrix(i - 1, i) = off(static_cast<double>(i));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solved(matrix);
  Nodes found;
  for (Eigen::Index i = 0; i < n; ++i) {
    found.at.push_back(solved.eigenvalues()[i]);
    found.weights.push_back(solved.eigenvectors()(0, i) * solved.eigenvectors()(0, i));
  }
  return found;
}

}  // namespace

Nodes gauss_legendre(std::size_t nodes, double low, double high) {
  Nodes found = golub_welsch(nodes, [](double i) { return i / std::sqrt(4.0 * i * i - 1.0); });
  for (std::size_t i = 0; i < nodes; ++i) {
    found.at[i] = low + 0.5 * (high - low) * (found.at[i] + 1.0);
    found.weights[i] *= high - low;
  }
  return found;
}

Nodes gauss_hermite(std::size_t nodes) {
  return golub_welsch(nodes, [](double i) { return std::sqrt(i); });
}

}  // namespace seldinger::assessment::statistics
