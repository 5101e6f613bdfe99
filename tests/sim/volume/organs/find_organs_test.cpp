// Organs found without labels, against the torso's.
#include "sim/volume/organs/find_organs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/vec4.hpp>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "sim/base/rng.h"
#include "sim/volume/organs/organ_classes.h"
#include "tests/sim/volume/tissue/enhanced_torso.h"

namespace seldinger::volume {
namespace {

constexpr std::size_t kFoundOrgans = kFoundOrganNames.size();

// The organ that a label means, by the side of the patient it lies on.
FoundOrgan organ_of(const std::string& label, double x_lps_mm) {
  if (label == "liver") return FoundOrgan::liver;
  if (label == "spleen") return FoundOrgan::spleen;
  if (label == "bladder") return FoundOrgan::bladder;
  if (label == "gallbladder") return FoundOrgan::gallbladder;
  if (label == "aorta") return FoundOrgan::aorta;
  if (label == "vena_cava") return FoundOrgan::vena_cava;
  if (label == "spine" || label == "sacrum") return FoundOrgan::vertebrae;
  if (label == "rib") return FoundOrgan::ribs;
  if (label == "lung") return x_lps_mm < 0.0 ? FoundOrgan::right_lung : FoundOrgan::left_lung;
  if (label == "kidney") return x_lps_mm < 0.0 ? FoundOrgan::right_kidney : FoundOrgan::left_kidney;
  return FoundOrgan::none;
}

struct Agreement {
  std::array<double, kFoundOrgans> dice{};
  std::array<double, kFoundOrgans> right{};  // of what is named so, the share that is it, or beside it
};

// What most of a voxel of the organs' grid is, by its middle and places a third of it off.
std::vector<FoundOrgan> truth_of(const Organs& organs, const Volume& volume, const LabelMap& labels) {
  const glm::dmat4 volume_from_grid = voxel_from_lps(volume) * organs.grid.lps_from_voxel;
  std::vector<std::array<FoundOrgan, 2>> of_label;  // names are read once: to the right of the middle, to the left
  for (const std::string& name : labels.names) of_label.push_back({organ_of(name, -1.0), organ_of(name, 1.0)});
  const glm::ivec3 n = organs.grid.size_voxels;
  std::vector<FoundOrgan> made;
  for (int k = 0; k < n.z; ++k)
    for (int j = 0; j < n.y; ++j)
      for (int i = 0; i < n.x; ++i) {
        std::array<int, kFoundOrgans> count{};
        for (int part = 0; part < 27; ++part) {
          const glm::dvec4 at(glm::dvec3(i, j, k) + glm::dvec3(part % 3 - 1, part / 3 % 3 - 1, part / 9 - 1) / 3.0,
                              1.0);
          const glm::ivec3 from = glm::clamp(glm::ivec3(glm::round(glm::dvec3(volume_from_grid * at))),
                                             glm::ivec3(0), volume.size_voxels - 1);
          const bool left = (organs.grid.lps_from_voxel * at).x >= 0.0;
          ++count[static_cast<std::size_t>(of_label[labels.label[volume.index(from.x, from.y, from.z)]][left])];
        }
        made.push_back(FoundOrgan(std::max_element(count.begin(), count.end()) - count.begin()));
      }
  return made;
}

Agreement agreement(const Organs& organs, const Volume& volume, const LabelMap& labels) {
  const std::vector<FoundOrgan> truth = truth_of(organs, volume, labels);
  const glm::ivec3 n = organs.grid.size_voxels;
  const auto beside = [&](const glm::ivec3& p, FoundOrgan organ) {
    const glm::ivec3 low = glm::max(p - 1, glm::ivec3(0)), high = glm::min(p + 1, n - 1);
    for (int k = low.z; k <= high.z; ++k)
      for (int j = low.y; j <= high.y; ++j)
        for (int i = low.x; i <= high.x; ++i)
          if (truth[organs.grid.index(i, j, k)] == organ) return true;
    return false;
  };
  std::array<double, kFoundOrgans> both{}, all{}, named{}, right{};
  for (int k = 0; k < n.z; ++k)
    for (int j = 0; j < n.y; ++j)
      for (int i = 0; i < n.x; ++i) {
        const std::size_t at = organs.grid.index(i, j, k);
        const auto is = static_cast<std::size_t>(truth[at]), found = static_cast<std::size_t>(organs.at[at]);
        all[is] += 1.0;
        all[found] += 1.0;
        named[found] += 1.0;
        both[is] += is == found ? 1.0 : 0.0;
        right[found] += found != 0 && beside({i, j, k}, organs.at[at]) ? 1.0 : 0.0;
      }
  Agreement made;
  for (std::size_t organ = 0; organ < all.size(); ++organ) {
    made.dice[organ] = 2.0 * both[organ] / all[organ];
    made.right[organ] = right[organ] / named[organ];
  }
  return made;
}

void tell(const std::string& of, const Organs& organs, const Agreement& with) {
  for (const OrganFound& one : organs.found)
    std::printf("%-18s %-13s %5.0f ml, %3d HU, confidence %.2f, Dice %.3f, right %.3f\n", of.c_str(),
                std::string(base::name_of(kFoundOrganNames, one.organ)).c_str(), one.ml, one.level_hu,
                one.confidence, with.dice[static_cast<std::size_t>(one.organ)],
                with.right[static_cast<std::size_t>(one.organ)]);
}

std::array<bool, kFoundOrgans> named(const Organs& organs) {
  std::array<bool, kFoundOrgans> made{};
  for (const OrganFound& one : organs.found)
    made[static_cast<std::size_t>(one.organ)] = one.confidence >= kOrganConfidence;
  return made;
}

// Of ribs and vena cava parts are named, in a neck few: what lies beside a vertebra or far from lung, or is joined
// to more of its level, is not.
double least_dice(FoundOrgan organ) {
  switch (organ) {
    case FoundOrgan::vertebrae:  // of a sacrum the middle
      return 0.65;
    case FoundOrgan::ribs:
    case FoundOrgan::vena_cava:
      return 0.0;
    default:
      return 0.9;
  }
}

void expect_right(const std::string& of, const Organs& organs, const Agreement& with) {
  for (std::size_t organ = 1; organ < kFoundOrgans; ++organ) {
    if (!named(organs)[organ]) continue;
    EXPECT_GE(with.dice[organ], least_dice(FoundOrgan(organ)))
        << of << ": " << base::name_of(kFoundOrganNames, FoundOrgan(organ));
    EXPECT_GE(with.right[organ], 0.975) << of << ": " << base::name_of(kFoundOrganNames, FoundOrgan(organ));
  }
}

// What a new case stores, of which ultrasound and touch take their rows.
void expect_classes(const EnhancedTorso& torso, const std::vector<TissueClass>& plain, const Organs& organs) {
  std::vector<TissueClass> classes = plain;
  mark_organs(torso.volume, organs, classes);
  std::array<double, kTissueClasses> both{}, all{}, named{}, wrong{};
  for (std::size_t at = 0; at < classes.size(); ++at) {
    const auto truth = tissue_of_name(torso.truth.names[torso.truth.label[at]]);
    const auto is = static_cast<std::size_t>(truth.value_or(plain[at])),
               told = static_cast<std::size_t>(classes[at]);
    all[is] += 1.0, all[told] += 1.0, named[told] += 1.0;
    both[is] += is == told ? 1.0 : 0.0;
    if (classes[at] == plain[at]) continue;
    ASSERT_TRUE(plain[at] == TissueClass::soft_tissue || plain[at] == TissueClass::vessel) << at;
    wrong[told] += is == told ? 0.0 : 1.0;
  }
  for (const TissueClass tissue : {TissueClass::liver, TissueClass::spleen, TissueClass::kidney}) {
    const auto at = static_cast<std::size_t>(tissue);
    std::printf("class %-12s Dice %.3f, %.3f of it wrong\n", about(tissue).name, 2.0 * both[at] / all[at],
                wrong[at] / named[at]);
    EXPECT_GE(2.0 * both[at] / all[at], 0.9) << about(tissue).name;
    EXPECT_LE(wrong[at] / named[at], 0.08) << about(tissue).name << ": its rim";
  }
  // A vein of the liver that contrast shows stays one; a kidney's cortex that is as bright is a kidney's.
  std::vector<TissueClass> bright = plain;
  const auto is_any = [&](std::size_t at, std::initializer_list<const char*> names) {
    return std::any_of(names.begin(), names.end(),
                       [&](const char* name) { return torso.truth.names[torso.truth.label[at]] == name; });
  };
  for (std::size_t at = 0; at < bright.size(); ++at)
    if (is_any(at, {"portal_vein", "hepatic_vein", "kidney"})) bright[at] = TissueClass::vessel;
  mark_organs(torso.volume, organs, bright);
  double kidney = 0.0, cortex = 0.0, veins = 0.0;
  for (std::size_t at = 0; at < bright.size(); ++at) {
    if (is_any(at, {"kidney"})) kidney += 1.0, cortex += bright[at] == TissueClass::kidney ? 1.0 : 0.0;
    if (!is_any(at, {"portal_vein", "hepatic_vein"})) continue;
    veins += classes[at] == TissueClass::liver ? 1.0 : 0.0;  // where the liver is named
    EXPECT_EQ(bright[at], TissueClass::vessel) << at;
  }
  EXPECT_GT(veins, 50.0);
  EXPECT_GT(cortex, 0.9 * kidney);
  EXPECT_EQ(organs.at, find_organs(torso.volume, classes).at) << "what is named does not hang on what was";
  EXPECT_EQ(contrast_of(torso.volume, classes).phase, contrast_of(torso.volume, plain).phase);
}

TEST(Organs, OfTheTorsoAreThoseOfItsLabels) {
  for (const TorsoPhase phase : {TorsoPhase::portal, TorsoPhase::excretory})
    for (const int spacing_mm : {2, 3}) {
      const EnhancedTorso torso = enhanced_torso({.phase = phase, .spacing_mm = glm::ivec3(spacing_mm)});
      const std::vector<TissueClass> classes = tissue_classes(torso.volume);
      const Organs organs = find_organs(torso.volume, classes);
      const Agreement with = agreement(organs, torso.volume, torso.truth);
      const std::string of = name_of(phase) + ", " + std::to_string(spacing_mm) + " mm";
      tell(of, organs, with);
      for (std::size_t organ = 1; organ < kFoundOrgans; ++organ) {
        if (FoundOrgan(organ) == FoundOrgan::bladder) continue;  // below what the torso shows
        EXPECT_TRUE(named(organs)[organ]) << of << ": " << base::name_of(kFoundOrganNames, FoundOrgan(organ));
      }
      expect_right(of, organs, with);
      for (const FoundOrgan organ : {FoundOrgan::ribs, FoundOrgan::vena_cava})
        EXPECT_GE(with.dice[static_cast<std::size_t>(organ)], 0.55) << of;
      EXPECT_GE(with.dice[static_cast<std::size_t>(FoundOrgan::vertebrae)], 0.9) << of;
      if (phase == TorsoPhase::portal && spacing_mm == 3) expect_classes(torso, classes, organs);
    }
}

// What is named is what it is called; what cannot be told, as without contrast, is not named.
TEST(Organs, AreNamedRightlyOrNotAtAll) {
  const auto expect_right_of = [](const std::string& of, const Volume& volume, const LabelMap& truth,
                                  bool names_liver = false) {
    const Organs organs = find_organs(volume, tissue_classes(volume));
    const Agreement with = agreement(organs, volume, truth);
    tell(of, organs, with);
    expect_right(of, organs, with);
    EXPECT_EQ(named(organs)[static_cast<std::size_t>(FoundOrgan::liver)], names_liver) << of;
  };
  for (const TorsoPhase phase : {TorsoPhase::none, TorsoPhase::arterial}) {
    const EnhancedTorso torso = enhanced_torso({.phase = phase, .spacing_mm = glm::ivec3(3)});
    expect_right_of(name_of(phase), torso.volume, torso.truth);
  }
  for (const auto& [body, name] : kBodyNames) {
    const Phantom made = make_phantom({.spacing_mm = glm::dvec3(3.0), .body = body});
    expect_right_of(std::string(name), made.volume, made.labels, true);
  }
  for (const Region region : {Region::groin, Region::neck}) {
    const Phantom made = make_phantom({.spacing_mm = glm::dvec3(3.0), .region = region});
    expect_right_of(std::string(base::name_of(kRegionNames, region)), made.volume, made.labels);
  }
}

// What lies from one share of the width to another.
void keep_between(double from, double to, Volume& volume, LabelMap& labels) {
  const glm::ivec3 n = volume.size_voxels;
  const int first = static_cast<int>(from * n.x), past = static_cast<int>(to * n.x);
  Volume part = make_volume({past - first, n.y, n.z}, volume.spacing_mm, glm::dmat3(1.0),
                            glm::dvec3(volume.lps_from_voxel * glm::dvec4(first, 0, 0, 1)));
  std::vector<std::uint8_t> label;
  std::size_t at = 0;
  for (int k = 0; k < n.z; ++k)
    for (int j = 0; j < n.y; ++j)
      for (int i = first; i < past; ++i) {
        part.hu[at++] = volume.at(i, j, k);
        label.push_back(labels.label[volume.index(i, j, k)]);
      }
  volume = std::move(part);
  labels.label = std::move(label);
}

// Where a side of the patient was not scanned the middle of the picture is not his: a lung on the wrong side, and
// the head of a femur that is a vertebra, were told as sure.
TEST(Organs, OfAPatientOfWhomASideIsCutOffAreNamedRightlyOrNotAtAll) {
  struct Kept {
    double from, to;
  };
  constexpr Kept kKept[] = {{0.0, 0.3},  {0.0, 0.45}, {0.0, 0.5},  {0.0, 0.6}, {0.0, 0.75},
                            {0.25, 1.0}, {0.4, 1.0},  {0.5, 1.0},  {0.6, 1.0}, {0.75, 1.0},
                            {0.3, 0.7},  {0.1, 0.6},  {0.15, 1.0}, {0.0, 0.88}};
  std::vector<std::pair<std::string, Phantom>> patients;
  EnhancedTorso torso = enhanced_torso({.phase = TorsoPhase::portal, .spacing_mm = glm::ivec3(3)});
  patients.push_back({"torso", {std::move(torso.volume), std::move(torso.truth)}});
  for (const Region region : {Region::groin, Region::neck})
    patients.push_back({std::string(base::name_of(kRegionNames, region)),
                        make_phantom({.spacing_mm = glm::dvec3(3.0), .region = region})});
  int sides = 0;
  for (const auto& [name, patient] : patients)
    for (const Kept& kept : kKept) {
      Volume volume = patient.volume;
      LabelMap labels = patient.labels;
      keep_between(kept.from, kept.to, volume, labels);
      const Organs organs = find_organs(volume, tissue_classes(volume));
      const Agreement with = agreement(organs, volume, labels);
      const std::string of = name + " from " + std::to_string(kept.from) + " to " + std::to_string(kept.to);
      tell(of, organs, with);
      for (std::size_t organ = 1; organ < kFoundOrgans; ++organ) {
        if (!named(organs)[organ]) continue;
        // Of what is called vena cava some may be the iliac vein that it comes from.
        EXPECT_GE(with.right[organ], FoundOrgan(organ) == FoundOrgan::vena_cava ? 0.93 : 0.975)
            << of << ": " << base::name_of(kFoundOrganNames, FoundOrgan(organ));
        sides += FoundOrgan(organ) == FoundOrgan::right_lung ? 1 : 0;
      }
    }
  EXPECT_GE(sides, 8) << "where the spine shows where the middle is";
}

TEST(Organs, TheBladderIsTheGroinsAndNoOthers) {
  for (const Region region : {Region::groin, Region::torso}) {
    const Phantom made = make_phantom({.spacing_mm = glm::dvec3(3.0), .region = region});
    const Organs organs = find_organs(made.volume, tissue_classes(made.volume));
    EXPECT_EQ(named(organs)[static_cast<std::size_t>(FoundOrgan::bladder)], region == Region::groin);
  }
}

// Of a torso whose gallbladder is left away, or not, and that has more.
bool names_a_gallbladder(EnhancedTorso torso, bool keep, const std::vector<Shape>& more) {
  constexpr double kLiverHu = 85.0, kNoiseSdHu = 12.0;
  Volume& ct = torso.volume;
  for (std::size_t at = 0; at < ct.hu.size(); ++at) {
    const auto paint = [&](double hu) {
      ct.hu[at] = static_cast<std::int16_t>(std::lround(hu + kNoiseSdHu * base::normal_at(11, at)));
    };
    if (!keep && torso.truth.names[torso.truth.label[at]] == "gallbladder") paint(kLiverHu);
    const auto n = glm::uvec3(ct.size_voxels);
    const glm::dvec3 voxel(at % n.x, at / n.x % n.y, at / (std::size_t{n.x} * n.y));
    for (const Shape& one : more)
      if (contains(one.geometry, glm::dvec3(ct.lps_from_voxel * glm::dvec4(voxel, 1.0)))) paint(one.hu);
  }
  const Organs organs = find_organs(ct, tissue_classes(ct));
  EXPECT_TRUE(named(organs)[static_cast<std::size_t>(FoundOrgan::liver)]) << "else nothing is shown";
  return named(organs)[static_cast<std::size_t>(FoundOrgan::gallbladder)];
}

TEST(Organs, TheGallbladderIsNoCystAndNoGut) {
  const EnhancedTorso torso = enhanced_torso({.phase = TorsoPhase::excretory, .spacing_mm = glm::ivec3(3)});
  const Shape cyst{Sphere{{-85.0, -5.0, 50.0}, 18.0}, 8.0, "cyst"},
      gut{Sphere{{-46.0, -10.0, -4.0}, 12.0}, 8.0, "gut"}, gas{Sphere{{-46.0, -18.0, -4.0}, 7.0}, -1000.0, "gut"};
  EXPECT_TRUE(names_a_gallbladder(torso, true, {}));
  EXPECT_TRUE(names_a_gallbladder(torso, true, {cyst}));
  EXPECT_FALSE(names_a_gallbladder(torso, false, {}));
  EXPECT_FALSE(names_a_gallbladder(torso, false, {cyst})) << "liver lies all around it";
  EXPECT_FALSE(names_a_gallbladder(torso, false, {gut, gas})) << "it holds gas";
  EXPECT_FALSE(names_a_gallbladder(torso, true, {gut})) << "neither is told from the other";
}

// As classes are stored: of today's rules, or of before its organ was found.
TEST(Organs, LieInVoxelsOfTheirClassAndInThoseThatStay) {
  using enum FoundOrgan;
  EXPECT_TRUE(may_lie_in(spleen, TissueClass::spleen));
  EXPECT_TRUE(may_lie_in(left_kidney, TissueClass::fat)) << "of its sinus";
  EXPECT_TRUE(may_lie_in(liver, TissueClass::vessel)) << "a vein of it";
  EXPECT_TRUE(may_lie_in(liver, TissueClass::fluid)) << "a cyst";
  EXPECT_TRUE(may_lie_in(gallbladder, TissueClass::fluid));
  EXPECT_TRUE(may_lie_in(ribs, TissueClass::bone));
  EXPECT_TRUE(may_lie_in(right_lung, TissueClass::soft_tissue)) << "its vessels are no class of their own";
  EXPECT_FALSE(may_lie_in(spleen, TissueClass::soft_tissue)) << "stored before";
  EXPECT_FALSE(may_lie_in(spleen, TissueClass::vessel));
  EXPECT_FALSE(may_lie_in(aorta, TissueClass::soft_tissue));
  EXPECT_FALSE(may_lie_in(liver, TissueClass::spleen)) << "another organ";
  EXPECT_FALSE(may_lie_in(ribs, TissueClass::kidney));
}

TEST(Organs, OfAirThereAreNone) {
  const Volume air = make_volume({8, 8, 2}, {1, 1, 1}, glm::dmat3(1.0), glm::dvec3(0.0));
  const Organs organs = find_organs(air, tissue_classes(air));
  EXPECT_TRUE(organs.found.empty());
  EXPECT_EQ(organs.at.size(), organs.grid.hu.size());
}

}  // namespace
}  // namespace seldinger::volume
