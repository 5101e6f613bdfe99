#include "sim/imaging/xray/beam/attenuation.h"

#include "sim/base/check.h"
#include "sim/imaging/xray/beam/coefficients.h"

namespace seldinger::imaging {
namespace {

// 1000/HU_bone, so that mineral_per_mm is μ_water at the CT's energy.
double bone_of_mineral(double ct_kev) {
  const double water_per_mm = attenuation_per_mm(Material::water, ct_kev);
  return water_per_mm / (attenuation_per_mm(Material::cortical_bone, ct_kev) - water_per_mm);
}

}  // namespace

double ct_effective_kev(std::optional<double> tube_kv) noexcept {
  constexpr double kUsualKv = 120.0, kLowestKv = 70.0, kHighestKv = 150.0;
  if (!tube_kv || !(*tube_kv >= kLowestKv && *tube_kv <= kHighestKv)) return kHuEnergyKev;
  const auto mean_kev = [](double kv) { return 52.0 + (72.0 - 52.0) / (140.0 - 80.0) * (kv - 80.0); };
  return kHuEnergyKev * (mean_kev(*tube_kv) / mean_kev(kUsualKv));
}

Attenuation attenuation_at(double energy_kev, double ct_kev) {
  CHECK(energy_kev >= kMinEnergyKev && energy_kev <= kMaxEnergyKev);
  CHECK(ct_kev >= kMinEnergyKev && ct_kev <= kMaxEnergyKev);
  const double water_per_mm = attenuation_per_mm(Material::water, energy_kev);
  const double bone_per_mm = attenuation_per_mm(Material::cortical_bone, energy_kev);
  return {water_per_mm, bone_of_mineral(ct_kev) * (bone_per_mm - water_per_mm),
          attenuation_per_mm(Material::iron, energy_kev),
          0.1 * kContrastIodineGCm3 * mass_attenuation_cm2_g(Material::iodine, energy_kev)};
}

double contrast_mm_of_1000_hu(double ct_kev) {
  const Attenuation at = attenuation_at(ct_kev, ct_kev);
  return at.water_per_mm / at.contrast_per_mm;
}

double iodine_hu_per_mg_ml(double ct_kev) {
  constexpr double kMgPerMl = 1000.0 * kContrastIodineGCm3;
  return 1000.0 / (kMgPerMl * contrast_mm_of_1000_hu(ct_kev));
}

}  // namespace seldinger::imaging
