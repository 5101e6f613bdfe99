// The whole grid: phases x voxels x noise x metal.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/sim/volume/tissue/enhanced_torso.h"

namespace seldinger::volume {
namespace {

class TissueGridLong : public testing::TestWithParam<glm::ivec3> {};

TEST_P(TissueGridLong, BoneIsFoundWhateverThePhaseTheNoiseAndMetal) {
  const glm::ivec3 spacing_mm = GetParam();
  for (const TorsoPhase phase : kTorsoPhases)
    for (const bool metal : {false, true})
      for (const double noise_sd_hu : {6.0, 12.0, 20.0}) {
        const EnhancedTorso torso =
            enhanced_torso({.phase = phase, .spacing_mm = spacing_mm, .noise_sd_hu = noise_sd_hu, .metal = metal});
        const Tissue found = find_tissue(torso.volume);
        const TorsoScore scored = score(torso, found);
        const std::string where = name_of(phase) + ", " + std::to_string(spacing_mm.x) + " x " +
                                  std::to_string(spacing_mm.z) + " mm, noise " +
                                  std::to_string(static_cast<int>(noise_sd_hu)) + (metal ? ", metal" : "");
        std::printf("%-40s %.3f %.3f %.4f %.3f\n", where.c_str(), scored.bone_dice, scored.rib_as_bone,
                    scored.vessel_as_bone, scored.ducts_as_bone);
        std::fflush(stdout);
        EXPECT_GE(scored.bone_dice, spacing_mm.z <= 2 ? 0.9 : 0.8) << where;
        EXPECT_GE(scored.rib_as_bone, 0.85) << where;
        EXPECT_LE(scored.vessel_as_bone, 0.02) << where;
        EXPECT_EQ(contrast_of(torso.volume, found.classes).phase, told_as(phase)) << where;
      }
}

INSTANTIATE_TEST_SUITE_P(Voxels, TissueGridLong,
                         testing::Values(glm::ivec3(5), glm::ivec3(3), glm::ivec3(2), glm::ivec3(1, 1, 5),
                                         glm::ivec3(1)),
                         [](const auto& of) {
                           return std::to_string(of.param.x) + "_by_" + std::to_string(of.param.z) + "_mm";
                         });

}  // namespace
}  // namespace seldinger::volume
