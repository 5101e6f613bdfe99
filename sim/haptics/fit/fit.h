// Models of a needle's force laid through a measured insertion: non-linear least squares from several starts, since
// one start ends in a valley of its own (a dent cannot move past a peak, a Gaussian not past another). The same
// curve gives the same fit.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sim/base/result.h"
#include "sim/haptics/fit/depth_curve.h"
#include "sim/haptics/fit/force_model.h"
#include "sim/haptics/needle/needle_tissue.h"

namespace seldinger::haptics {

// How well the starts agree. RMSE: over every row of the curve.
struct FitQuality {
  double rmse_n = 0.0;
  int starts = 0;
  int agreeing = 0;           // starts that end within 1 % of the best one's RMSE
  double worst_rmse_n = 0.0;  // of all starts, over the points that are fitted
};

struct PlateauFit {
  PlateauModel model;
  PlateauModel standard_error;  // of each parameter, for errors of the rows that do not hang together; NaN: unknown
  double plateau_rmse_n = 0.0;  // from model.plateau_mm() on, against the line
  bool capsule = false;         // the rupture stands out by more than three RMSE
  FitQuality quality;
};

struct GaussianFit {
  GaussianSum model;  // by rising centre
  FitQuality quality;
};

// A few of these end in the best valley (tests/sim/haptics/fit_test.cpp); one often does not.
inline constexpr int kPlateauStarts = 32;
inline constexpr int kGaussianStarts = 24;
inline constexpr int kThesisGaussians = 8, kMostGaussians = 12;
// The least stretch of plateau that a line is believed from (design).
inline constexpr double kLeastPlateauMm = 5.0;

// `curve`: of insertion_in. Refused: `no_plateau` when less than kLeastPlateauMm of it lies beyond the fall.
base::Result<PlateauFit> fit_plateau(std::span<const DepthForce> curve, int starts = kPlateauStarts);
// From the best of `starts`, its weakest Gaussian is moved to where most is left, and so on while that helps.
GaussianFit fit_gaussians(std::span<const DepthForce> curve, int gaussians = kThesisGaussians,
                          int starts = kGaussianStarts);

}  // namespace seldinger::haptics
