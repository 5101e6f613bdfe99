// Needle and lesions in the picture: which is over which, the lumen, and the slab in closed form and against a
// search along the plane's normal. For reference and cpu alike.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "tests/sim/imaging/mpr_scene.h"

namespace seldinger::imaging {
namespace {

constexpr float kTissueHu = 40.0F, kMetalHu = 3000.0F, kLumenHu = -1000.0F;

volume::Volume tissue() {
  volume::Volume volume = volume::make_volume({20, 20, 20}, glm::dvec3(10.0), glm::dmat3(1.0), glm::dvec3(-95.0));
  std::fill(volume.hu.begin(), volume.hu.end(), static_cast<std::int16_t>(kTissueHu));
  return volume;
}

MprView view_of(int width_px, int height_px, double pixel_mm, double slab_mm = 0.0) {
  MprView view;
  view.width_px = width_px;
  view.height_px = height_px;
  view.pixel_mm = pixel_mm;
  view.needle_slab_mm = slab_mm;
  return view;
}

double area_mm2(const HuImage& image, float hu, double pixel_mm) {
  return static_cast<double>(std::count(image.begin(), image.end(), hu)) * pixel_mm * pixel_mm;
}

class MprInserted : public testing::TestWithParam<NamedBackend> {};

TEST_P(MprInserted, NeedleIsOverLesionIsOverVolumeAndTheFirstLesionWins) {
  Inserted inserted;
  inserted.lesions = {{{0.0, 0.0, 0.0}, 4.0, 111.0}, {{5.0, 0.0, 0.0}, 4.0, 222.0}};
  inserted.needle = NeedlePose{.tip_lps_mm = {0.0, 2.0, 0.0}, .direction = {0.0, 1.0, 0.0}, .radius_mm = 0.5};
  // Columns at x = −10, −9, …, 10 on the line y = 0.
  const HuImage image = GetParam().render(tissue(), view_of(21, 1, 1.0), inserted);
  const auto at = [&](int x_mm) { return image[static_cast<std::size_t>(x_mm + 10)]; };
  EXPECT_EQ(at(-5), kTissueHu);
  EXPECT_EQ(at(-4), 111.0F);  // on the sphere is in it
  EXPECT_EQ(at(0), kMetalHu);
  EXPECT_EQ(at(1), 111.0F);
  EXPECT_EQ(at(4), 111.0F);
  EXPECT_EQ(at(5), 222.0F);
  EXPECT_EQ(at(9), 222.0F);
  EXPECT_EQ(at(10), kTissueHu);
}

TEST_P(MprInserted, ShapesAreShownOutsideTheVolumeToo) {
  Inserted inserted;
  inserted.lesions = {{{500.0, 0.0, 0.0}, 2.0, 60.0}};
  inserted.needle = NeedlePose{.tip_lps_mm = {504.0, 0.0, 0.0}, .direction = {-1.0, 0.0, 0.0}, .length_mm = 1.0};
  MprView view = view_of(9, 1, 1.0);
  view.center_lps_mm = {502.0, 0.0, 0.0};  // columns at 498 … 506
  EXPECT_EQ(GetParam().render(tissue(), view, inserted),
            (HuImage{60, 60, 60, 60, 60, -1024, kMetalHu, kMetalHu, -1024}));
}

TEST_P(MprInserted, TheNeedleReachesFromTheTipBackItsLength) {
  Inserted inserted;
  inserted.needle = NeedlePose{.tip_lps_mm = {3.0, 0.0, 0.0},
                               .direction = {1.0, 0.0, 0.0},
                               .length_mm = 6.0,
                               .radius_mm = 0.36,
                               .hu = 2500.0};
  const HuImage image = GetParam().render(tissue(), view_of(11, 1, 1.0), inserted);  // x = −5 … 5
  const float metal = 2500.0F, tissue = kTissueHu;
  EXPECT_EQ(image, (HuImage{tissue, tissue, metal, metal, metal, metal, metal, metal, metal, tissue, tissue}));
}

TEST_P(MprInserted, AHollowNeedleCutAcrossIsARingAroundAir) {
  Inserted inserted;
  inserted.needle =
      NeedlePose{.tip_lps_mm = {0.1, -0.2, 5.0}, .length_mm = 20.0, .radius_mm = 1.2, .inner_radius_mm = 0.7};
  constexpr double kPixelMm = 0.01;
  const HuImage image = GetParam().render(tissue(), view_of(301, 301, kPixelMm), inserted);
  EXPECT_NEAR(area_mm2(image, kLumenHu, kPixelMm), std::numbers::pi * 0.7 * 0.7, 0.01);
  EXPECT_NEAR(area_mm2(image, kMetalHu, kPixelMm), std::numbers::pi * (1.2 * 1.2 - 0.7 * 0.7), 0.02);
  inserted.needle->inner_radius_mm = 0.0;
  const HuImage solid = GetParam().render(tissue(), view_of(301, 301, kPixelMm), inserted);
  EXPECT_EQ(std::count(solid.begin(), solid.end(), kLumenHu), 0);
  EXPECT_NEAR(area_mm2(solid, kMetalHu, kPixelMm), std::numbers::pi * 1.2 * 1.2, 0.02);
}

// Parallel to the plane at height y the strip is 2·√(r² − (|y| − h/2)²) wide, or the whole 2r where the axis lies
// in the slab.
TEST_P(MprInserted, ASlabShowsAParallelNeedleAsWideAsItsNearestPart) {
  constexpr double kPixelMm = 0.005, kRadiusMm = 0.5;
  for (const double slab_mm : {0.0, 0.3, 2.0, 4.0})
    for (const double height_mm : {0.0, -0.3, 0.49, 1.2, -2.4, 2.51}) {
      Inserted inserted;
      inserted.needle = NeedlePose{.tip_lps_mm = {50.0, 0.123, height_mm},
                                   .direction = {1.0, 0.0, 0.0},
                                   .radius_mm = kRadiusMm,
                                   .inner_radius_mm = slab_mm > 0.0 ? 0.3 : 0.0};
      const MprView view = view_of(1, 401, kPixelMm, slab_mm);
      const HuImage image = GetParam().render(tissue(), view, inserted);
      const double beyond_mm = std::max(0.0, std::abs(height_mm) - 0.5 * slab_mm);
      const double width_mm = 2.0 * std::sqrt(std::max(0.0, kRadiusMm * kRadiusMm - beyond_mm * beyond_mm));
      const auto shown = static_cast<double>(std::count(image.begin(), image.end(), kMetalHu));
      EXPECT_NEAR(shown * kPixelMm, width_mm, 1.01 * kPixelMm) << slab_mm << ' ' << height_mm;
      // With a slab the needle is shown solid, also when hollow.
      EXPECT_EQ(std::count(image.begin(), image.end(), kLumenHu), 0);
    }
}

TEST_P(MprInserted, ASlabShowsANeedleSeenEndOnWhenItsTipReachesTheSlab) {
  for (const double tip_mm : {0.9, 1.1}) {
    Inserted inserted;  // comes from above, ends at z = tip
    inserted.needle = NeedlePose{.tip_lps_mm = {0.0, 0.0, tip_mm}, .direction = {0.0, 0.0, -1.0}, .radius_mm = 0.5};
    const HuImage image = GetParam().render(tissue(), view_of(201, 201, 0.01, 2.0), inserted);
    EXPECT_NEAR(area_mm2(image, kMetalHu, 0.01), tip_mm < 1.0 ? std::numbers::pi * 0.25 : 0.0, 0.01) << tip_mm;
    const HuImage cut = GetParam().render(tissue(), view_of(201, 201, 0.01, 0.0), inserted);
    EXPECT_EQ(area_mm2(cut, kMetalHu, 0.01), 0.0);
  }
}

TEST_P(MprInserted, ASlabShowsWhatASearchAlongTheNormalFinds) {
  const auto in_needle = [](const glm::dvec3& p_mm, const NeedlePose& needle, double grow_mm) {
    const glm::dvec3 off_mm = p_mm - needle.tip_lps_mm;
    const double back_mm = -glm::dot(off_mm, needle.direction);
    return back_mm >= -grow_mm && back_mm <= needle.length_mm + grow_mm &&
           glm::length(off_mm + back_mm * needle.direction) <= needle.radius_mm + grow_mm;
  };
  constexpr int kSteps = 400;
  base::Rng rng(21);
  std::size_t shown = 0, hidden = 0;
  for (int trial = 0; trial < 40; ++trial) {
    MprView view = random_view(rng, glm::dvec3(0.0), 5.0, 0.2, 45, 45, Interpolation::nearest);
    view.needle_slab_mm = 0.5 + 5.0 * rng.uniform();
    Inserted inserted;
    inserted.needle = NeedlePose{.tip_lps_mm = view.center_lps_mm + 2.0 * random_direction(rng),
                                 .direction = random_direction(rng),
                                 .length_mm = 3.0 + 5.0 * rng.uniform(),
                                 .radius_mm = 0.3 + 1.5 * rng.uniform()};
    const HuImage image = GetParam().render(tissue(), view, inserted);
    const glm::dvec3 normal = glm::cross(view.u, view.v);
    const double step_mm = view.needle_slab_mm / kSteps;
    for (int row = 0; row < view.height_px; ++row)
      for (int column = 0; column < view.width_px; ++column) {
        const glm::dvec3 p_mm = pixel_lps_mm(view, column, row);
        bool found = false, nearly = false;
        for (int i = 0; i <= kSteps; ++i) {
          const glm::dvec3 q_mm = p_mm + normal * (i * step_mm - 0.5 * view.needle_slab_mm);
          found = found || in_needle(q_mm, *inserted.needle, 0.0);
          nearly = nearly || in_needle(q_mm, *inserted.needle, step_mm);
        }
        const bool is_shown = image[static_cast<std::size_t>(row * view.width_px + column)] == kMetalHu;
        ASSERT_TRUE(is_shown || !found) << "trial " << trial << " pixel " << column << ", " << row;
        ASSERT_TRUE(!is_shown || nearly) << "trial " << trial << " pixel " << column << ", " << row;
        ++(found ? shown : hidden);
      }
  }
  EXPECT_GT(shown, 2000U);
  EXPECT_GT(hidden, 2000U);
}

TEST_P(MprInserted, LesionsAreCutThroughWhateverTheSlab) {
  Inserted inserted;
  inserted.lesions = {{{0.0, 0.0, 3.0}, 5.0, 70.0}};
  const HuImage image = GetParam().render(tissue(), view_of(201, 201, 0.05, 10.0), inserted);
  EXPECT_NEAR(area_mm2(image, 70.0F, 0.05), std::numbers::pi * 16.0, 0.3);  // radius √(5² − 3²)
}

TEST_P(MprInserted, ALostNeedleOrLesionIsNotShown) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const MprView view = view_of(15, 15, 0.1);
  const HuImage without = GetParam().render(tissue(), view, {});
  for (int field = 0; field < 5; ++field) {
    Inserted inserted;
    inserted.needle = NeedlePose{};
    inserted.lesions = {{{0.0, kNan, 0.0}, 3.0, 70.0}, {{0.0, 0.0, 0.0}, kNan, 70.0}};
    if (field == 0) inserted.needle->tip_lps_mm.y = kNan;
    if (field == 1) inserted.needle->direction.x = kNan;
    if (field == 2) inserted.needle->length_mm = kNan;
    if (field == 3) inserted.needle->radius_mm = kNan;
    if (field == 4) inserted.needle->tip_lps_mm.z = std::numeric_limits<double>::infinity();
    EXPECT_EQ(GetParam().render(tissue(), view, inserted), without) << field;
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, MprInserted, testing::ValuesIn(kBackends),
                         [](const auto& backend) { return backend.param.name; });

}  // namespace
}  // namespace seldinger::imaging
