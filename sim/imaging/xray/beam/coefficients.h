// Photon interaction coefficients from 12.5 to 150 keV, as tables committed with their source (coefficients.cpp).
#pragma once

namespace seldinger::imaging {

enum class Material { water, cortical_bone, iron, aluminium, copper, tungsten, caesium_iodide, iodine };

constexpr double kLowestTableKev = 12.5, kHighestTableKev = 150.0;

// Total cross section with coherent scattering. kLowestTableKev ≤ energy ≤ kHighestTableKev (CHECK).
double mass_attenuation_cm2_g(Material material, double energy_kev);
double density_g_cm3(Material material) noexcept;
double attenuation_per_mm(Material material, double energy_kev);  // of the material at its density

// Mass energy-absorption coefficient of dry air, for air kerma. Same energies.
double air_energy_absorption_cm2_g(double energy_kev);

}  // namespace seldinger::imaging
