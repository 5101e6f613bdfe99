// Non-linear least squares within bounds, by Levenberg and Marquardt's method: the door of Eigen.
#pragma once

#include <functional>
#include <vector>

namespace seldinger::haptics {

struct Bounds {
  std::vector<double> least, most;  // of each parameter
};

// `residuals` is filled as long as it is; `jacobian`, unless nullptr, with a row of derivatives for each residual.
using Residuals = std::function<void(const double* parameters, std::vector<double>& residuals, double* jacobian)>;

struct Minimum {
  std::vector<double> parameters;
  double squares = 0.0;  // the sum; not finite where it was not at the start
};

// The valley that `start` lies in; a start beyond the bounds is taken from the nearest place within. The same
// arguments give the same bits.
Minimum least_squares(const Residuals& of, std::size_t residuals, const Bounds& bounds, std::vector<double> start);

// Of each parameter at a minimum, were the residuals' standard deviation 1: the root of the diagonal of (JᵀJ)⁻¹
// over the parameters within their bounds. NaN for one at its bound, and for all where they cannot be told apart.
std::vector<double> unit_errors(const Residuals& of, std::size_t residuals, const Bounds& bounds,
                                const std::vector<double>& at);

}  // namespace seldinger::haptics
