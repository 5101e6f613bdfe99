// How bright the speckle of tissue is that no label tells apart. Classes alone would draw liver, kidney and vessels
// in one grey; HU say a little more: denser parenchyma is brighter on plain CT (liver over spleen over kidney), and
// what stands out from its surroundings, darker on plain CT and brighter with contrast, is a vessel and black. A
// guess for pictures, good for orientation; labels always win. Steps and slopes are our
// judgement; of backscatter it is known that the liver has the most, the spleen the least (Fei and Shung 1985).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/volume/classes.h"
#include "sim/volume/volume.h"

namespace seldinger::imaging {

// One byte a voxel: offset from the class's scatter_db in steps of kEchoStepDb, kNoEchoOffset for none.
constexpr double kEchoStepDb = 0.25;
constexpr std::uint8_t kNoEchoOffset = 128;
constexpr double echo_offset_db(std::uint8_t level) noexcept {
  return kEchoStepDb * (static_cast<int>(level) - static_cast<int>(kNoEchoOffset));
}

// The byte of a voxel of this class that makes it speckle so many dB over liver.
std::uint8_t echo_level(double over_liver_db, volume::TissueClass tissue);

// 10^(offset/20) of every byte.
const std::array<float, 256>& echo_offset_amplitudes();

// Of the voxels of class soft_tissue; none elsewhere. Same input, same bytes, for any number of threads (0: as many
// as cores).
std::vector<std::uint8_t> echogenicity(const volume::Volume& volume, std::span<const volume::TissueClass> classes,
                                       int threads = 0);

// How far from the volume's own middle counts as a vessel, and what it takes from the echo.
constexpr double kVesselFromHu = 8.0, kVesselFullHu = 20.0, kVesselDb = -16.0;
// Contrast is in the veins when this share of parenchyma is denser than any is without.
constexpr double kPlainMostHu = 85.0, kEnhancedShare = 0.2;

}  // namespace seldinger::imaging
