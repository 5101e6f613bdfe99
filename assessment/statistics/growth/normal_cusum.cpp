#include "assessment/statistics/growth/normal_cusum.h"

#define EIGEN_MPL2_ONLY
#include <Eigen/LU>

#include <cstddef>

#include "assessment/statistics/distributions.h"
#include "assessment/statistics/growth/gauss.h"
#include "assessment/statistics/roots.h"

namespace seldinger::assessment::statistics {
namespace {

constexpr std::size_t kNodesAtLeast = 40;
constexpr double kNodesAnSd = 6.0;
constexpr double kLeastLimit = 1e-3, kMostLimit = 20.0;  // SDs

}  // namespace

// The integral equation of Page (Biometrika 41, 1954), L(s) = 1 + L(0)·Φ(k − mean − s) + ∫ L(u) φ(u − s + k − mean)
// du over [0, limit], taken at Gauss's nodes (Nyström); the last unknown is L(0).
double normal_run_length(double k, double limit, double mean) {
  const Nodes nodes = gauss_legendre(kNodesAtLeast + static_cast<std::size_t>(kNodesAnSd * limit), 0.0, limit);
  const auto n = static_cast<Eigen::Index>(nodes.at.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(n + 1, n + 1);
  for (Eigen::Index i = 0; i <= n; ++i) {
    const double from = i < n ? nodes.at[static_cast<std::size_t>(i)] : 0.0;
    for (Eigen::Index j = 0; j < n; ++j) {
      const auto to = static_cast<std::size_t>(j);
      matrix(i, j) -= nodes.weights[to] * normal_pdf(nodes.at[to] - from + k - mean);
    }
    matrix(i, n) -= normal_cdf(k - mean - from);
  }
  const Eigen::VectorXd lengths = matrix.partialPivLu().solve(Eigen::VectorXd::Ones(n + 1));
  return lengths[n];
}

double normal_limit(double k, double run_length) {
  return root_between(kLeastLimit, kMostLimit,
                      [&](double limit) { return normal_run_length(k, limit, 0.0) / run_length - 1.0; });
}

}  // namespace seldinger::assessment::statistics
