// Twelve of the grid of phases and voxels: bone by shares, ribs, vessels. The whole grid:
// tissue_grid_long_test.cpp.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/sim/volume/tissue/enhanced_torso.h"

namespace seldinger::volume {
namespace {

TEST(TissueGrid, BoneIsFoundInEveryPhaseAndVesselsAreNone) {
  std::printf("%-10s %-7s %9s %6s %7s %6s\n", "phase", "mm", "bone Dice", "ribs", "vessels", "urine");
  for (const TorsoPhase phase : kTorsoPhases)
    for (const glm::ivec3& spacing_mm : {glm::ivec3(2), glm::ivec3(3), glm::ivec3(5)}) {
      const EnhancedTorso torso = enhanced_torso({.phase = phase, .spacing_mm = spacing_mm});
      const Tissue found = find_tissue(torso.volume);
      const TorsoScore scored = score(torso, found);
      std::printf("%-10s %-7d %9.3f %6.3f %7.4f %6.3f\n", name_of(phase).c_str(), spacing_mm.x, scored.bone_dice,
                  scored.rib_as_bone, scored.vessel_as_bone, scored.ducts_as_bone);
      const std::string where = name_of(phase) + ", " + std::to_string(spacing_mm.x) + " mm";
      EXPECT_GE(scored.bone_dice, spacing_mm.x <= 2 ? 0.9 : 0.8) << where;
      EXPECT_GE(scored.rib_as_bone, spacing_mm.x <= 3 ? 0.95 : 0.85) << where;
      EXPECT_LE(scored.vessel_as_bone, 0.02) << where;
      EXPECT_LE(scored.ducts_as_bone, 0.05) << where;
      EXPECT_EQ(contrast_of(torso.volume, found.classes).phase, told_as(phase)) << where;
    }
}

TEST(TissueGrid, SharesOfBoneAreThoseOfTheClass) {
  const EnhancedTorso torso =
      enhanced_torso({.phase = TorsoPhase::portal, .spacing_mm = glm::ivec3(3), .metal = true});
  const Tissue found = find_tissue(torso.volume);
  std::size_t metal = 0;
  for (std::size_t at = 0; at < found.classes.size(); ++at) {
    if (found.classes[at] == TissueClass::bone) {
      ASSERT_GE(found.bone_share[at], 100) << at;
    }
    if (found.classes[at] == TissueClass::air || found.classes[at] == TissueClass::metal) {
      ASSERT_EQ(found.bone_share[at], 0) << at;
    }
    metal += found.classes[at] == TissueClass::metal ? 1 : 0;
  }
  EXPECT_GT(metal, 5U) << "a pin of 6 mm and 40 mm";
  EXPECT_LT(metal, 400U);
}

TEST(TissueGrid, LabelsWinInClassAndShare) {
  EnhancedTorso torso = enhanced_torso({.phase = TorsoPhase::arterial, .spacing_mm = glm::ivec3(5)});
  const Tissue found = find_tissue(torso.volume, &torso.truth);
  for (std::size_t at = 0; at < found.classes.size(); ++at) {
    const auto told = tissue_of_name(torso.truth.names[torso.truth.label[at]]);
    if (torso.truth.label[at] == 0 || !told) continue;
    ASSERT_EQ(found.classes[at], *told);
    ASSERT_EQ(found.bone_share[at], *told == TissueClass::bone ? 255 : 0);
  }
}

TEST(TissueGrid, TheSameVolumeGivesTheSameBytes) {
  const EnhancedTorso torso = enhanced_torso({.phase = TorsoPhase::arterial, .spacing_mm = glm::ivec3(5)});
  const Tissue once = find_tissue(torso.volume), twice = find_tissue(torso.volume);
  EXPECT_EQ(once.classes, twice.classes);
  EXPECT_EQ(once.bone_share, twice.bone_share);
}

}  // namespace
}  // namespace seldinger::volume
