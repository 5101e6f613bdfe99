// What an MPR picture shows: hand-made cases on the borders, and the shaft's length against samples along it.
#include "sim/imaging/mpr/visibility.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <utility>

#include "tests/fixtures/allocations.h"
#include "tests/sim/imaging/mpr_scene.h"

namespace seldinger::imaging {
namespace {

static_assert(noexcept(mpr_visible(std::declval<const MprView&>(), std::declval<const std::optional<NeedlePose>&>(),
                                   std::declval<const std::optional<glm::dvec3>&>())));

// 100 × 60 pixels of 0.5 mm in the plane z = 0: |x| ≤ 25, |y| ≤ 15 up to the outer edges.
MprView flat_view() {
  MprView view;
  view.width_px = 100;
  view.height_px = 60;
  view.pixel_mm = 0.5;
  return view;
}

NeedlePose needle_at(glm::dvec3 tip_mm, glm::dvec3 direction, double length_mm = 200.0) {
  return {.tip_lps_mm = tip_mm, .direction = direction, .length_mm = length_mm};
}

TEST(MprVisible, TheTipIsVisibleUpToTheBordersAndTwoMillimetresFromThePlane) {
  struct {
    glm::dvec3 tip_mm;
    bool visible;
  } const cases[] = {
      {{0.0, 0.0, 0.0}, true},     {{25.0, 0.0, 0.0}, true},     {{-25.0, 15.0, 0.0}, true},
      {{25.001, 0.0, 0.0}, false}, {{0.0, -15.001, 0.0}, false}, {{0.0, 0.0, 2.0}, true},
      {{0.0, 0.0, -2.0}, true},    {{0.0, 0.0, 2.001}, false},   {{0.0, 0.0, -2.001}, false},
      {{25.0, 15.0, 2.0}, true},   {{24.9, 14.9, 1.9}, true},    {{-30.0, 0.0, 0.0}, false},
  };
  for (const auto& c : cases) {
    const NeedlePose needle = needle_at(c.tip_mm, {0.0, 0.0, 1.0});
    EXPECT_EQ(mpr_visible(flat_view(), needle, std::nullopt).needle_tip, c.visible)
        << c.tip_mm.x << ' ' << c.tip_mm.y << ' ' << c.tip_mm.z;
    const Visible target = mpr_visible(flat_view(), std::nullopt, c.tip_mm);
    EXPECT_EQ(target.target, c.visible);
    EXPECT_FALSE(target.needle_tip);
    EXPECT_FALSE(target.joint);
    EXPECT_EQ(target.needle_length_mm, 0.0);
  }
}

TEST(MprVisible, JointNeedsBoth) {
  const glm::dvec3 in{0.0, 0.0, 0.0}, out{0.0, 0.0, 10.0}, direction{1.0, 0.0, 0.0};
  EXPECT_TRUE(mpr_visible(flat_view(), needle_at(in, direction), in).joint);
  EXPECT_FALSE(mpr_visible(flat_view(), needle_at(out, direction), in).joint);
  EXPECT_FALSE(mpr_visible(flat_view(), needle_at(in, direction), out).joint);
  EXPECT_FALSE(mpr_visible(flat_view(), std::nullopt, in).joint);
}

TEST(MprVisible, TheShaftIsAsLongAsItsPartInTheBox) {
  const auto length = [](glm::dvec3 tip_mm, glm::dvec3 direction, double length_mm = 200.0) {
    return mpr_visible(flat_view(), needle_at(tip_mm, direction, length_mm), std::nullopt).needle_length_mm;
  };
  EXPECT_NEAR(length({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}), 25.0, 1e-12);         // from the left border to the tip
  EXPECT_NEAR(length({100.0, 0.0, 0.0}, {1.0, 0.0, 0.0}), 50.0, 1e-12);       // right through
  EXPECT_NEAR(length({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 7.0), 7.0, 1e-12);     // all of it
  EXPECT_NEAR(length({0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}), 2.0, 1e-12);          // down to the lower limit of the slab
  EXPECT_NEAR(length({0.0, 0.0, 100.0}, {0.0, 0.0, 1.0}), 4.0, 1e-12);        // through the slab
  EXPECT_NEAR(length({0.0, 0.0, 100.0}, {0.6, 0.0, 0.8}, 50.0), 0.0, 1e-12);  // ends above it
  EXPECT_NEAR(length({3.0, 0.0, 4.0}, {0.6, 0.0, 0.8}), 5.0, 1e-12);          // 4 mm of height at 0.8
  EXPECT_NEAR(length({-26.0, 0.0, 0.0}, {1.0, 0.0, 0.0}), 0.0, 1e-12);        // not there yet
  EXPECT_NEAR(length({0.0, 0.0, 2.0}, {1.0, 0.0, 0.0}), 25.0, 1e-12);         // along the slab's limit
  EXPECT_NEAR(length({0.0, 0.0, 2.0000001}, {1.0, 0.0, 0.0}), 0.0, 1e-12);
}

TEST(MprVisible, AgreesWithSamplesAlongTheShaft) {
  constexpr int kSamples = 4000;
  base::Rng rng(41);
  int partly = 0;
  for (int trial = 0; trial < 1500; ++trial) {
    const MprView view =
        random_view(rng, {7.0, -3.0, 200.0}, 5.0, 0.5, 30 + trial % 50, 20 + trial % 70, Interpolation::linear);
    NeedlePose needle = needle_at(view.center_lps_mm + 20.0 * rng.uniform() * random_direction(rng),
                                  random_direction(rng), 5.0 + 80.0 * rng.uniform());
    if (trial % 2 == 0) needle.direction = glm::normalize(view.u * 1.5 + view.v + 0.2 * random_direction(rng));
    const glm::dvec3 target_mm = view.center_lps_mm + 6.0 * random_direction(rng);
    const auto inside = [&](const glm::dvec3& p_mm) {
      const glm::dvec3 off_mm = p_mm - view.center_lps_mm;
      return std::abs(glm::dot(off_mm, view.u)) <= view.width_px * view.pixel_mm / 2.0 &&
             std::abs(glm::dot(off_mm, view.v)) <= view.height_px * view.pixel_mm / 2.0 &&
             std::abs(glm::dot(off_mm, glm::cross(view.u, view.v))) <= 2.0;
    };
    int in = 0;
    for (int i = 0; i < kSamples; ++i)
      if (inside(needle.tip_lps_mm - needle.direction * (needle.length_mm * (i + 0.5) / kSamples))) ++in;
    const Visible visible = mpr_visible(view, needle, target_mm);
    ASSERT_NEAR(visible.needle_length_mm, needle.length_mm * in / kSamples, 1.01 * needle.length_mm / kSamples);
    ASSERT_EQ(visible.needle_tip, inside(needle.tip_lps_mm));
    ASSERT_EQ(visible.target, inside(target_mm));
    ASSERT_EQ(visible.joint, visible.needle_tip && visible.target);
    if (in > 0 && in < kSamples) ++partly;
  }
  EXPECT_GT(partly, 300);
}

TEST(MprVisible, SeesNothingOfALostNeedle) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const NeedlePose lost[] = {
      needle_at({kNan, 0.0, 0.0}, {1.0, 0.0, 0.0}), needle_at({0.0, 0.0, kNan}, {1.0, 0.0, 0.0}),
      needle_at({100.0, 0.0, 0.0}, {1.0, kNan, 0.0}), needle_at({100.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, kNan)};
  for (const NeedlePose& needle : lost) {
    const Visible visible = mpr_visible(flat_view(), needle, glm::dvec3(0.0, kNan, 0.0));
    EXPECT_FALSE(visible.needle_tip);
    EXPECT_EQ(visible.needle_length_mm, 0.0);
    EXPECT_FALSE(visible.target);
  }
}

TEST(MprVisible, AllocatesNothing) {
  const MprView view = flat_view();
  const NeedlePose needle = needle_at({1.0, 2.0, 0.0}, {0.8, 0.0, 0.6});
  const long before = fixtures::allocations();
  const Visible visible = mpr_visible(view, needle, glm::dvec3(0.0));
  const long after = fixtures::allocations();
  EXPECT_EQ(after, before);
  EXPECT_TRUE(visible.joint);
  const std::vector<double> one(1);  // the count counts
  EXPECT_GT(fixtures::allocations(), after);
}

}  // namespace
}  // namespace seldinger::imaging
