#include "sim/haptics/fit/fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/base/check.h"
#include "sim/base/rng.h"
#include "sim/haptics/fit/least_squares.h"

namespace seldinger::haptics {
namespace {

// More points do not tell more, they only take longer; Gaussians are smooth.
constexpr int kPlateauPoints = 1000, kGaussianPoints = 400;
constexpr double kAgreeing = 1.01;  // times the best RMSE
// Below this an RMSE is rounding (N).
constexpr double kExactN = 1e-9;

using Points = std::vector<DepthForce>;
using Parameters = std::vector<double>;

double way_mm(const Points& points) {
  return points.back().depth_mm - points.front().depth_mm;
}

// `Force` takes parameters, depth, gradient or nullptr. A fit from each start; the best by least squares, the
// earliest of equals.
template <typename Force>
class Search {
 public:
  Search(const Points& points, Bounds bounds, Force force)
      : points_(points), bounds_(std::move(bounds)), force_(std::move(force)) {}

  void from(Parameters start) {
    Minimum minimum = least_squares(residuals(), points_.size(), bounds_, std::move(start));
    const double rmse_n = std::sqrt(minimum.squares / static_cast<double>(points_.size()));
    if (!std::isfinite(rmse_n)) return;
    rmse_n_.push_back(rmse_n);
    if (best_.empty() || rmse_n < best_rmse_n_) {
      best_ = std::move(minimum.parameters);
      best_rmse_n_ = rmse_n;
    }
  }

  const Parameters& best() const { return best_; }

  FitQuality quality() const {
    FitQuality quality;
    quality.starts = static_cast<int>(rmse_n_.size());
    const double near_n = std::max(kAgreeing * best_rmse_n_, kExactN);
    quality.agreeing = static_cast<int>(
        std::count_if(rmse_n_.begin(), rmse_n_.end(), [&](double rmse_n) { return rmse_n <= near_n; }));
    quality.worst_rmse_n = *std::max_element(rmse_n_.begin(), rmse_n_.end());
    return quality;
  }

  // Of each parameter at the best; NaN for one at its bound, and where they cannot be told apart.
  Parameters standard_error() const {
    Parameters errors = unit_errors(residuals(), points_.size(), bounds_, best_);
    const auto free = std::count_if(errors.begin(), errors.end(), [](double error) { return !std::isnan(error); });
    const double left_over = static_cast<double>(points_.size()) - static_cast<double>(free);
    const double sigma_n = best_rmse_n_ * std::sqrt(static_cast<double>(points_.size()) / left_over);
    for (double& error : errors) error *= sigma_n;
    return errors;
  }

 private:
  // Model - measured at each point.
  Residuals residuals() const {
    return [this](const double* parameters, std::vector<double>& residuals, double* gradient) {
      for (std::size_t i = 0; i < points_.size(); ++i) {
        residuals[i] = force_(parameters, points_[i].depth_mm, gradient) - points_[i].force_n;
        if (gradient != nullptr) gradient += bounds_.least.size();
      }
    };
  }

  const Points& points_;
  Bounds bounds_;
  Force force_;
  Parameters best_;
  double best_rmse_n_ = std::numeric_limits<double>::infinity();
  std::vector<double> rmse_n_;
};

template <typename Force>
double rmse_n(std::span<const DepthForce> curve, double from_mm, const Force& force) {
  double squares = 0.0, count = 0.0;
  for (const DepthForce& point : curve) {
    if (point.depth_mm < from_mm) continue;
    squares += std::pow(force(point.depth_mm) - point.force_n, 2);
    count += 1.0;
  }
  return std::sqrt(squares / count);
}

double most_n(const Points& points) {
  double most = 0.0;
  for (const DepthForce& point : points) most = std::max(most, point.force_n);
  return most;
}

const DepthForce& at_depth(const Points& points, double depth_mm) {
  const auto beside = [&](const DepthForce& a, const DepthForce& b) {
    return std::abs(a.depth_mm - depth_mm) < std::abs(b.depth_mm - depth_mm);
  };
  return *std::min_element(points.begin(), points.end(), beside);
}

// Gaussians evenly along the depth for start 0, else anywhere, from narrow to wide.
Parameters spread_out(const Points& points, std::size_t parts, int start) {
  Parameters parameters;
  const double way = way_mm(points), count = static_cast<double>(parts);
  base::Rng rng(static_cast<std::uint64_t>(start));
  for (std::size_t k = 0; k < parts; ++k) {
    const double place = start == 0 ? (static_cast<double>(k) + 0.5) / count : rng.uniform();
    const double width = start == 0 ? 0.7 / count : 0.02 * std::exp(rng.uniform() * std::log(20.0));
    const double centre_mm = points.front().depth_mm + place * way;
    parameters.insert(parameters.end(), {0.6 * at_depth(points, centre_mm).force_n, centre_mm, width * way});
  }
  return parameters;
}

// A Gaussian on the highest point, as wide as the peak at half its height on its steeper side; the next on what
// that leaves.
Parameters peak_by_peak(Points left, std::size_t parts) {
  constexpr double kHalfWidth = 1.1774100225154747;  // sqrt(2 ln 2) sigma
  Parameters parameters;
  for (std::size_t k = 0; k < parts; ++k) {
    const auto peak = std::max_element(
        left.begin(), left.end(), [](const DepthForce& a, const DepthForce& b) { return a.force_n < b.force_n; });
    double half_mm = way_mm(left);
    for (const DepthForce& point : left)
      if (point.force_n < 0.5 * peak->force_n)
        half_mm = std::min(half_mm, std::abs(point.depth_mm - peak->depth_mm));
    const Gaussian part{peak->force_n, peak->depth_mm,
                        std::max(half_mm, way_mm(left) / static_cast<double>(left.size())) / kHalfWidth};
    parameters.insert(parameters.end(), {part.height_n, part.centre_mm, part.sigma_mm});
    for (DepthForce& point : left) point.force_n -= part.force_n(point.depth_mm);
  }
  return parameters;
}

// The part that does least, moved to the highest point of what all leave of the curve: some end beside the curve,
// where they do nothing.
Parameters with_weakest_moved(const Points& points, Parameters parameters) {
  Points left = points;
  std::size_t weakest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t at = 0; at < parameters.size(); at += Gaussian::kParameters) {
    const Gaussian part{parameters[at], parameters[at + 1], parameters[at + 2]};
    double squares = 0.0;
    for (DepthForce& point : left) {
      const double force_n = part.force_n(point.depth_mm);
      point.force_n -= force_n;
      squares += force_n * force_n;
    }
    if (squares >= least) continue;
    least = squares;
    weakest = at;
  }
  const Parameters moved = peak_by_peak(std::move(left), 1);
  std::copy(moved.begin(), moved.end(), parameters.begin() + static_cast<std::ptrdiff_t>(weakest));
  return parameters;
}

}  // namespace

base::Result<PlateauFit> fit_plateau(std::span<const DepthForce> curve, int starts) {
  CHECK(!curve.empty() && starts > 0);
  const Points points = thinned(curve, kPlateauPoints);
  const double way = way_mm(points), deepest_mm = points.back().depth_mm, most = most_n(points);
  const auto force = [](const double* p, double depth_mm, double* gradient) {
    return PlateauModel::of(p).force_n(depth_mm, gradient);
  };
  // A row's values are ≥ 0 (needle_tissue.h); a fall shorter than a point's distance cannot be seen.
  const double point_mm = way / static_cast<double>(points.size());
  Search search(points,
                {{0.0, 0.0, 0.0, point_mm, 0.0, 0.1 * point_mm},
                 {2.0 * most / way, 2.0 * most, 4.0 * most, deepest_mm, 1.0, 0.25 * way}},
                force);
  for (int i = 0; i < starts; ++i) {
    // Closer where dents are.
    const double dent_mm = deepest_mm * std::pow((i + 0.5) / starts, 2);
    const double end_n = points.back().force_n;
    search.from({0.0, std::max(0.0, end_n), at_depth(points, dent_mm).force_n, dent_mm, 0.5, 0.02 * way});
  }
  PlateauFit fit;
  fit.model = PlateauModel::of(search.best().data());
  fit.standard_error = PlateauModel::of(search.standard_error().data());
  // Where it opens is known no better than half the points' distance, nor is the force there.
  const double steepest_n_mm = fit.model.rupture_n * (2.0 - fit.model.linear_part) / fit.model.dent_mm;
  fit.standard_error.dent_mm = std::max(0.5 * point_mm, fit.standard_error.dent_mm);
  fit.standard_error.rupture_n = std::max(0.5 * point_mm * steepest_n_mm, fit.standard_error.rupture_n);
  fit.quality = search.quality();
  fit.quality.rmse_n =
      rmse_n(curve, points.front().depth_mm, [&](double depth_mm) { return fit.model.force_n(depth_mm); });
  if (!(deepest_mm - fit.model.plateau_mm() >= kLeastPlateauMm))
    return base::Error{"no_plateau", "the force comes to no plateau of 5 mm within the curve"};
  fit.plateau_rmse_n =
      rmse_n(curve, fit.model.plateau_mm(), [&](double depth_mm) { return fit.model.line_n(depth_mm); });
  fit.capsule = fit.model.rupture_n > fit.model.line_n(fit.model.dent_mm) + 3.0 * fit.quality.rmse_n;
  return fit;
}

GaussianFit fit_gaussians(std::span<const DepthForce> curve, int gaussians, int starts) {
  CHECK(!curve.empty() && gaussians > 0 && starts > 0);
  const Points points = thinned(curve, kGaussianPoints);
  const auto parts = static_cast<std::size_t>(gaussians);
  const double way = way_mm(points), from_mm = points.front().depth_mm, most = most_n(points);
  constexpr std::size_t kEach = Gaussian::kParameters;
  const auto force = [parts](const double* p, double depth_mm, double* gradient) {
    double sum_n = 0.0;
    for (std::size_t k = 0; k < parts; ++k)
      sum_n += Gaussian{p[kEach * k], p[kEach * k + 1], p[kEach * k + 2]}.force_n(
          depth_mm, gradient != nullptr ? gradient + kEach * k : nullptr);
    return sum_n;
  };
  // Narrower than two points is noise; one beyond the end gives the end of a plateau its slope.
  Bounds bounds;
  for (std::size_t k = 0; k < parts; ++k) {
    bounds.least.insert(bounds.least.end(), {0.0, from_mm, 2.0 * way / static_cast<double>(points.size())});
    bounds.most.insert(bounds.most.end(), {4.0 * most, from_mm + 1.25 * way, 2.0 * way});
  }
  Search search(points, std::move(bounds), force);
  for (int i = 0; i < starts; ++i) search.from(i == 1 ? peak_by_peak(points, parts) : spread_out(points, parts, i));
  for (std::size_t k = 0; k < parts; ++k) {
    const Parameters before = search.best();
    search.from(with_weakest_moved(points, before));
    if (search.best() == before) break;
  }
  GaussianFit fit;
  for (std::size_t k = 0; k < parts; ++k) {
    const double* p = search.best().data() + kEach * k;
    fit.model.parts.push_back({p[0], p[1], p[2]});
  }
  std::sort(fit.model.parts.begin(), fit.model.parts.end(),
            [](const Gaussian& a, const Gaussian& b) { return a.centre_mm < b.centre_mm; });
  fit.quality = search.quality();
  fit.quality.rmse_n = rmse_n(curve, from_mm, [&](double depth_mm) { return fit.model.force_n(depth_mm); });
  return fit;
}

}  // namespace seldinger::haptics
