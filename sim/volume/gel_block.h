// The blocks of gel that the first hour is practised on (docs/clinical.md, "First hour"): a tray of
// tissue-mimicking gel with one ball of water in it, from analytic shapes. LPS mm: the tray lies on the table as a
// supine patient does, its flat top at y = 0 and down at +y, so that y is the depth; x is along its length, z
// across. Walls and bottom are the volume's ends: only the top can be punctured.
#pragma once

#include "sim/volume/phantom.h"

namespace seldinger::volume {

// By the drill that it is for.
enum class GelBlock { find_the_plane, keep_the_tip, out_of_plane };

struct GelBlockOptions {
  double spacing_mm = 0.8;   // of each axis; a ball's edge shows no steps under ultrasound
  double noise_sd_hu = 4.0;  // nothing but the scanner's: gel is the same all over
  std::uint64_t seed = 1;
};

constexpr const char* kGelBlockVersion = "1";

constexpr glm::dvec3 kGelSizeMm{160.0, 100.0, 120.0};
constexpr double kGelAboveMm = 20.0;  // of air, so that the top is a surface
constexpr double kGelSkinMm = 1.6;    // a membrane: felt, and seen as a bright line
constexpr double kGelHu = 50.0, kGelSkinHu = 40.0, kGelBallHu = 5.0;

// The ball of water in it.
Sphere gel_ball(GelBlock block) noexcept;

// The shapes, without noise: its closed form.
AnalyticVolume gel_block_shapes(GelBlock block, const GelBlockOptions& options = {});
Phantom make_gel_block(GelBlock block, const GelBlockOptions& options = {});

}  // namespace seldinger::volume
