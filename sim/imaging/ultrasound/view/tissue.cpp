#include "sim/imaging/ultrasound/view/tissue.h"

#include <cmath>

#include "sim/base/check.h"

namespace seldinger::imaging {
namespace {

// Coefficients at 1 MHz: PMC10001275, table 4. Impedance: density times speed as measured in Bioengineering
// 12(9):946; of skin and steel PMC10346919, table A2; of fat, gas, lung and bone the middle of what simulators take
// (1.35 to 1.38; 0.0004; 0.2; 6 to 7.8). Exponents: soft tissue has 1 to 1.2, here 1, for laboratories differ by a
// factor of two in the coefficient (Madsen 1986); water 2. Scatter of organs by the order of Fei and Shung 1985
// (liver most, spleen least); of the rest: design, after the look of pictures. Bone and lung vary by three; behind
// any of them it is dark. Speed: Bioengineering 12(9):946; what HU cannot tell apart goes at the scanner's own
// speed, and so does gas, from behind which nothing comes.
constexpr AcousticTable kTable = {{
    {0.0004, 10.0, 1.0, kNoScatterDb, 1540.0, false},  // air
    {0.0004, 10.0, 1.0, kNoScatterDb, 1540.0, false},  // gas
    {0.20, 40.0, 1.0, kNoScatterDb, 1540.0, false},    // lung
    {1.355, 0.63, 1.0, -4.0, 1462.0, true},            // fat
    {1.50, 0.002, 2.0, -60.0, 1510.0, false},          // fluid
    {1.65, 0.60, 1.0, -3.0, 1540.0, true},    // soft tissue that HU cannot tell apart: between muscle and liver
    {1.66, 0.50, 1.0, 0.0, 1540.0, true},     // liver
    {1.63, 1.00, 1.0, -4.0, 1557.0, true},    // kidney
    {1.65, 0.40, 1.0, -7.0, 1567.0, true},    // spleen
    {1.67, 0.96, 1.0, -6.0, 1562.0, true},    // muscle, across its fibres
    {1.90, 0.35, 1.0, 3.0, 1655.0, true},     // skin
    {2.05, 1.57, 1.0, 6.0, 1827.0, true},     // connective
    {1.65, 0.18, 1.0, -35.0, 1575.0, false},  // vessel: blood, with contrast or without
    {7.80, 8.00, 1.0, -6.0, 3194.0, false},   // bone, its cortex
    {46.0, 0.20, 1.0, kNoScatterDb, 5790.0, false},  // metal: steel
}};

}  // namespace

const AcousticTable& acoustic_table() noexcept {
  return kTable;
}

AcousticTable acoustic_table(std::optional<double> soft_attenuation_db_cm_mhz) {
  AcousticTable table = kTable;
  if (!soft_attenuation_db_cm_mhz) return table;
  CHECK(*soft_attenuation_db_cm_mhz >= 0.0 && std::isfinite(*soft_attenuation_db_cm_mhz));
  for (Acoustics& tissue : table)
    if (tissue.soft) {
      tissue.attenuation_db_cm_mhz = *soft_attenuation_db_cm_mhz;
      tissue.exponent = 1.0;
    }
  return table;
}

float speckle_amplitude(double level_db) noexcept {
  return level_db > kNoScatterDb ? static_cast<float>(std::pow(10.0, level_db / 20.0)) : 0.0F;
}

std::array<float, volume::kTissueClasses> speckle_amplitudes() noexcept {
  std::array<float, volume::kTissueClasses> amplitude{};
  for (std::size_t i = 0; i < amplitude.size(); ++i)
    amplitude[i] = speckle_amplitude(acoustic_table()[i].scatter_db);
  return amplitude;
}

}  // namespace seldinger::imaging
