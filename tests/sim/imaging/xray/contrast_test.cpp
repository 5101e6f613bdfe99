// Contrast medium in path lengths: as much as there is, where it came out, and where tissue has taken it.
#include "sim/imaging/xray/contrast.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sim/imaging/xray/beam/attenuation.h"
#include "sim/imaging/xray/exposure.h"
#include "tests/sim/imaging/xray/xray_scene.h"

namespace seldinger::imaging {
namespace {

// A calyx of 0.9 ml, and 40 mm below it a pelvis of 4.2 ml; a duct joins them.
cases::Case kidney() {
  cases::Case scene;
  scene.volume = volume::make_volume({90, 70, 110}, glm::dvec3(1.0), glm::dmat3(1.0), {-45.0, -35.0, -55.0});
  scene.structures = {
      {"calyx", volume::TissueClass::fluid, cases::StructureRule::target, cases::Sphere{{0, 0, 20}, 6.0}},
      {"ureter", volume::TissueClass::fluid, cases::StructureRule::advisory,
       cases::Tube{{{0, 0, 18}, {0, 0, -18}}, 2.0}},
      {"renal_pelvis", volume::TissueClass::fluid, cases::StructureRule::major, cases::Sphere{{0, 0, -20}, 10.0}}};
  return scene;
}

cases::NeedleFlow pool(std::int32_t lumen, const glm::dvec3& at, double spread_ml, double contrast_ml) {
  cases::NeedleFlow flow;
  flow.pools[2] = {lumen, at, spread_ml, contrast_ml};
  return flow;
}

// A trunk that breathes about the origin, as far as it goes there.
tissue::Displacement breathed_in() {
  tissue::Breath breath;
  breath.region.half_width_mm = 160.0;
  breath.amount_mm = glm::dvec3(2.0, 8.0, 12.0);
  return tissue::displacement_of({.breath = breath});
}

// Parallel rays along y, a pixel of 0.5 mm: the sum over the picture is the volume.
XrayGeometry along_y() {
  XrayGeometry g;
  g.direction = {0.0, 1.0, 0.0};
  g.detector_center_lps_mm = {0.0, 200.0, 0.0};
  g.u = {1.0, 0.0, 0.0};
  g.v = {0.0, 0.0, -1.0};
  g.pixel_mm = 0.5;
  g.width_px = g.height_px = 220;
  return g;
}

double ml_in(const std::vector<float>& lengths_mm, const XrayGeometry& g) {
  return std::accumulate(lengths_mm.begin(), lengths_mm.end(), 0.0) * g.pixel_mm * g.pixel_mm / 1000.0;
}

// Of the contrast in a picture, how far towards the head: mean and highest of z.
double mean_z_mm(const std::vector<float>& lengths_mm, const XrayGeometry& g) {
  double sum = 0.0, weighed = 0.0;
  for (std::size_t i = 0; i < lengths_mm.size(); ++i) {
    const auto row = static_cast<double>(i / static_cast<std::size_t>(g.width_px));
    sum += static_cast<double>(lengths_mm[i]);
    weighed += static_cast<double>(lengths_mm[i]) * (0.5 * (g.height_px - 1) - row) * g.pixel_mm;
  }
  return weighed / sum;
}

TEST(ContrastMedium, IsAsMuchAsThereIs) {
  const cases::Case scene = kidney();
  const tissue::Lumens lumens(scene);
  const glm::dvec3 calyx{0, 0, 20};
  const std::int32_t system = lumens.at(calyx);
  ContrastMedium medium(scene.volume, lumens);
  EXPECT_FALSE(medium.take({}));
  const XrayGeometry g = along_y();
  for (const auto& [lumen, spread_ml, contrast_ml] :
       {std::tuple{system, 0.5, 0.5}, {system, 2.0, 1.9}, {system, 5.0, 0.3}, {-1, 0.7, 0.7}, {-1, 14.0, 14.0}}) {
    ASSERT_TRUE(medium.take(pool(lumen, calyx, spread_ml, contrast_ml)));
    EXPECT_NEAR(ml_in(medium.lengths_mm(g, {}, 1), g), contrast_ml, 0.01 * contrast_ml)
        << lumen << ' ' << spread_ml;
  }
}

TEST(ContrastMedium, FillsTheLumenFromWhereItCameOut) {
  const cases::Case scene = kidney();
  const tissue::Lumens lumens(scene);
  ContrastMedium medium(scene.volume, lumens);
  const XrayGeometry g = along_y();
  double last_mm = 1e9;
  for (const double ml : {0.4, 0.8, 1.5, 3.0, 5.0}) {
    ASSERT_TRUE(medium.take(pool(lumens.at({0, 0, 20}), {0, 0, 24}, ml, ml)));
    const double now_mm = mean_z_mm(medium.lengths_mm(g, {}, 1), g);
    EXPECT_LT(now_mm, last_mm) << "on towards the pelvis";
    last_mm = now_mm;
  }
  EXPECT_LT(last_mm, -5.0);
  ASSERT_TRUE(medium.take(pool(lumens.at({0, 0, 20}), {0, 0, -20}, 0.8, 0.8)));
  EXPECT_NEAR(mean_z_mm(medium.lengths_mm(g, {}, 1), g), -20.0, 0.7) << "from the pelvis, the pelvis first";
  // In tissue beside it a ball about the tip.
  ASSERT_TRUE(medium.take(pool(-1, {20, 0, 5}, 1.0, 1.0)));
  const std::vector<float> depot = medium.lengths_mm(g, {}, 1);
  EXPECT_NEAR(mean_z_mm(depot, g), 5.0, 0.5);
  EXPECT_NEAR(static_cast<double>(*std::max_element(depot.begin(), depot.end())), 12.4, 1.5);
}

TEST(ContrastMedium, MovesWithTheTissue) {
  const cases::Case scene = kidney();
  const tissue::Lumens lumens(scene);
  ContrastMedium medium(scene.volume, lumens);
  const XrayGeometry g = along_y();
  ASSERT_TRUE(medium.take(pool(lumens.at({0, 0, 20}), {0, 0, 20}, 0.8, 0.8)));
  const std::vector<float> still = medium.lengths_mm(g, {}, 1);
  const tissue::Displacement moved = breathed_in();
  const double down_mm = tissue::displaced(moved, {0, 0, 20}).z - 20.0;
  const std::vector<float> breathed = medium.lengths_mm(g, moved, 1);
  EXPECT_NEAR(mean_z_mm(breathed, g) - mean_z_mm(still, g), down_mm, 1.0);
  EXPECT_NEAR(ml_in(breathed, g), ml_in(still, g), 0.1 * ml_in(still, g));
}

// Iodine darkens a beam, most just above its K edge, and no amount of it breaks the sum.
TEST(ContrastMedium, WeakensTheBeamAsItsIodineDoes) {
  EXPECT_GT(attenuation_at(33.3).contrast_per_mm, 4.0 * attenuation_at(33.0).contrast_per_mm);
  const cases::Fluoroscope machine;
  Beams beams(machine);
  for (const double kv : {45.0, 70.0, 110.0}) {
    const BeamSignal& beam = beams.at(kv);
    double last = beam.log_share(200.0, 0.0);
    for (const double mm : {0.1, 1.0, 5.0, 30.0, 200.0}) {
      const double log_share = beam.log_share(200.0, 0.0, 0.0, mm);
      EXPECT_LT(log_share, last) << kv << ' ' << mm;
      EXPECT_TRUE(std::isfinite(log_share));
      last = log_share;
      const auto water_mm = 200.0F, contrast_mm = static_cast<float>(mm);
      float by_table = 0.0F;
      beam.log_shares(&water_mm, nullptr, nullptr, &contrast_mm, 1, &by_table);
      EXPECT_NEAR(static_cast<double>(by_table), log_share, 1e-3 + 1e-5 * std::abs(log_share));
    }
  }
}

}  // namespace
}  // namespace seldinger::imaging
