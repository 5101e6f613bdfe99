// Curves that are laid through measured force against depth (fit.h finds their parameters).
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace seldinger::haptics {

// A capsule that gives way and opens, then the plateau, the thesis' black line (§5.3.2). x is depth in mm:
//   x < 0:     0
//   x < dent:  rupture (c q + (1 − c) q²), q = x / dent; c is linear_part (the needle law's capsule)
//   else:      slope x + intercept, and what the rupture stood above it falls off as exp(−(x − dent) / fall)
struct PlateauModel {
  double slope_n_mm = 0.0, intercept_n = 0.0;
  double rupture_n = 0.0, dent_mm = 1.0;
  double linear_part = 1.0;  // 0 to 1
  double fall_mm = 1.0;

  static constexpr std::size_t kParameters = 6;
  // In the order above.
  static PlateauModel of(const double* parameters) noexcept;
  std::array<double, kParameters> parameters() const noexcept;

  // `gradient`, where given, takes the derivatives by the parameters.
  double force_n(double depth_mm, double* gradient = nullptr) const noexcept;
  double line_n(double depth_mm) const noexcept { return slope_n_mm * depth_mm + intercept_n; }
  // From here on the force is the line's, but for 1 % of what fell.
  double plateau_mm() const noexcept;
};

// g(x) = height exp(−(x − centre)² / (2 sigma²)). The thesis calls sigma the full width at half maximum; in its
// eq. 5.1 it is the standard deviation, as here.
struct Gaussian {
  double height_n = 0.0, centre_mm = 0.0, sigma_mm = 1.0;

  static constexpr std::size_t kParameters = 3;
  double force_n(double depth_mm, double* gradient = nullptr) const noexcept;
};

// Thesis eq. 5.1: eight for its kidney, six for its liver.
struct GaussianSum {
  std::vector<Gaussian> parts;
  double force_n(double depth_mm) const noexcept;
};

}  // namespace seldinger::haptics
