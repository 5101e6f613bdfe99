// Borders of what a CT tells by voxels: the voxel that a scatterer is of, and what a picture shows of a border.
#include <cmath>

#include "shaders/shared/ultrasound_cube.glsl.h"
#include "tests/sim/imaging/ultrasound/ultrasound_scene.h"

namespace seldinger::imaging {
namespace {

TEST(Stray, IsATriangleAlongEachAxisOfItsOwn) {
  constexpr int kCount = 1 << 18;
  double sum[3] = {}, square[3] = {}, product = 0.0, with_place = 0.0;
  int within_half = 0;
  for (int i = 0; i < kCount; ++i) {
    const std::uint32_t seed = shaders::us_lattice_seed(99U, i & 63, (i >> 6) & 63, i >> 12),
                        bits = shaders::us_stray_bits(seed);
    const double stray[3] = {shaders::us_stray(bits), shaders::us_stray(bits >> 10U),
                             shaders::us_stray(bits >> 20U)};
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_LT(std::abs(stray[axis]), 1.0);
      sum[axis] += stray[axis];
      square[axis] += stray[axis] * stray[axis];
    }
    product += stray[0] * stray[1] + stray[1] * stray[2] + stray[2] * stray[0];
    with_place += stray[0] * (static_cast<double>(shaders::us_cube_u(shaders::us_lattice_bits(seed))) - 0.5);
    within_half += std::abs(stray[0]) < 0.5 ? 1 : 0;
  }
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(sum[axis] / kCount, 0.0, 0.004);
    EXPECT_NEAR(square[axis] / kCount, 1.0 / 6.0, 0.002);
  }
  EXPECT_NEAR(product / kCount, 0.0, 0.004);
  EXPECT_NEAR(with_place / kCount, 0.0, 0.002);
  EXPECT_NEAR(static_cast<double>(within_half) / kCount, 0.75, 0.02);
}

// The integral of the quadratic B-spline: how much of what is sent back `x` voxels beyond a border is of that side.
double share_beyond(double x) {
  if (x <= -1.5) return 0.0;
  if (x >= 1.5) return 1.0;
  if (x < -0.5) return std::pow(x + 1.5, 3.0) / 6.0;
  if (x > 0.5) return 1.0 - std::pow(1.5 - x, 3.0) / 6.0;
  return 0.5 + 0.75 * x - x * x * x / 3.0;
}

// Mean square of each beam, over many seeds, 20 mm deep.
std::vector<double> powers(const Scene& s, UltrasoundView view) {
  std::vector<double> power(static_cast<std::size_t>(view.beams), 0.0);
  constexpr int kSeeds = 12;
  const int from = sample_at(view, 12.0), to = sample_at(view, 24.0);
  for (int seed = 1; seed <= kSeeds; ++seed) {
    view.seed = static_cast<std::uint64_t>(seed);
    const PolarPicture picture = polar_of(s, view);
    for (int b = 0; b < view.beams; ++b)
      power[static_cast<std::size_t>(b)] += measure::mean_square(picture, b, b + 1, from, to) / kSeeds;
  }
  return power;
}

// Liver beside fluid, a border along the beams and between two voxels of 2 mm: across it the picture goes by the
// spline, and by the law before from one to the other within a beam's width.
TEST(Borders, AreSplinesOfTheVoxels) {
  const Scene s = scene([](const glm::dvec3& p) { return p.x > 0.0 ? TissueClass::liver : TissueClass::fluid; },
                        {40, 40, 40}, 2.0);
  // Where the border lies: half way between the last voxel's middle and the first one's beyond it.
  double last = -1e9, next = 1e9;
  for (int i = 0; i < s.volume.size_voxels.x; ++i) {
    const double x = (s.volume.lps_from_voxel * glm::dvec4(i, 0, 0, 1)).x;
    (x > 0.0 ? next : last) = x > 0.0 ? std::min(next, x) : std::max(last, x);
  }
  const double border_mm = 0.5 * (last + next);
  UltrasoundView view = straight_view(30.0), before = view;
  view.attenuation_db_cm_mhz = before.attenuation_db_cm_mhz = 0.0;
  before.sight_law = cases::SightLaw::echo;
  const std::vector<double> now = powers(s, view), was = powers(s, before);
  const double sigma_mm =
      beam_width(view.probe, view.probe.frequency_mhz, view.focus_mm, 18.0).lateral_sigma_mm / std::sqrt(2.0);
  const auto seen = [&](double x_mm, const auto& share) {
    double sum = 0.0, all = 0.0;
    for (double u = -4.0; u <= 4.0; u += 0.05) {
      sum += std::exp(-0.5 * u * u) * share(x_mm + u * sigma_mm);
      all += std::exp(-0.5 * u * u);
    }
    return sum / all;
  };
  double off_before = 0.0;
  for (int b = 8; b < view.beams - 8; ++b) {
    const double x_mm = point_of(view, b, 0.0).x - border_mm;
    const double spline = seen(x_mm, [](double x) { return share_beyond(0.5 * x); }),
                 step = seen(x_mm, [](double x) { return x > 0.0 ? 1.0 : 0.0; });
    EXPECT_NEAR(now[static_cast<std::size_t>(b)], spline, 0.12) << x_mm;
    EXPECT_NEAR(was[static_cast<std::size_t>(b)], step, 0.12) << x_mm;
    off_before = std::max(off_before, std::abs(spline - step));
  }
  EXPECT_GT(off_before, 0.15) << "the two can be told apart";
}

// What is told of a picture asks the voxel alone: a place is of its voxel, to the border.
TEST(Borders, AreStepsForWhatIsTold) {
  const Scene s = scene([](const glm::dvec3& p) { return p.x > 0.0 ? TissueClass::liver : TissueClass::fluid; });
  const TissueAt tissue_at(s.tissue(), {});
  double last = tissue_at.speckle({-5.0, 20.0, 0.0});
  int steps = 0;
  for (double x_mm = -5.0; x_mm < 5.0; x_mm += 0.01) {
    const double here = tissue_at.speckle({x_mm, 20.0, 0.0});
    steps += here != last ? 1 : 0;
    last = here;
  }
  EXPECT_EQ(steps, 1);
}

}  // namespace
}  // namespace seldinger::imaging
