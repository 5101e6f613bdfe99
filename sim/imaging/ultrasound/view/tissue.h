// How sound meets tissue: the acoustic table of the tissue classes.
#pragma once

#include <array>
#include <optional>

#include "sim/volume/classes.h"

namespace seldinger::imaging {

struct Acoustics {
  double impedance_mrayl;
  double attenuation_db_cm_mhz;  // one way; dB/cm = this · (f/MHz)^exponent
  double exponent;
  double scatter_db;  // mean-square echo of its speckle above the liver's; kNoScatterDb: none
  double speed_m_s;   // of sound; a scanner takes all for kUsSpeedMmPerUs and shows it too deep or too shallow
  bool soft;          // a view's attenuation override replaces its coefficient
};
constexpr double kNoScatterDb = -200.0;

using AcousticTable = std::array<Acoustics, volume::kTissueClasses>;  // indexed by volume::TissueClass
const AcousticTable& acoustic_table() noexcept;

// The table with every soft class's coefficient replaced and its exponent 1; finite, ≥ 0.
AcousticTable acoustic_table(std::optional<double> soft_attenuation_db_cm_mhz);

// Of speckle at a level above the liver's; kNoScatterDb: 0.
float speckle_amplitude(double level_db) noexcept;

// Amplitude of each class's speckle; liver's is 1.
std::array<float, volume::kTissueClasses> speckle_amplitudes() noexcept;

}  // namespace seldinger::imaging
