// Tests of sim/haptics/fit and what it stands on: planted parameters come back within the error that is stated, the
// needle law's lines too, one start is not enough, and what is no insertion is refused.
#include "sim/haptics/fit/fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "sim/base/rng.h"
#include "sim/haptics/needle/insertion.h"

namespace seldinger::haptics {
namespace {

using volume::TissueClass;
using Curve = std::vector<DepthForce>;

const PlateauModel kPlanted{0.012, 0.9, 2.1, 7.3, 0.4, 0.8};

Curve curve_of(const std::function<double(double)>& force_n, int rows, double deepest_mm, double noise_n,
               std::uint64_t seed) {
  Curve curve;
  for (int i = 0; i < rows; ++i) {
    const double depth_mm = deepest_mm * i / (rows - 1);
    curve.push_back({depth_mm, force_n(depth_mm) + noise_n * base::normal_at(seed, static_cast<std::uint64_t>(i))});
  }
  return curve;
}

Curve planted(double noise_n, std::uint64_t seed, int rows = 500) {
  return curve_of([](double depth_mm) { return kPlanted.force_n(depth_mm); }, rows, 50.0, noise_n, seed);
}

// As `haptics insert` writes it at the thesis' 500 mm/min.
Curve inserted(TissueClass tissue, double noise_n = 0.0) {
  const Insertion insertion{needle_tissue(tissue), 500.0 / 60.0, 60.0};
  Curve curve;
  for (const InsertionSample& sample : insert(insertion, {}))
    curve.push_back({sample.depth_mm, sample.force.axial_n + noise_n * base::normal_at(5, curve.size())});
  return curve;
}

std::vector<std::string> codes_of(const base::Error& error) {
  std::vector<std::string> codes{error.code};
  for (const base::Problem& finding : error.findings) codes.push_back(finding.code);
  return codes;
}

TEST(ForceModels, TheirGradientsAreTheirDifferences) {
  const double h = 1e-6;
  for (const double depth_mm : {-1.0, 0.0, 2.0, 7.0, 7.5, 9.0, 40.0}) {
    auto parameters = kPlanted.parameters();
    double gradient[PlateauModel::kParameters];
    kPlanted.force_n(depth_mm, gradient);
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      auto up = parameters, down = parameters;
      up[i] += h;
      down[i] -= h;
      const double slope =
          (PlateauModel::of(up.data()).force_n(depth_mm) - PlateauModel::of(down.data()).force_n(depth_mm)) /
          (2.0 * h);
      EXPECT_NEAR(gradient[i], slope, 1e-6) << "depth " << depth_mm << ", parameter " << i;
    }
    const Gaussian part{1.3, 5.0, 2.5};
    double of_part[Gaussian::kParameters];
    part.force_n(depth_mm, of_part);
    EXPECT_NEAR(of_part[0], part.force_n(depth_mm) / 1.3, 1e-12);
    const auto differs = [&](const Gaussian& up, const Gaussian& down) {
      return (up.force_n(depth_mm) - down.force_n(depth_mm)) / (2.0 * h);
    };
    EXPECT_NEAR(of_part[1], differs({1.3, 5.0 + h, 2.5}, {1.3, 5.0 - h, 2.5}), 1e-6);
    EXPECT_NEAR(of_part[2], differs({1.3, 5.0, 2.5 + h}, {1.3, 5.0, 2.5 - h}), 1e-6);
  }
}

TEST(ForceModels, MeetWhereTheCapsuleOpensAndEndOnTheLine) {
  EXPECT_EQ(kPlanted.force_n(0.0), 0.0);
  EXPECT_NEAR(kPlanted.force_n(kPlanted.dent_mm), kPlanted.rupture_n, 1e-12);
  EXPECT_NEAR(kPlanted.force_n(kPlanted.dent_mm - 1e-9), kPlanted.rupture_n, 1e-8);
  EXPECT_NEAR(kPlanted.force_n(50.0), 0.012 * 50.0 + 0.9, 1e-12);
  const double fallen_n = kPlanted.rupture_n - kPlanted.line_n(kPlanted.dent_mm);
  EXPECT_NEAR(kPlanted.force_n(kPlanted.plateau_mm()) - kPlanted.line_n(kPlanted.plateau_mm()), 0.01 * fallen_n,
              1e-12);
  EXPECT_NEAR((Gaussian{2.0, 5.0, 3.0}.force_n(8.0)), 2.0 * std::exp(-0.5), 1e-12) << "sigma is one";
}

TEST(FitPlateau, FindsExactParametersInAnExactCurve) {
  const auto fit = fit_plateau(planted(0.0, 1));
  ASSERT_TRUE(fit);
  const auto found = fit->model.parameters(), there = kPlanted.parameters();
  for (std::size_t i = 0; i < there.size(); ++i) EXPECT_NEAR(found[i], there[i], 1e-5 * there[i]) << i;
  EXPECT_LT(fit->quality.rmse_n, 1e-6);
  EXPECT_LT(fit->plateau_rmse_n, 0.01) << "what is left of the fall";
  EXPECT_TRUE(fit->capsule);
}

// Twenty draws of noise: the planted parameters lie within the stated standard errors as often as they should.
TEST(FitPlateau, StatesItsErrorUnderNoise) {
  constexpr double kNoiseN = 0.05;
  int within_two = 0, all = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto fit = fit_plateau(planted(kNoiseN, 100 + seed), 12);
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->quality.rmse_n, kNoiseN, 0.1 * kNoiseN);
    const auto found = fit->model.parameters(), error = fit->standard_error.parameters(),
               there = kPlanted.parameters();
    for (std::size_t i = 0; i < there.size(); ++i) {
      ASSERT_GT(error[i], 0.0);
      EXPECT_LE(std::abs(found[i] - there[i]), 4.0 * error[i]) << "seed " << seed << ", parameter " << i;
      if (i == 2 || i == 3) continue;  // known no better than the points lie apart
      within_two += std::abs(found[i] - there[i]) <= 2.0 * error[i];
      ++all;
    }
    EXPECT_LE(error[0], 3e-4) << "N/mm";
    EXPECT_LE(error[1], 0.012) << "N";
    EXPECT_LE(error[3], 0.1) << "mm";
  }
  EXPECT_GE(within_two, all * 85 / 100) << "of " << all << "; 95 % are due";
  EXPECT_LT(within_two, all) << "an error that always suffices is stated too large";
}

// The thesis' lines, through our own law: 0.010 x + 1.53 and 0.020 x + 0.38.
TEST(FitPlateau, GivesBackTheLinesOfTheNeedleLaw) {
  for (const TissueClass tissue : {TissueClass::kidney, TissueClass::liver})
    for (const double noise_n : {0.0, 0.05}) {
      const NeedleTissue& row = needle_tissue(tissue);
      const auto fit = fit_plateau(inserted(tissue, noise_n));
      ASSERT_TRUE(fit);
      EXPECT_NEAR(fit->model.slope_n_mm, row.slope_n_mm, noise_n > 0.0 ? 2e-4 : 5e-6);
      EXPECT_NEAR(fit->model.intercept_n, row.intercept_n, noise_n > 0.0 ? 0.006 : 0.001);
      EXPECT_NEAR(fit->model.rupture_n, row.rupture_n, 0.03);
      EXPECT_NEAR(fit->model.dent_mm, row.dent_mm, 0.05);
      EXPECT_LE(fit->quality.rmse_n, noise_n + 0.002);
      EXPECT_LE(std::abs(fit->plateau_rmse_n - noise_n), 0.001);
      EXPECT_TRUE(fit->capsule);
    }
}

TEST(FitPlateau, EndsInAWrongValleyFromOneStart) {
  const Curve curve = inserted(TissueClass::kidney);
  const auto one = fit_plateau(curve, 1), many = fit_plateau(curve);
  ASSERT_TRUE(one && many);
  EXPECT_GT(one->quality.rmse_n, 0.1);
  EXPECT_LT(many->quality.rmse_n, 0.002);
  EXPECT_EQ(many->quality.starts, kPlateauStarts);
  EXPECT_GE(many->quality.agreeing, 3);
  EXPECT_LT(many->quality.agreeing, kPlateauStarts);
  EXPECT_GT(many->quality.worst_rmse_n, 0.1);
}

TEST(FitPlateau, SaysWhereNoCapsuleStandsOut) {
  const auto fit = fit_plateau(curve_of(
      [](double depth_mm) { return std::min(0.3 * depth_mm, 0.6 + 0.01 * depth_mm); }, 400, 50.0, 0.03, 3));
  ASSERT_TRUE(fit);
  EXPECT_FALSE(fit->capsule);
  EXPECT_NEAR(fit->model.slope_n_mm, 0.01, 0.001);
  EXPECT_NEAR(fit->model.intercept_n, 0.6, 0.03);
}

TEST(FitPlateau, IsTheSameForTheSameCurve) {
  const Curve curve = planted(0.05, 9, 200);
  const auto once = fit_plateau(curve), again = fit_plateau(curve);
  ASSERT_TRUE(once && again);
  EXPECT_EQ(once->model.parameters(), again->model.parameters());
  const auto gaussians = fit_gaussians(curve, 3, 4), gaussians_again = fit_gaussians(curve, 3, 4);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(gaussians.model.parts[k].height_n, gaussians_again.model.parts[k].height_n);
    EXPECT_EQ(gaussians.model.parts[k].centre_mm, gaussians_again.model.parts[k].centre_mm);
  }
}

TEST(FitPlateau, RefusesACurveThatOnlyRises) {
  const auto fit =
      fit_plateau(curve_of([](double depth_mm) { return 0.002 * depth_mm * depth_mm; }, 200, 40.0, 0, 1));
  ASSERT_FALSE(fit);
  EXPECT_EQ(fit.error().code, "no_plateau");
}

TEST(FitGaussians, FindsPlantedOnesUnderNoise) {
  const GaussianSum there{{{1.8, 10.0, 2.0}, {1.2, 24.0, 5.0}, {0.9, 44.0, 6.0}}};
  const auto force = [&](double depth_mm) { return there.force_n(depth_mm); };
  for (const double noise_n : {0.0, 0.02}) {
    const GaussianFit fit = fit_gaussians(curve_of(force, 400, 55.0, noise_n, 4), 3);
    ASSERT_EQ(fit.model.parts.size(), 3U);
    EXPECT_NEAR(fit.quality.rmse_n, noise_n, 0.1 * noise_n + 1e-6);
    // Under noise of 0.02 N the parameters' standard errors are some 0.01 N and 0.03 mm, so these are above four.
    const double tolerance = noise_n > 0.0 ? 0.15 : 1e-4;
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(fit.model.parts[k].height_n, there.parts[k].height_n, 0.3 * tolerance) << k;
      EXPECT_NEAR(fit.model.parts[k].centre_mm, there.parts[k].centre_mm, tolerance) << k;
      EXPECT_NEAR(fit.model.parts[k].sigma_mm, there.parts[k].sigma_mm, tolerance) << k;
    }
  }
}

// Three close together, of which the first, even start has only one nearby: what lies beside does nothing, and is
// moved to where most is left.
TEST(FitGaussians, NeedMoreThanTheFirstStart) {
  const GaussianSum there{{{1.8, 6.0, 1.2}, {1.2, 11.0, 1.5}, {0.9, 16.0, 1.5}}};
  const Curve curve = curve_of([&](double depth_mm) { return there.force_n(depth_mm); }, 400, 55.0, 0.0, 4);
  const GaussianFit moved = fit_gaussians(curve, 3, 1);
  EXPECT_GT(moved.quality.starts, 1);
  EXPECT_GT(moved.quality.worst_rmse_n, 0.1) << "the first start alone";
  EXPECT_LT(moved.quality.rmse_n, 1e-6);
  const GaussianFit many = fit_gaussians(curve, 3);
  EXPECT_LT(many.quality.rmse_n, 1e-6);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(many.model.parts[k].centre_mm, there.parts[k].centre_mm, 1e-5) << k;
}

// Issue 5: RMSE at most 0.10 N, goal 0.065 N, by the thesis' eight and six.
TEST(FitGaussians, FollowTheThesisTissues) {
  for (const auto& [tissue, gaussians] : {std::pair{TissueClass::kidney, 8}, {TissueClass::liver, 6}}) {
    const GaussianFit fit = fit_gaussians(inserted(tissue), gaussians);
    EXPECT_LE(fit.quality.rmse_n, 0.065);
    EXPECT_LE(fit.quality.agreeing, fit.quality.starts / 2) << "valleys";
    EXPECT_GE(fit.quality.worst_rmse_n, 2.0 * fit.quality.rmse_n);
  }
}

TEST(DepthCurve, IsTheWayInOnly) {
  Curve rows = planted(0.0, 1);
  const std::size_t in = rows.size();
  for (int i = 0; i < 100; ++i) rows.push_back({50.0, 9.0});
  for (int i = 0; i < 100; ++i) rows.push_back({50.0 - 0.5 * i, -0.4});
  const auto curve = insertion_in(rows);
  ASSERT_TRUE(curve);
  EXPECT_EQ(curve->size(), in);
  EXPECT_LT(curve->back().force_n, 2.0);
}

TEST(DepthCurve, RefusesWhatIsNoneAndSaysAllThatIsWrong) {
  using testing::ElementsAre;
  const auto refused = [](const Curve& rows) {
    const auto curve = insertion_in(rows);
    return curve ? std::vector<std::string>{"accepted"} : codes_of(curve.error());
  };
  EXPECT_THAT(refused({}), ElementsAre("too_few_rows"));
  EXPECT_THAT(refused(planted(0.0, 1)), ElementsAre("accepted"));
  for (const double no_number :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Curve rows = planted(0.0, 1);
    rows[70].force_n = no_number;
    EXPECT_THAT(refused(rows), ElementsAre("not_finite"));
    rows = planted(0.0, 1);
    rows[70].depth_mm = no_number;
    EXPECT_THAT(refused(rows), ElementsAre("not_finite"));
  }
  for (const DepthForce& far : {DepthForce{60.0, 1e308}, {60.0, -501.0}, {1001.0, 2.0}, {-1e300, 2.0}}) {
    Curve rows = planted(0.0, 1);
    rows.push_back(far);
    EXPECT_THAT(refused(rows), ElementsAre("out_of_range")) << far.depth_mm << " mm, " << far.force_n << " N";
  }
  EXPECT_THAT(refused(planted(0.0, 1, 49)), ElementsAre("too_few_rows"));
  EXPECT_THAT(refused(Curve(200, {0.0, 1.0})), ElementsAre("too_shallow", "too_few_rows")) << "depth does not rise";
  Curve rows = planted(0.0, 1);
  for (DepthForce& row : rows) row.depth_mm *= 0.29;
  EXPECT_THAT(refused(rows), ElementsAre("too_shallow"));
  rows = planted(0.0, 1);
  for (DepthForce& row : rows) row = {row.depth_mm + 2.0, -row.force_n - 0.1};
  EXPECT_THAT(refused(rows), ElementsAre("starts_late", "no_resistance"));
  rows = planted(0.0, 1);
  rows[300].depth_mm -= 5.0;
  EXPECT_THAT(refused(rows), ElementsAre("not_one_insertion"));
  rows[300].depth_mm += 4.5;
  EXPECT_THAT(refused(rows), ElementsAre("accepted")) << "an encoder's noise";
}

TEST(DepthCurve, ThinnedCountsASlowStretchOnce) {
  Curve rows;
  for (int i = 0; i < 1000; ++i) rows.push_back({0.01 * i, 1.0});
  for (int i = 0; i <= 50; ++i) rows.push_back({10.0 + 0.2 * i, 3.0});
  const auto means = thinned(rows, 20);
  ASSERT_EQ(means.size(), 20U);
  double sum_n = 0.0;
  for (const DepthForce& point : means) sum_n += point.force_n;
  EXPECT_NEAR(sum_n / 20.0, 2.0, 1e-9);
  EXPECT_EQ(thinned(rows, 5000).size(), rows.size());
}

}  // namespace
}  // namespace seldinger::haptics
