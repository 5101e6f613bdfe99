#include "sim/haptics/fit/force_model.h"

#include <algorithm>
#include <cmath>

namespace seldinger::haptics {

PlateauModel PlateauModel::of(const double* p) noexcept {
  return {p[0], p[1], p[2], p[3], p[4], p[5]};
}

std::array<double, PlateauModel::kParameters> PlateauModel::parameters() const noexcept {
  return {slope_n_mm, intercept_n, rupture_n, dent_mm, linear_part, fall_mm};
}

double PlateauModel::force_n(double depth_mm, double* gradient) const noexcept {
  if (gradient != nullptr) std::fill_n(gradient, kParameters, 0.0);
  if (depth_mm < 0.0) return 0.0;
  if (depth_mm < dent_mm) {
    const double q = depth_mm / dent_mm;
    const double shape = q * (linear_part + (1.0 - linear_part) * q);
    if (gradient != nullptr) {
      gradient[2] = shape;
      gradient[3] = -rupture_n * (linear_part + 2.0 * (1.0 - linear_part) * q) * q / dent_mm;
      gradient[4] = rupture_n * q * (1.0 - q);
    }
    return rupture_n * shape;
  }
  const double beyond_mm = depth_mm - dent_mm;
  const double left = std::exp(-beyond_mm / fall_mm);
  const double fallen_n = rupture_n - line_n(dent_mm);
  if (gradient != nullptr) {
    gradient[0] = depth_mm - dent_mm * left;
    gradient[1] = 1.0 - left;
    gradient[2] = left;
    gradient[3] = (fallen_n / fall_mm - slope_n_mm) * left;
    gradient[5] = fallen_n * left * beyond_mm / (fall_mm * fall_mm);
  }
  return line_n(depth_mm) + fallen_n * left;
}

double PlateauModel::plateau_mm() const noexcept {
  constexpr double kFalls = 4.605170185988091;  // ln 100
  return dent_mm + kFalls * fall_mm;
}

double Gaussian::force_n(double depth_mm, double* gradient) const noexcept {
  const double t = (depth_mm - centre_mm) / sigma_mm;
  const double shape = std::exp(-0.5 * t * t);
  if (gradient != nullptr) {
    gradient[0] = shape;
    gradient[1] = height_n * shape * t / sigma_mm;
    gradient[2] = height_n * shape * t * t / sigma_mm;
  }
  return height_n * shape;
}

double GaussianSum::force_n(double depth_mm) const noexcept {
  double sum_n = 0.0;
  for (const Gaussian& part : parts) sum_n += part.force_n(depth_mm);
  return sum_n;
}

}  // namespace seldinger::haptics
