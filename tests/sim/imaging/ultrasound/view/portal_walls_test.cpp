// Portal veins have bright walls and hepatic veins none: which voxels they are, and how bright pictures show them.
#include "sim/imaging/ultrasound/view/portal_walls.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/imaging/ultrasound/view/echogenicity.h"
#include "sim/imaging/ultrasound/view/fan.h"
#include "sim/imaging/ultrasound/view/organs.h"
#include "sim/volume/phantom.h"
#include "sim/volume/tissue/find_tissue.h"
#include "tests/sim/imaging/ultrasound/ultrasound_scene.h"

namespace seldinger::imaging {
namespace {

// A vein along z through a block, fat on one side of it.
struct VeinBlock {
  volume::Volume volume = volume::make_volume({41, 41, 9}, {1.0, 1.0, 1.5}, glm::dmat3(1.0), {-20.0, -20.0, -6.0});
  volume::LabelMap labels{std::vector<std::uint8_t>(volume.hu.size(), 0), {"none", "Portal_Vein_Left", "liver"}};
  std::vector<TissueClass> classes = std::vector<TissueClass>(volume.hu.size(), TissueClass::liver);
  std::vector<std::uint8_t> levels = std::vector<std::uint8_t>(volume.hu.size(), kNoEchoOffset);
  static constexpr double kRadiusMm = 4.0;
  VeinBlock() {
    each([&](std::size_t at, const glm::dvec3& p) {
      if (p.y > 5.0) classes[at] = TissueClass::fat;
      const bool inside = std::hypot(p.x, p.y) <= kRadiusMm;
      labels.label[at] = inside ? 1 : 2;
      if (inside) classes[at] = TissueClass::vessel;
    });
  }
  template <typename Work>
  void each(const Work& work) const {
    std::size_t at = 0;
    for (int k = 0; k < volume.size_voxels.z; ++k)
      for (int j = 0; j < volume.size_voxels.y; ++j)
        for (int i = 0; i < volume.size_voxels.x; ++i, ++at)
          work(at, glm::dvec3(volume.lps_from_voxel * glm::dvec4(i, j, k, 1.0)));
  }
};

TEST(PortalWalls, AreWhatLiesWithinTheirThicknessOfTheLumen) {
  VeinBlock block;
  PortalLumen lumen(block.volume);
  lumen.add(block.labels);
  show_portal_walls(block.volume, block.classes, lumen.voxels(), block.levels);
  const std::uint8_t wall = echo_level(organ_row(Organ::portal_wall).level_db, TissueClass::liver);
  ASSERT_GT(wall, kNoEchoOffset);
  int walls = 0;
  block.each([&](std::size_t at, const glm::dvec3& p) {
    const double beyond_mm = std::hypot(p.x, p.y) - VeinBlock::kRadiusMm;
    if (block.classes[at] != TissueClass::liver || beyond_mm > kPortalWallMm) {
      EXPECT_EQ(block.levels[at], kNoEchoOffset) << "lumen, fat and liver stay as they are";
    } else if (beyond_mm < kPortalWallMm - 1.0) {  // a voxel's size: from its middle to one of the lumen's
      EXPECT_EQ(block.levels[at], wall);
      ++walls;
    }
  });
  EXPECT_GT(walls, 100);
}

TEST(PortalWalls, NamesTellOfLabelsAndOfStructuresAlike) {
  const VeinBlock block;
  const cases::Shape tube = cases::Tube{{{0.0, 0.0, -20.0}, {0.0, 0.0, 20.0}}, VeinBlock::kRadiusMm};
  const auto lumen_of = [&](const char* name, TissueClass tissue) {
    PortalLumen lumen(block.volume);
    const std::vector<cases::Structure> one = {{name, tissue, cases::StructureRule::critical, tube}};
    lumen.add(one);
    return std::vector<std::uint8_t>(lumen.voxels().begin(), lumen.voxels().end());
  };
  PortalLumen labelled(block.volume);
  labelled.add(block.labels);
  ASSERT_FALSE(labelled.voxels().empty());
  EXPECT_TRUE(std::ranges::equal(lumen_of("right portal branch", TissueClass::vessel), labelled.voxels()));
  EXPECT_TRUE(lumen_of("hepatic_vein", TissueClass::vessel).empty());
  EXPECT_TRUE(lumen_of("portal node", TissueClass::soft_tissue).empty()) << "no vessel";
  auto levels = block.levels;
  show_portal_walls(block.volume, block.classes, {}, levels);
  EXPECT_EQ(levels, block.levels);
}

// Mean square echo without loss where the middle of the nearest voxel is marked.
struct RingPower {
  double sum = 0.0;
  int count = 0;
  double db() const { return 10.0 * std::log10(sum / count); }
};
void add_ring(const TissueVolume& tissue, const UltrasoundView& view, const std::vector<bool>& marked,
              RingPower& power) {
  PolarPicture picture;
  ultrasound_polar(tissue, view, {}, {}, picture);
  const glm::dmat4 voxel_from_lps = volume::voxel_from_lps(*tissue.volume);
  for (int b = 0; b < view.beams; ++b)
    for (int k = 20; k < view.samples; ++k) {
      const glm::dvec3 p = point_of(view, b, (k + 0.5) * view.depth_mm / view.samples);
      const glm::ivec3 i(glm::floor(glm::dvec3(voxel_from_lps * glm::dvec4(p, 1.0)) + 0.5));
      if (!marked[tissue.volume->index(i.x, i.y, i.z)]) continue;
      const double level = static_cast<double>(at(picture, b, k));
      power.sum += level * level;
      ++power.count;
    }
}

TEST(PortalWalls, PicturesShowThemAboutPortalVeinsAndNoneAboutHepaticOnes) {
  volume::Phantom torso = volume::make_phantom();
  const auto classes = volume::tissue_classes(torso.volume, &torso.labels);
  auto levels = echogenicity(torso.volume, classes);
  show_organs(torso.volume, classes, levels);
  // Liver within a wall's thickness of a vein of that name, by the very rule that draws walls.
  const auto ring_of = [&](const char* name) {
    volume::LabelMap renamed = torso.labels;
    for (std::string& one : renamed.names) one = one == name ? "portal" : "other";
    PortalLumen lumen(torso.volume);
    lumen.add(renamed);
    std::vector<std::uint8_t> before(classes.size(), 0), after = before;
    show_portal_walls(torso.volume, classes, lumen.voxels(), after);
    std::vector<bool> ring(classes.size());
    for (std::size_t i = 0; i < ring.size(); ++i) ring[i] = after[i] != before[i];
    return ring;
  };
  const std::vector<bool> portal = ring_of("portal_vein"), hepatic = ring_of("hepatic_vein");
  PortalLumen lumen(torso.volume);
  lumen.add(torso.labels);
  show_portal_walls(torso.volume, classes, lumen.voxels(), levels);
  const TissueVolume tissue{&torso.volume, classes, levels};
  RingPower of_portal, of_hepatic;
  UltrasoundView view = straight_view(60.0);
  view.beams = 64;
  view.samples = 400;
  view.attenuation_db_cm_mhz = 0.0;
  for (const glm::dvec3& from :
       std::vector<glm::dvec3>{{-54, -50, 46}, {-64, -50, 50}, {-78, -40, 76}, {-90, -40, 60}})
    for (int seed = 1; seed <= 2; ++seed) {
      view.origin_lps_mm = from;
      view.seed = static_cast<std::uint64_t>(seed);
      add_ring(tissue, view, portal, of_portal);
      add_ring(tissue, view, hepatic, of_hepatic);
    }
  ASSERT_GT(of_portal.count, 500);
  ASSERT_GT(of_hepatic.count, 500);
  printf("portal veins' walls %.1f dB over what lies about hepatic veins\n", of_portal.db() - of_hepatic.db());
  // Thinner than the slice, they blend with lumen and liver.
  EXPECT_GT(of_portal.db() - of_hepatic.db(), 4.0);
  EXPECT_LT(of_portal.db() - of_hepatic.db(), organ_row(Organ::portal_wall).level_db + 1.5);
}

}  // namespace
}  // namespace seldinger::imaging
