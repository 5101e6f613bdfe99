#include "sim/imaging/xray/beam/attenuation.h"

#include "sim/base/check.h"
#include "sim/imaging/xray/beam/coefficients.h"

namespace seldinger::imaging {

Attenuation attenuation_at(double energy_kev) {
  CHECK(energy_kev >= kMinEnergyKev && energy_kev <= kMaxEnergyKev);
  // 1000/HU_bone, so that mineral_per_mm is μ_water at kHuEnergyKev.
  static const double bone_of_mineral = [] {
    const double water_per_mm = attenuation_per_mm(Material::water, kHuEnergyKev);
    return water_per_mm / (attenuation_per_mm(Material::cortical_bone, kHuEnergyKev) - water_per_mm);
  }();
  const double water_per_mm = attenuation_per_mm(Material::water, energy_kev);
  const double bone_per_mm = attenuation_per_mm(Material::cortical_bone, energy_kev);
  return {water_per_mm, bone_of_mineral * (bone_per_mm - water_per_mm),
          attenuation_per_mm(Material::iron, energy_kev),
          0.1 * kContrastIodineGCm3 * mass_attenuation_cm2_g(Material::iodine, energy_kev)};
}

}  // namespace seldinger::imaging
