// Organs found without labels, against the torso's.
#include "sim/volume/organs/find_organs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/vec4.hpp>
#include <string>

#include "tests/sim/volume/tissue/enhanced_torso.h"

namespace seldinger::volume {
namespace {

constexpr std::size_t kFoundOrgans = kFoundOrganNames.size();

// The organ that a label means, by the side of the patient it lies on.
FoundOrgan organ_of(const std::string& label, double x_lps_mm) {
  if (label == "liver") return FoundOrgan::liver;
  if (label == "spleen") return FoundOrgan::spleen;
  if (label == "kidney") return x_lps_mm < 0.0 ? FoundOrgan::right_kidney : FoundOrgan::left_kidney;
  return FoundOrgan::none;
}

std::array<double, kFoundOrgans> dice_of(const Organs& organs, const Volume& volume, const LabelMap& labels) {
  std::array<double, kFoundOrgans> both{}, all{}, dice{};
  const glm::dmat4 volume_from_grid = voxel_from_lps(volume) * organs.grid.lps_from_voxel;
  const glm::ivec3 n = organs.grid.size_voxels;
  for (int k = 0; k < n.z; ++k)
    for (int j = 0; j < n.y; ++j)
      for (int i = 0; i < n.x; ++i) {
        const glm::dvec4 at(i, j, k, 1.0);
        const glm::ivec3 from = glm::clamp(glm::ivec3(glm::round(glm::dvec3(volume_from_grid * at))), glm::ivec3(0),
                                           volume.size_voxels - 1);
        const double x_mm = (organs.grid.lps_from_voxel * at).x;
        const auto truth = static_cast<std::size_t>(
            organ_of(labels.names[labels.label[volume.index(from.x, from.y, from.z)]], x_mm));
        const auto found = static_cast<std::size_t>(organs.at[organs.grid.index(i, j, k)]);
        all[truth] += 1.0;
        all[found] += 1.0;
        if (truth == found) both[truth] += 1.0;
      }
  for (std::size_t organ = 0; organ < dice.size(); ++organ) dice[organ] = 2.0 * both[organ] / all[organ];
  return dice;
}

void tell(const std::string& of, const Organs& organs, const std::array<double, kFoundOrgans>& dice) {
  for (const OrganFound& one : organs.found)
    std::printf("%-18s %-13s %5.0f ml, %3d HU, confidence %.2f, Dice %.3f\n", of.c_str(),
                std::string(base::name_of(kFoundOrganNames, one.organ)).c_str(), one.ml, one.level_hu,
                one.confidence, dice[static_cast<std::size_t>(one.organ)]);
}

std::array<bool, kFoundOrgans> named(const Organs& organs) {
  std::array<bool, kFoundOrgans> made{};
  for (const OrganFound& one : organs.found)
    made[static_cast<std::size_t>(one.organ)] = one.confidence >= kOrganConfidence;
  return made;
}

TEST(Organs, OfTheTorsoAreThoseOfItsLabels) {
  for (const TorsoPhase phase : {TorsoPhase::portal, TorsoPhase::excretory})
    for (const int spacing_mm : {2, 3}) {
      const EnhancedTorso torso = enhanced_torso({.phase = phase, .spacing_mm = glm::ivec3(spacing_mm)});
      const Organs organs = find_organs(torso.volume, tissue_classes(torso.volume));
      const auto dice = dice_of(organs, torso.volume, torso.truth);
      const std::string of = name_of(phase) + ", " + std::to_string(spacing_mm) + " mm";
      tell(of, organs, dice);
      for (std::size_t organ = 1; organ < kFoundOrgans; ++organ) {
        EXPECT_TRUE(named(organs)[organ]) << of << ": " << base::name_of(kFoundOrganNames, FoundOrgan(organ));
        EXPECT_GE(dice[organ], 0.9) << of << ": " << base::name_of(kFoundOrganNames, FoundOrgan(organ));
      }
    }
}

// What is named is what it is called; what cannot be told, as without contrast, is not named.
TEST(Organs, AreNamedRightlyOrNotAtAll) {
  const auto expect_right = [](const std::string& of, const Volume& volume, const LabelMap& truth) {
    const Organs organs = find_organs(volume, tissue_classes(volume));
    const auto dice = dice_of(organs, volume, truth);
    tell(of, organs, dice);
    for (std::size_t organ = 1; organ < kFoundOrgans; ++organ)
      if (named(organs)[organ]) {
        EXPECT_GE(dice[organ], 0.9) << of << ": " << base::name_of(kFoundOrganNames, FoundOrgan(organ));
      }
  };
  for (const TorsoPhase phase : {TorsoPhase::none, TorsoPhase::arterial}) {
    const EnhancedTorso torso = enhanced_torso({.phase = phase, .spacing_mm = glm::ivec3(3)});
    expect_right(name_of(phase), torso.volume, torso.truth);
  }
  for (const auto& [body, name] : kBodyNames) {
    const Phantom made = make_phantom({.spacing_mm = glm::dvec3(3.0), .body = body});
    expect_right(std::string(name), made.volume, made.labels);
  }
  for (const Region region : {Region::groin, Region::neck}) {
    const Phantom made = make_phantom({.spacing_mm = glm::dvec3(3.0), .region = region});
    expect_right(std::string(base::name_of(kRegionNames, region)), made.volume, made.labels);
  }
}

TEST(Organs, OfAirThereAreNone) {
  const Volume air = make_volume({8, 8, 2}, {1, 1, 1}, glm::dmat3(1.0), glm::dvec3(0.0));
  const Organs organs = find_organs(air, tissue_classes(air));
  EXPECT_TRUE(organs.found.empty());
  EXPECT_EQ(organs.at.size(), organs.grid.hu.size());
}

}  // namespace
}  // namespace seldinger::volume
