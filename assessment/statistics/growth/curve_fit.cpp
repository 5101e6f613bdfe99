#include "assessment/statistics/growth/learning_curve.h"

#define EIGEN_MPL2_ONLY
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "assessment/statistics/roots.h"

namespace seldinger::assessment::statistics {
namespace {

constexpr double kMostRate = 8.0;  // of the power law's exponent
// Of the exponential, over all of the t: as many as there are different t, so that of a long course a plateau
// reached within a few attempts is found, too.
constexpr double kMostRates = 100.0;
constexpr int kPlaces = 400;
constexpr double kLeastTime = 1e-9;
constexpr double kAlike = 1e-11;  // share of the variation below which what is left is rounding

using Eigen::Index;
using Eigen::VectorXd;

// The curve as u(t; b)·α + γ with u = (e^{−b·s} − 1)/b, s = ln t or t over its greatest: smooth through b = 0,
// where it is a line in s. Given b, α and γ are linear least squares (variable projection: Golub and Pereyra, SIAM
// J. Numer. Anal. 10, 1973), so that one unknown is left to search, over all that it may be.
struct Projection {
  VectorXd s, y;
  double most_rate = kMostRate;

  VectorXd shape(double b) const {
    if (b == 0.0) return -s;
    return (-b * s.array()).unaryExpr([](double v) { return std::expm1(v); }) / b;
  }
  // Its derivative by b.
  VectorXd bend(double b) const {
    if (std::abs(b) < 1e-5) return (0.5 * s.array().square() - b * s.array().cube() / 3.0).matrix();
    return (-s.array() * (-b * s.array()).exp() - shape(b).array()) / b;
  }
  struct Line {
    double alpha, gamma, rss, slope;  // slope: of half the squares, by b
  };
  Line at(double b) const {
    const VectorXd u = shape(b);
    const double mean_u = u.mean(), mean_y = y.mean();
    const VectorXd du = u.array() - mean_u, dy = y.array() - mean_y;
    const double alpha = du.dot(dy) / du.squaredNorm();
    const VectorXd left = dy - alpha * du;
    return {alpha, mean_y - alpha * mean_u, left.squaredNorm(), -alpha * left.dot(bend(b))};
  }
};

double best_rate(const Projection& of) {
  double best = 0.0, least = std::numeric_limits<double>::infinity();
  const auto place = [&](int i) { return of.most_rate * (2.0 * i / kPlaces - 1.0); };
  int at = 0;
  for (int i = 0; i <= kPlaces; ++i) {
    const double rss = of.at(place(i)).rss;
    if (rss < least) {
      least = rss;
      at = i;
      best = place(i);
    }
  }
  if (at == 0 || at == kPlaces) return best;
  const double root = root_between(place(at - 1), place(at + 1), [&](double b) { return of.at(b).slope; });
  return std::isnan(root) ? best : root;
}

std::size_t different(std::span<const double> values) {
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  return static_cast<std::size_t>(std::unique(sorted.begin(), sorted.end()) - sorted.begin());
}

// Standard errors from the tangent J in a, b, c at the minimum: σ̂²(JᵀJ)⁻¹.
void add_errors(LearningCurve& curve, std::span<const double> t) {
  const auto n = static_cast<Index>(t.size());
  Eigen::MatrixXd tangent(n, 3);
  for (Index i = 0; i < n; ++i) {
    const double at = t[static_cast<std::size_t>(i)], s = curve.kind == CurveKind::power ? std::log(at) : at;
    const double decay = std::exp(-curve.b * s);
    tangent.row(i) << decay, -curve.a * s * decay, 1.0;
  }
  const VectorXd scale = tangent.colwise().norm();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  curve.se_a = curve.se_b = curve.se_c = nan;
  if (!(scale.minCoeff() > 0.0) || !tangent.allFinite()) return;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(tangent * scale.cwiseInverse().asDiagonal());
  if (qr.rank() < 3) return;
  const Eigen::MatrixXd root = qr.matrixR().topLeftCorner(3, 3).triangularView<Eigen::Upper>();
  const Eigen::Matrix3d inverse = root.triangularView<Eigen::Upper>().solve(Eigen::Matrix3d::Identity());
  const VectorXd errors = (qr.colsPermutation() * inverse).rowwise().norm().cwiseQuotient(scale) *
                          std::sqrt(curve.rss / static_cast<double>(n - 3));
  curve.se_a = errors[0];
  curve.se_b = errors[1];
  curve.se_c = errors[2];
}

}  // namespace

std::optional<LearningCurve> fit_curve(CurveKind kind, std::span<const double> t, std::span<const double> y) {
  if (t.size() != y.size() || t.size() < kLeastAttempts || different(t) < 4 || different(y) < 2)
    return std::nullopt;
  const double greatest = *std::max_element(t.begin(), t.end()), least = *std::min_element(t.begin(), t.end());
  if (!std::isfinite(greatest) || !std::isfinite(least)) return std::nullopt;
  if (kind == CurveKind::power && !(least >= kLeastTime)) return std::nullopt;
  if (kind == CurveKind::exponential && !(greatest > 0.0 && least >= 0.0)) return std::nullopt;
  const double y_scale =
      std::abs(*std::max_element(y.begin(), y.end(), [](double p, double q) { return std::abs(p) < std::abs(q); }));
  Projection of{VectorXd(static_cast<Index>(t.size())), VectorXd(static_cast<Index>(t.size()))};
  for (std::size_t i = 0; i < t.size(); ++i) {
    of.s[static_cast<Index>(i)] = kind == CurveKind::power ? std::log(t[i]) : t[i] / greatest;
    of.y[static_cast<Index>(i)] = y[i] / y_scale;
  }
  if (kind == CurveKind::exponential)
    of.most_rate = std::clamp(static_cast<double>(different(t)), kMostRate, kMostRates);
  const double b = best_rate(of);
  const Projection::Line line = of.at(b);
  const double total = (of.y.array() - of.y.mean()).square().sum();
  if (!std::isfinite(line.rss) || !(total > 0.0) || !std::isfinite(line.alpha)) return std::nullopt;
  LearningCurve curve;
  curve.kind = kind;
  curve.at_bound = std::abs(b) >= of.most_rate || b == 0.0;
  curve.b = kind == CurveKind::power ? b : b / greatest;
  curve.a = b == 0.0 ? 0.0 : y_scale * line.alpha / b;
  curve.c = y_scale * (line.gamma - (b == 0.0 ? 0.0 : line.alpha / b));
  curve.rss = line.rss * y_scale * y_scale;
  const auto n = static_cast<double>(t.size());
  constexpr double kParameters = 4.0;  // three and the residuals' variance
  if (n - kParameters - 1.0 > 0.0 && line.rss > kAlike * kAlike * total)
    curve.aicc = n * std::log(curve.rss / n) + 2.0 * kParameters * n / (n - kParameters - 1.0);
  add_errors(curve, t);
  return curve;
}

}  // namespace seldinger::assessment::statistics
