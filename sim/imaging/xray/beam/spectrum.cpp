#include "sim/imaging/xray/beam/spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "sim/base/check.h"
#include "sim/base/exact_math.h"

namespace seldinger::imaging {
namespace {

using base::exact_exp, base::exact_log;

constexpr double kFirstKev = 13.0;

// CODATA 2018.
constexpr double kFineStructure = 7.2973525693e-3, kElectronRadiusCm = 2.8179403262e-13, kElectronKev = 510.99895,
                 kAvogadro = 6.02214076e23, kElectronsPerMas = 1e-3 / 1.602176634e-19,
                 kJoulePerKev = 1.602176634e-16;
constexpr double kTungstenZ = 74.0, kTungstenGPerMol = 183.84;
constexpr double kPi = std::numbers::pi;

// Refitted to the half-value layers of tests/sim/imaging/xray/spectrum_test.cpp: least fourth powers over the first
// and second layers of PTB's RQR 2–9 and RQA 2–9 and the first of SpekPy's and SpekCalc's rows. The absolute scale
// is SpekCalc's air kerma at 110 kV, 12°, 3.4 mm Al + 0.2 mm Cu.
constexpr double kDepthShare =
    0.4353;  // electrons diffuse: they radiate less deep than Thomson and Whiddington say
constexpr double kScale = 3.3834, kConstant = 0.11252, kSoft = 3.5457, kSoftRange = 0.1616;
constexpr double kLineScale = 1.2301e-3;  // Tucker's 1.349e-3

// Tucker's, as published: Thomson–Whiddington constant of tungsten by tube voltage, keV² cm²/g (from Birch and
// Marshall, Phys. Med. Biol. 24 (1979) 505), mass stopping power in keV cm²/g, and K lines (energy, share of the K
// emission).
double thomson_whiddington(double kv) {
  constexpr std::array<double, 5> at_kv = {50.0, 75.0, 100.0, 150.0, 200.0};
  constexpr std::array<double, 5> value = {0.54e6, 0.625e6, 0.7e6, 0.84e6, 1.0e6};
  std::size_t i = 0;
  while (i + 2 < at_kv.size() && kv > at_kv[i + 1]) ++i;
  return value[i] + (kv - at_kv[i]) / (at_kv[i + 1] - at_kv[i]) * (value[i + 1] - value[i]);
}
double stopping_power(double energy_kev) {
  return 2024.1 + 10361.0 * exact_exp(-0.04695 * energy_kev);
}

struct Line {
  double energy_kev, share;
};
constexpr std::array<Line, 4> kLines = {{{59.32, 0.45}, {57.98, 0.2592}, {67.2, 0.1521}, {69.1, 0.0387}}};
constexpr double kLineExponent = 1.648, kShellKev = 69.525;

// Bremsstrahlung per unit σ₀Z², by r = E/T.
double radiation(double r) {
  return kScale * (kConstant + r + kSoft * exact_exp(-r / kSoftRange));
}

// Photons per keV and electron: the integral over the energy T that the electron still has, by the middle rule.
double bremsstrahlung(double energy_kev, double kv, double sin_angle) {
  constexpr int kSteps = 200;
  const double depth = kDepthShare * mass_attenuation_cm2_g(Material::tungsten, energy_kev) /
                       (thomson_whiddington(kv) * sin_angle);  // weakening = exp(−depth·(T₀² − T²))
  const double step_kev = (kv - energy_kev) / kSteps;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double t_kev = energy_kev + (i + 0.5) * step_kev;
    sum += radiation(energy_kev / t_kev) * (t_kev + kElectronKev) / t_kev *
           exact_exp(-depth * (kv * kv - t_kev * t_kev)) / stopping_power(t_kev);
  }
  const double sigma_cm2_g = kFineStructure * kElectronRadiusCm * kElectronRadiusCm * kTungstenZ * kTungstenZ *
                             kAvogadro / kTungstenGPerMol;
  return sigma_cm2_g / energy_kev * sum * step_kev;
}

// Photons per electron of one K line: origins spread over the range as 1 − (x/R)² (Tucker's equation 13).
double line_photons(const Line& line, double kv, double sin_angle) {
  constexpr int kSteps = 200;
  const double range_g_cm2 = (kv * kv - kShellKev * kShellKev) / thomson_whiddington(kv);
  const double depth =
      kDepthShare * mass_attenuation_cm2_g(Material::tungsten, line.energy_kev) * range_g_cm2 / sin_angle;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double u = (i + 0.5) / kSteps;
    sum += 1.5 * (1.0 - u * u) * exact_exp(-depth * u) / kSteps;
  }
  return kLineScale * exact_exp(kLineExponent * exact_log(kv / kShellKev - 1.0)) * line.share * sum;
}

double kerma_behind(const Spectrum& spectrum, double aluminium_mm) {
  double sum = 0.0;  // keV cm²/(g mm²)
  for (std::size_t i = 0; i < spectrum.energy_kev.size(); ++i) {
    const double energy_kev = spectrum.energy_kev[i];
    sum += spectrum.photons_per_mas_mm2[i] * energy_kev * air_energy_absorption_cm2_g(energy_kev) *
           exact_exp(-aluminium_mm * attenuation_per_mm(Material::aluminium, energy_kev));
  }
  return sum * 100.0 * 1000.0 * kJoulePerKev * 1000.0;  // mm² per cm², g per kg, J, mGy
}

}  // namespace

Spectrum anode_spectrum(double kv, double anode_angle_deg) {
  CHECK(kv >= kMinTubeKv && kv <= kMaxTubeKv);
  CHECK(anode_angle_deg >= 5.0 && anode_angle_deg <= 45.0);
  const double sin_angle = base::exact_sin(anode_angle_deg * kPi / 180.0);
  const double per_mm2 = kElectronsPerMas / (4.0 * kPi * 1e6);  // of a sphere of 1 m
  Spectrum spectrum;
  spectrum.kv = kv;
  for (double from_kev = kFirstKev; from_kev < kv; from_kev += 1.0) {
    const double to_kev = std::min(from_kev + 1.0, kv), middle_kev = 0.5 * (from_kev + to_kev);
    double photons = bremsstrahlung(middle_kev, kv, sin_angle) * (to_kev - from_kev);
    if (kv > kShellKev)
      for (const Line& line : kLines)
        if (line.energy_kev >= from_kev && line.energy_kev < from_kev + 1.0)
          photons += line_photons(line, kv, sin_angle);
    spectrum.energy_kev.push_back(middle_kev);
    spectrum.photons_per_mas_mm2.push_back(photons * per_mm2);
  }
  return spectrum;
}

void add_filter(Spectrum& spectrum, Material material, double thickness_mm) {
  CHECK(thickness_mm >= 0.0);
  for (std::size_t i = 0; i < spectrum.energy_kev.size(); ++i)
    spectrum.photons_per_mas_mm2[i] *=
        exact_exp(-thickness_mm * attenuation_per_mm(material, spectrum.energy_kev[i]));
}

Spectrum fluoroscope_spectrum(const cases::Fluoroscope& fluoroscope, double kv) {
  Spectrum spectrum = anode_spectrum(kv, kAnodeAngleDeg);
  add_filter(spectrum, Material::aluminium, kTubeOwnAlMm + fluoroscope.filter_al_mm);
  add_filter(spectrum, Material::copper, fluoroscope.filter_cu_mm);
  return spectrum;
}

double air_kerma_mgy_per_mas(const Spectrum& spectrum) {
  return kerma_behind(spectrum, 0.0);
}

double aluminium_layer_mm(const Spectrum& spectrum, double share) {
  CHECK(share > 0.0 && share <= 1.0);
  const double wanted = share * kerma_behind(spectrum, 0.0);
  double low_mm = 0.0, high_mm = 1.0;
  while (kerma_behind(spectrum, high_mm) > wanted && high_mm < 1e4) high_mm *= 2.0;
  for (int i = 0; i < 60; ++i) {
    const double middle_mm = 0.5 * (low_mm + high_mm);
    (kerma_behind(spectrum, middle_mm) > wanted ? low_mm : high_mm) = middle_mm;
  }
  return 0.5 * (low_mm + high_mm);
}

}  // namespace seldinger::imaging
