// Gauss's quadrature: where to evaluate a function, and with what weights, so that a sum is its integral.
#pragma once

#include <cstddef>
#include <vector>

namespace seldinger::assessment::statistics {

struct Nodes {
  std::vector<double> at, weights;
};

// ∫ f over [low, high].
Nodes gauss_legendre(std::size_t nodes, double low, double high);
// ∫ f(z) φ(z) dz, φ the standard normal density.
Nodes gauss_hermite(std::size_t nodes);

}  // namespace seldinger::assessment::statistics
