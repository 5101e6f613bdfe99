// Tests of the blocks of gel: their closed form, their flat top, and what ultrasound and touch take each part for.
#include "sim/volume/gel_block.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "sim/volume/classes.h"
#include "sim/volume/tissue/find_tissue.h"

namespace seldinger::volume {
namespace {

constexpr GelBlock kBlocks[] = {GelBlock::find_the_plane, GelBlock::keep_the_tip, GelBlock::out_of_plane};

GelBlockOptions quiet(double spacing_mm = 0.8) {
  GelBlockOptions options;
  options.spacing_mm = spacing_mm;
  options.noise_sd_hu = 0.0;
  return options;
}

std::size_t voxel_at(const Volume& volume, const glm::dvec3& p_lps_mm) {
  const glm::dvec3 index(voxel_from_lps(volume) * glm::dvec4(p_lps_mm, 1.0));
  EXPECT_TRUE(inside(volume, index));
  const glm::ivec3 at(glm::floor(index + 0.5));
  return static_cast<std::size_t>(volume.index(at.x, at.y, at.z));
}

TEST(GelBlock, IsWhatItsShapesSayAtNamedPoints) {
  for (const GelBlock block : kBlocks) {
    const Phantom made = make_gel_block(block, quiet());
    const std::vector<TissueClass> classes = tissue_classes(made.volume, &made.labels);
    const Sphere ball = gel_ball(block);
    const double r_mm = ball.radius_mm;
    const struct {
      const char* what;
      glm::dvec3 p_lps_mm;
      double hu;
      TissueClass tissue;
    } kPoints[] = {
        {"air above", {0, -5, 0}, -1000, TissueClass::air},
        {"just above the top", {30, -0.5, -30}, -1000, TissueClass::air},
        {"the membrane", {30, 0.5, -30}, kGelSkinHu, TissueClass::skin},
        {"below the membrane", {30, 2.5, -30}, kGelHu, TissueClass::soft_tissue},
        {"in a corner", {79, 99, 59}, kGelHu, TissueClass::soft_tissue},
        {"the ball's middle", ball.center_mm, kGelBallHu, TissueClass::fluid},
        {"in its edge", ball.center_mm + glm::dvec3(r_mm - 1.0, 0, 0), kGelBallHu, TissueClass::fluid},
        {"out of its edge", ball.center_mm + glm::dvec3(0, r_mm + 1.0, 0), kGelHu, TissueClass::soft_tissue}};
    for (const auto& point : kPoints) {
      const std::size_t at = voxel_at(made.volume, point.p_lps_mm);
      EXPECT_EQ(made.volume.hu[at], point.hu) << point.what;
      EXPECT_EQ(classes[at], point.tissue) << point.what;
    }
  }
}

TEST(GelBlock, MeasuresWhatItSays) {
  for (const double spacing_mm : {0.8, 1.6}) {
    const Phantom made = make_gel_block(GelBlock::keep_the_tip, quiet(spacing_mm));
    const double voxel_mm3 = spacing_mm * spacing_mm * spacing_mm;
    double gel_mm3 = 0.0, ball_mm3 = 0.0;
    for (const std::uint8_t label : made.labels.label) {
      gel_mm3 += label != 0 ? voxel_mm3 : 0.0;
      ball_mm3 += made.labels.names[label] == "water" ? voxel_mm3 : 0.0;
    }
    EXPECT_NEAR(gel_mm3 / (kGelSizeMm.x * kGelSizeMm.y * kGelSizeMm.z), 1.0, 0.01) << spacing_mm;
    const double radius_mm = gel_ball(GelBlock::keep_the_tip).radius_mm;
    EXPECT_NEAR(ball_mm3 / (4.0 / 3.0 * std::numbers::pi * std::pow(radius_mm, 3.0)), 1.0, 0.03) << spacing_mm;
  }
  EXPECT_LE(GelBlockOptions{}.spacing_mm, 1.0) << "fine enough for ultrasound";
}

// Where trilinear HU cross the skin's threshold.
TEST(GelBlock, ItsTopIsFlatToHalfAVoxel) {
  const GelBlockOptions options;
  const Phantom made = make_gel_block(GelBlock::out_of_plane, options);
  const glm::dmat4 from_lps = voxel_from_lps(made.volume);
  for (double x = -78.0; x <= 78.0; x += 6.0)
    for (double z = -58.0; z <= 58.0; z += 4.0) {
      double top_mm = std::nan("");
      for (double y = 3.0; y >= -3.0 && std::isnan(top_mm); y -= 0.01)
        if (*sample_trilinear(made.volume, glm::dvec3(from_lps * glm::dvec4(x, y, z, 1.0))) < -300.0) top_mm = y;
      EXPECT_NEAR(top_mm, 0.0, 0.5 * options.spacing_mm) << x << " " << z;
    }
}

// The drills say how deep; a straight way of 45° from the top must stay in the tray.
TEST(GelBlock, BallsLieWhereTheDrillsSay) {
  for (const GelBlock block : kBlocks) {
    const Sphere ball = gel_ball(block);
    const double aside_mm = ball.center_mm.y + ball.radius_mm;
    EXPECT_GT(ball.center_mm.y - ball.radius_mm, 10.0);
    EXPECT_LT(std::abs(ball.center_mm.x) + aside_mm, kGelSizeMm.x / 2.0);
  }
  EXPECT_LE(gel_ball(GelBlock::find_the_plane).center_mm.y, 25.0) << "shallow";
  EXPECT_GE(gel_ball(GelBlock::keep_the_tip).center_mm.y, 40.0);
  EXPECT_LE(gel_ball(GelBlock::keep_the_tip).center_mm.y, 50.0);
}

TEST(GelBlock, NoiseIsTheScannersAndTheSameAgain) {
  const Phantom made = make_gel_block(GelBlock::find_the_plane), again = make_gel_block(GelBlock::find_the_plane);
  EXPECT_EQ(made.volume.hu, again.volume.hu);
  double sum = 0.0, squares = 0.0, count = 0.0;
  for (std::size_t at = 0; at < made.volume.hu.size(); ++at)
    if (made.labels.names[made.labels.label[at]] == "gel") {
      const double off = made.volume.hu[at] - kGelHu;
      sum += off;
      squares += off * off;
      ++count;
    }
  EXPECT_NEAR(sum / count, 0.0, 0.05);
  EXPECT_NEAR(std::sqrt(squares / count), GelBlockOptions{}.noise_sd_hu, 0.1);
}

}  // namespace
}  // namespace seldinger::volume
