// The view under a probe and the grey map.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "tests/sim/imaging/mpr_scene.h"

namespace seldinger::imaging {
namespace {

TEST(ViewUnderProbe, HasTheMiddleOfItsUpperEdgeAtTheProbe) {
  base::Rng rng(31);
  for (int trial = 0; trial < 20; ++trial) {
    const glm::dmat3 turn = random_rotation(rng);
    const glm::dvec3 origin_mm{10.0, -20.0, 300.0 + trial};
    const MprView view = view_under_probe(origin_mm, turn[1], turn[0], 120.0, 150.0, 0.5);
    EXPECT_EQ(view.width_px, 240);
    EXPECT_EQ(view.height_px, 300);
    EXPECT_EQ(view.u, turn[0]);
    EXPECT_EQ(view.v, turn[1]);
    const glm::dvec3 middle_of_first_row_mm =
        0.5 * (pixel_lps_mm(view, 0, 0) + pixel_lps_mm(view, view.width_px - 1, 0));
    EXPECT_NEAR(glm::distance(middle_of_first_row_mm - 0.25 * view.v, origin_mm), 0.0, 1e-9);
    const glm::dvec3 last_row_mm = pixel_lps_mm(view, 0, view.height_px - 1);
    EXPECT_NEAR(glm::dot(last_row_mm - origin_mm, view.v), 150.0 - 0.25, 1e-9);
  }
}

TEST(ViewUnderProbe, RoundsToWholePixelsAndKeepsTheUpperEdge) {
  const MprView view = view_under_probe({0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}, 10.0, 10.0, 3.0);
  EXPECT_EQ(view.width_px, 3);
  EXPECT_EQ(view.height_px, 3);
  EXPECT_NEAR(pixel_lps_mm(view, 1, 0).z, 1.5, 1e-12);
  const MprView tiny = view_under_probe({0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}, 0.1, 0.1, 3.0);
  EXPECT_EQ(tiny.width_px, 1);
  EXPECT_EQ(tiny.height_px, 1);
}

TEST(GreyFromHu, MapsTheWindowToBlackAndWhite) {
  const HuImage hu{-1024, -161, -160, 40, 40.4F, 41, 240, 241, 3071};  // centre 40, width 400: −160 … 240
  EXPECT_EQ(grey_from_hu(hu, 40.0, 400.0), (std::vector<unsigned char>{0, 0, 0, 128, 128, 128, 255, 255, 255}));
  EXPECT_EQ(grey_from_hu({0, 51, 102, 255}, 127.5, 255.0), (std::vector<unsigned char>{0, 51, 102, 255}));
}

TEST(GreyFromHu, MakesNanWhiteSoThatItIsSeen) {
  const float infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(grey_from_hu({std::numeric_limits<float>::quiet_NaN(), infinity, -infinity}, 0.0, 100.0),
            (std::vector<unsigned char>{255, 255, 0}));
}

TEST(GreyFromHu, NeverFallsWhenHuRises) {
  HuImage hu;
  for (int i = 0; i < 8000; ++i) hu.push_back(static_cast<float>(-1024 + 0.5 * i));
  const std::vector<unsigned char> grey = grey_from_hu(hu, 300.0, 1500.0);
  EXPECT_TRUE(std::is_sorted(grey.begin(), grey.end()));
  EXPECT_EQ(grey.front(), 0);
  EXPECT_EQ(grey.back(), 255);
}

}  // namespace
}  // namespace seldinger::imaging
