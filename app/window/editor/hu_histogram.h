// How often each HU is in a volume, for a chart: where its air, fat, tissue and bone are.
#pragma once

#include <array>
#include <cstddef>

#include "sim/volume/volume.h"

namespace seldinger::app {

struct HuHistogram {
  static constexpr double kLowHu = -1024.0, kBinHu = 12.0;
  static constexpr std::size_t kBins = 252;
  static constexpr double kHighHu = kLowHu + kBinHu * kBins;  // 2000

  std::array<std::size_t, kBins> counts{};  // voxels; those above the highest are in the last
  std::size_t most = 0;

  static std::size_t bin_of(double hu) noexcept;
  // Of 1, by the logarithm of counts: an organ shows beside all the air around the patient.
  double height(std::size_t bin) const noexcept;
};

HuHistogram histogram_of(const volume::Volume& volume);

}  // namespace seldinger::app
