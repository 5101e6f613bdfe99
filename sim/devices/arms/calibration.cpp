#include "sim/devices/arms/calibration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>

#include "sim/base/check.h"
#include "sim/base/vectors.h"

namespace seldinger::devices {
namespace {

constexpr const char* kThesis = "thesis §5.4";
constexpr double kBoxMm = 143.0;

constexpr std::array<TemplatePoint, 6> kTemplate{{
    {"a", {-64.0, 0.0, 0.0}, false, true, kThesis},
    {"b", {64.0, 0.0, 0.0}, false, true, kThesis},
    {"c", {0.0, 0.0, -64.0}, false, true, kThesis},
    {"d", {0.0, 0.0, 64.0}, false, true, kThesis},
    {"e",
     {0.0, 0.0, 0.0},
     false,
     false,
     "(design): where the lines meet; the thesis draws it, without coordinates"},
    {"f", {0.0, kBoxMm, 0.0}, true, true, kThesis},
}};

// The second extent of points on a line, as a share of the first; on the template it is 1 (design).
constexpr double kLeastBreadth = 0.1;
// Points this close together are one (mm of the device; design).
constexpr double kLeastExtentMm = 1.0;
// f lower than this share of the box tells no up from down (design).
constexpr double kLeastHeightShare = 0.1;

template <std::size_t N>
using Square = std::array<std::array<double, N>, N>;

template <std::size_t N>
struct Eigen {
  std::array<double, N> values{};
  Square<N> vectors{};  // column i belongs to values[i]
};

// Jacobi's rotations; exact to rounding for matrices this small.
template <std::size_t N>
Eigen<N> eigen_of(Square<N> m) {
  Eigen<N> eigen;
  for (std::size_t i = 0; i < N; ++i) eigen.vectors[i][i] = 1.0;
  constexpr int kSweeps = 60;  // quadratic: some ten do
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    for (std::size_t p = 0; p < N; ++p)
      for (std::size_t q = p + 1; q < N; ++q) {
        if (m[p][q] == 0.0) continue;
        const double theta = (m[q][q] - m[p][p]) / (2.0 * m[p][q]);
        const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
        const double cosine = 1.0 / std::sqrt(t * t + 1.0), sine = t * cosine;
        const auto turn = [&](double& a, double& b) {
          const double was = a;
          a = cosine * was - sine * b;
          b = sine * was + cosine * b;
        };
        for (std::size_t k = 0; k < N; ++k) turn(m[k][p], m[k][q]);
        for (std::size_t k = 0; k < N; ++k) turn(m[p][k], m[q][k]);
        for (std::size_t k = 0; k < N; ++k) turn(eigen.vectors[k][p], eigen.vectors[k][q]);
      }
  for (std::size_t i = 0; i < N; ++i) eigen.values[i] = m[i][i];
  return eigen;
}

glm::dvec3 mean(std::span<const glm::dvec3> points) {
  glm::dvec3 sum(0.0);
  for (const glm::dvec3& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

// A matrix of the squares of the points about their mean, and its values from the largest down.
std::array<double, 3> spread(std::span<const glm::dvec3> points) {
  const glm::dvec3 centre = mean(points);
  Square<3> squares{};
  for (const glm::dvec3& point : points)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        squares[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] +=
            (point[i] - centre[i]) * (point[j] - centre[j]) / static_cast<double>(points.size());
  std::array<double, 3> values = eigen_of(squares).values;
  std::sort(values.begin(), values.end(), std::greater<>());
  return values;
}

glm::dmat3 rotation_of(double w, double x, double y, double z) {
  // Columns.
  return {{w * w + x * x - y * y - z * z, 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)},
          {2.0 * (x * y - w * z), w * w - x * x + y * y - z * z, 2.0 * (y * z + w * x)},
          {2.0 * (x * z + w * y), 2.0 * (y * z - w * x), w * w - x * x - y * y + z * z}};
}

struct Pair {
  const TemplatePoint* target;
  glm::dvec3 device_mm;
};

double residual_mm(const Placement& placement, const Pair& pair) {
  const glm::dvec3 off = placement(pair.device_mm) - pair.target->template_mm;
  return pair.target->height_only ? std::abs(off.y) : glm::length(off);
}

double most_residual_mm(const Placement& placement, std::span<const Pair> pairs) {
  double most = 0.0;
  for (const Pair& pair : pairs) most = std::max(most, residual_mm(placement, pair));
  return most;
}

Placement placement_of(std::span<const Pair> pairs, bool with_heights, const Placement& near) {
  std::vector<glm::dvec3> from, to;
  for (const Pair& pair : pairs) {
    if (pair.target->height_only && !with_heights) continue;
    glm::dvec3 target = pair.target->template_mm;
    if (pair.target->height_only) {
      const glm::dvec3 now = near(pair.device_mm);
      target.x = now.x;
      target.z = now.z;
    }
    from.push_back(pair.device_mm);
    to.push_back(target);
  }
  return closest_placement(from, to);
}

// Heights join in by turns: where on the box f stands is taken from the placement, then the placement from all
// points. No turn makes the sum of squares larger.
Placement settled(std::span<const Pair> pairs, Placement placement) {
  constexpr int kMostTurns = 1000;
  constexpr double kStillMm = 1e-12;
  for (int turn = 0; turn < kMostTurns; ++turn) {
    const Placement next = placement_of(pairs, true, placement);
    double moved_mm = 0.0;
    for (const Pair& pair : pairs)
      moved_mm = std::max(moved_mm, glm::length(next(pair.device_mm) - placement(pair.device_mm)));
    placement = next;
    if (!(moved_mm > kStillMm)) break;
  }
  return placement;
}

std::string numbered(const char* format, double value) {
  char text[160];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

base::Error as_error(std::vector<base::Problem> findings) {
  base::Error error{findings.front().code, findings.front().text, {}};
  error.findings.assign(findings.begin() + 1, findings.end());
  return error;
}

// In the template's order.
base::Result<std::vector<Pair>> pairs_of(std::span<const TakenPoint> taken) {
  std::vector<base::Problem> findings;
  std::vector<Pair> pairs;
  for (const TakenPoint& point : taken)
    if (std::none_of(kTemplate.begin(), kTemplate.end(),
                     [&](const TemplatePoint& known) { return point.name == known.name; })) {
      findings.push_back({"bad_points", "a point has another name than a, b, c, d, e, f"});
      break;
    }
  for (const TemplatePoint& known : kTemplate) {
    const auto named = [&](const TakenPoint& point) { return point.name == known.name; };
    const auto count = std::count_if(taken.begin(), taken.end(), named);
    const std::string name = std::string("point ") + known.name;
    if (count > 1) findings.push_back({"bad_points", name + " is there twice"});
    if (count == 0 && known.required) findings.push_back({"bad_points", name + " is missing"});
    if (count != 1) continue;
    const glm::dvec3 device_mm = std::find_if(taken.begin(), taken.end(), named)->device_mm;
    if (!base::is_finite(device_mm)) findings.push_back({"bad_points", name + " is not of finite numbers"});
    pairs.push_back({&known, device_mm});
  }
  if (!findings.empty()) return as_error(std::move(findings));
  return pairs;
}

// The point without which the others agree; nothing when none or several would do.
std::optional<std::size_t> odd_one_out(std::span<const Pair> pairs) {
  std::optional<std::size_t> odd;
  for (std::size_t out = 0; out < pairs.size(); ++out) {
    std::vector<Pair> rest(pairs.begin(), pairs.end());
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(out));
    const Placement placement = settled(rest, placement_of(rest, false, {}));
    if (most_residual_mm(placement, rest) > kMostResidualMm) continue;
    if (odd) return std::nullopt;
    odd = out;
  }
  return odd;
}

}  // namespace

std::span<const TemplatePoint> template_points() noexcept {
  return kTemplate;
}

Placement closest_placement(std::span<const glm::dvec3> from, std::span<const glm::dvec3> to) {
  CHECK(from.size() == to.size() && from.size() >= 3);
  const glm::dvec3 from_centre = mean(from), to_centre = mean(to);
  std::array<std::array<double, 3>, 3> s{};
  double from_squares = 0.0;
  for (std::size_t n = 0; n < from.size(); ++n) {
    const glm::dvec3 a = from[n] - from_centre, b = to[n] - to_centre;
    from_squares += glm::dot(a, a);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) s[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] += a[i] * b[j];
  }
  const auto& [sx, sy, sz] = s;
  const Square<4> horn{{{sx[0] + sy[1] + sz[2], sy[2] - sz[1], sz[0] - sx[2], sx[1] - sy[0]},
                        {sy[2] - sz[1], sx[0] - sy[1] - sz[2], sx[1] + sy[0], sz[0] + sx[2]},
                        {sz[0] - sx[2], sx[1] + sy[0], -sx[0] + sy[1] - sz[2], sy[2] + sz[1]},
                        {sx[1] - sy[0], sz[0] + sx[2], sy[2] + sz[1], -sx[0] - sy[1] + sz[2]}}};
  const Eigen<4> eigen = eigen_of(horn);
  const auto largest =
      static_cast<std::size_t>(std::max_element(eigen.values.begin(), eigen.values.end()) - eigen.values.begin());
  const auto q = [&](std::size_t i) { return eigen.vectors[i][largest]; };
  Placement placement;
  placement.rotation = rotation_of(q(0), q(1), q(2), q(3));
  // The largest eigenvalue is the sum of what the turned points have in common with their targets.
  placement.scale = from_squares > 0.0 ? eigen.values[largest] / from_squares : 1.0;
  placement.translation_mm = to_centre - placement.scale * (placement.rotation * from_centre);
  return placement;
}

base::Result<Calibration> calibrate(std::span<const TakenPoint> taken) {
  const auto pairs = pairs_of(taken);
  if (!pairs) return pairs.error();
  std::vector<glm::dvec3> board;
  for (const Pair& pair : *pairs)
    if (!pair.target->height_only) board.push_back(pair.device_mm);
  const std::array<double, 3> squares = spread(board);
  if (!(std::sqrt(squares[0]) >= kLeastExtentMm))
    return base::Error{"collinear", "the points of the board lie on one spot", {}};
  if (!(std::sqrt(squares[1] / squares[0]) >= kLeastBreadth))
    return base::Error{"collinear", "the points of the board lie on one line, about which the device may turn", {}};

  // The board alone knows everything but which side is up: three points that are not on a line fix a rotation.
  Placement placement = placement_of(*pairs, false, {});
  for (const Pair& pair : *pairs) {
    if (!pair.target->height_only) continue;
    const double share = placement(pair.device_mm).y / pair.target->template_mm.y;
    if (std::abs(share) < kLeastHeightShare)
      return base::Error{"coplanar",
                         "point f is as low as the board: without one on the box, a mirrored device looks the same",
                         {}};
    if (share < 0.0)
      return base::Error{"mirrored",
                         "point f comes out below the board: points were taken in another order, or one of the "
                         "device's axes is turned over",
                         {}};
  }
  placement = settled(*pairs, placement);
  if (!(placement.scale >= kLeastScale && placement.scale <= kMostScale))
    return base::Error{
        "wrong_scale",
        numbered("the device would have to be scaled by %.4g: does it read millimetres?", placement.scale),
        {}};

  Calibration calibration;
  calibration.template_from_device = placement;
  std::vector<base::Problem> findings;
  double squares_mm2 = 0.0;
  for (const Pair& pair : *pairs) {
    const double off_mm = residual_mm(placement, pair);
    calibration.points.push_back({{pair.target->name, pair.device_mm}, off_mm});
    calibration.residual_max_mm = std::max(calibration.residual_max_mm, off_mm);
    squares_mm2 += off_mm * off_mm;
    if (!(off_mm <= kMostResidualMm))
      findings.push_back({"wrong_point", std::string("point ") + pair.target->name +
                                             numbered(" is off by %.2f mm", off_mm) +
                                             numbered(", above %g mm", kMostResidualMm)});
  }
  calibration.residual_rms_mm = std::sqrt(squares_mm2 / static_cast<double>(pairs->size()));
  if (findings.empty()) return calibration;
  if (const auto odd = odd_one_out(*pairs))
    findings.push_back(
        {"wrong_point", std::string("without point ") + (*pairs)[*odd].target->name + " the others agree"});
  return as_error(std::move(findings));
}

}  // namespace seldinger::devices
