// Linear attenuation of what a ray crosses, by photon energy: liquid water, cortical bone, iron, iodine; total
// cross section with coherent scattering.
//
// HU to attenuation: CT numbers are taken as true at the CT's effective energy (kHuEnergyKev where nobody knows
// it), where μ = μ_water·(1 + HU/1000) for every HU. At other energies, up to 0 HU a voxel is water of that
// density. Above 0 HU it is water in which a part HU/HU_bone is replaced by cortical bone, HU_bone being bone's own
// CT number at the CT's energy, with no upper end: denser than bone means more mineral, as in enamel, and nothing
// above 1000 HU is cut off. So
//   ∫μ(E) ds = water_per_mm·water_mm + mineral_per_mm·mineral_mm (+ iron_per_mm·iron_mm +
//   contrast_per_mm·contrast_mm)
// with the lengths of projection.h and mineral_per_mm = (1000/HU_bone)·(μ_bone − μ_water), which is μ_water at the
// CT's energy. HU that are iodine's are told apart beforehand (enhanced.h).
#pragma once

#include <optional>

namespace seldinger::imaging {

constexpr double kHuEnergyKev = 80.0;  // effective energy of a 120 kV CT beam behind a patient
// Of a CT at another voltage: in proportion to the mean energy of what water the size of a patient lets through,
// which rises from 52 to 72 keV from 80 to 140 kV (Huda, Scalzetti and Levin, Radiology 217 (2000) 430). Nothing,
// or no voltage that CT scanners have (70 to 150 kV): kHuEnergyKev.
double ct_effective_kev(std::optional<double> tube_kv) noexcept;
// Of contrast medium as it is injected: 150 mg of iodine in a ml. What is sold has 300; it is halved, so that it
// does not hide what lies in it (design).
constexpr double kContrastIodineGCm3 = 0.15;
constexpr double kMinEnergyKev = 20.0, kMaxEnergyKev = 150.0;

struct Attenuation {
  double water_per_mm = 0.0;     // liquid water, 1.000 g/cm³
  double mineral_per_mm = 0.0;   // per mm of mineral_mm: a mm at 1000 HU above water
  double iron_per_mm = 0.0;      // 7.874 g/cm³: needles
  double contrast_per_mm = 0.0;  // the iodine of contrast medium; the water of a lumen is its voxels' already
};

// kMinEnergyKev ≤ energies ≤ kMaxEnergyKev (CHECK).
Attenuation attenuation_at(double energy_kev, double ct_kev = kHuEnergyKev);

// Millimetres of contrast medium that weaken a beam of the CT's energy as much as a millimetre of 1000 HU more.
double contrast_mm_of_1000_hu(double ct_kev);
// CT number of a mg of iodine in a ml.
double iodine_hu_per_mg_ml(double ct_kev);

}  // namespace seldinger::imaging
