// The built-in torso in four phases of contrast, on coarser grids: HU and shares of bone are averages over voxels
// of 1 mm, so that the truth of a coarse voxel is known.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "sim/volume/phantom.h"
#include "sim/volume/tissue/contrast.h"
#include "sim/volume/tissue/find_tissue.h"

namespace seldinger::volume {

enum class TorsoPhase { none, arterial, portal, excretory };
inline constexpr std::array kTorsoPhases{TorsoPhase::none, TorsoPhase::arterial, TorsoPhase::portal,
                                         TorsoPhase::excretory};
std::string name_of(TorsoPhase phase);
ContrastPhase told_as(TorsoPhase phase);  // what is told of its CT

struct EnhancedTorso {
  Volume volume;
  LabelMap truth;                 // of most of the voxel
  std::vector<float> bone_share;  // 0 to 1
};

struct TorsoOptions {
  TorsoPhase phase = TorsoPhase::none;
  glm::ivec3 spacing_mm{1};
  double noise_sd_hu = 12.0;
  bool metal = false;  // a pin of 6 mm in a vertebra, a clip of 3 mm at the liver
  Body body = Body::adult;
};
// The torso's shapes in that phase, and with metal.
void enhance(AnalyticVolume& shapes, TorsoPhase phase, bool metal);
EnhancedTorso enhanced_torso(const TorsoOptions& options);

// What was found of it.
struct TorsoScore {
  double bone_dice = 0.0;            // of shares
  double rib_as_bone = 0.0;          // of voxels that are mostly rib, by class
  double vessel_as_bone = 0.0;       // of great vessels and heart, by class
  double ducts_as_bone = 0.0;        // of urine, by class
  double ribs = 0.0, vessels = 0.0;  // voxels of them in the field: of none the shares are no number
};
TorsoScore score(const EnhancedTorso& torso, const Tissue& found);

}  // namespace seldinger::volume
