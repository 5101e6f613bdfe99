// Value k of N of each table below is xraylib 4.0.0 (Debian libxrl 4.0.0+dfsg1; Schoonjans et al., Spectrochim.
// Acta B 66 (2011) 776) at from_kev·(to_kev/from_kev)^(k/(N − 1)): CS_Total_CP for the NIST compounds "Water,
// Liquid", "Bone, Cortical (ICRP)" and "Cesium Iodide", CS_Total for the elements. Tables end at the K edges.
// Between their points they are cubic in log–log, which agrees with xraylib within 1e-4 for water, bone, iron,
// aluminium and copper, and within 1e-3 for tungsten, caesium iodide and iodine
// (tests/sim/imaging/xray/attenuation_test.cpp).
#include "sim/imaging/xray/beam/coefficients.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "sim/base/check.h"
#include "sim/base/exact_math.h"

namespace seldinger::imaging {
namespace {

using base::exact_exp, base::exact_log;

constexpr double kIodineKKev = 33.1699624, kCaesiumKKev = 35.9865307,
                 kTungstenKKev = 69.5221023;  // where the tables jump

// cm²/g
constexpr std::array<double, 36> kWater = {
    2.780688e+00, 2.273888e+00, 1.866869e+00, 1.540080e+00, 1.277710e+00, 1.066997e+00, 8.976888e-01, 7.615621e-01,
    6.520357e-01, 5.638392e-01, 4.927444e-01, 4.353523e-01, 3.889321e-01, 3.512821e-01, 3.206558e-01, 2.956512e-01,
    2.751391e-01, 2.582182e-01, 2.441586e-01, 2.323784e-01, 2.224140e-01, 2.138937e-01, 2.065173e-01, 2.000435e-01,
    1.942812e-01, 1.890801e-01, 1.843206e-01, 1.799072e-01, 1.757640e-01, 1.718298e-01, 1.680569e-01, 1.644064e-01,
    1.608484e-01, 1.573596e-01, 1.539225e-01, 1.505240e-01};
constexpr std::array<double, 36> kCorticalBone = {
    1.448989e+01, 1.184322e+01, 9.678945e+00, 7.910731e+00, 6.467354e+00, 5.290151e+00, 4.330817e+00, 3.549664e+00,
    2.914095e+00, 2.397326e+00, 1.977436e+00, 1.636460e+00, 1.359698e+00, 1.135077e+00, 9.528179e-01, 8.049282e-01,
    6.848841e-01, 5.874156e-01, 5.082048e-01, 4.437523e-01, 3.912233e-01, 3.483199e-01, 3.131815e-01, 2.843038e-01,
    2.604727e-01, 2.407110e-01, 2.242274e-01, 2.103781e-01, 1.986477e-01, 1.886185e-01, 1.799558e-01, 1.723884e-01,
    1.656987e-01, 1.597128e-01, 1.542913e-01, 1.493227e-01};
constexpr std::array<double, 36> kIron = {
    9.377722e+01, 7.736502e+01, 6.375360e+01, 5.247134e+01, 4.313157e+01, 3.541495e+01, 2.905107e+01, 2.381183e+01,
    1.950459e+01, 1.596729e+01, 1.306543e+01, 1.068734e+01, 8.740458e+00, 7.147756e+00, 5.846186e+00, 4.783568e+00,
    3.916731e+00, 3.210367e+00, 2.635224e+00, 2.167292e+00, 1.786826e+00, 1.477524e+00, 1.226016e+00, 1.021451e+00,
    8.550436e-01, 7.196690e-01, 6.095033e-01, 5.197723e-01, 4.466124e-01, 3.868682e-01, 3.379905e-01, 2.979076e-01,
    2.649454e-01, 2.377467e-01, 2.152099e-01, 1.964418e-01};
constexpr std::array<double, 36> kAluminium = {
    1.360142e+01, 1.103632e+01, 8.956074e+00, 7.270215e+00, 5.905013e+00, 4.800389e+00, 3.907272e+00, 3.185678e+00,
    2.602982e+00, 2.132566e+00, 1.752883e+00, 1.446476e+00, 1.199209e+00, 9.995987e-01, 8.384478e-01, 7.083037e-01,
    6.031226e-01, 5.180524e-01, 4.491454e-01, 3.932287e-01, 3.477545e-01, 3.106800e-01, 2.803630e-01, 2.554746e-01,
    2.349389e-01, 2.178959e-01, 2.036555e-01, 1.916610e-01, 1.814688e-01, 1.727196e-01, 1.651264e-01, 1.584572e-01,
    1.525272e-01, 1.471893e-01, 1.423264e-01, 1.378452e-01};
constexpr std::array<double, 36> kCopper = {
    1.216527e+02, 1.003783e+02, 8.268488e+01, 6.810987e+01, 5.614078e+01, 4.628000e+01, 3.813178e+01, 3.138359e+01,
    2.579450e+01, 2.117564e+01, 1.736724e+01, 1.423358e+01, 1.165991e+01, 9.549091e+00, 7.819892e+00, 6.404423e+00,
    5.246520e+00, 4.300240e+00, 3.527411e+00, 2.896654e+00, 2.382166e+00, 1.962800e+00, 1.621227e+00, 1.343170e+00,
    1.116813e+00, 9.325274e-01, 7.824539e-01, 6.601569e-01, 5.604482e-01, 4.790818e-01, 4.126107e-01, 3.582174e-01,
    3.136177e-01, 2.769569e-01, 2.467271e-01, 2.217042e-01};
constexpr std::array<double, 28> kTungstenBelowK = {
    2.194675e+02, 1.870925e+02, 1.595120e+02, 1.359003e+02, 1.151578e+02, 9.759873e+01, 8.273359e+01,
    7.014824e+01, 5.939879e+01, 5.025923e+01, 4.253894e+01, 3.601611e+01, 3.050366e+01, 2.584385e+01,
    2.188999e+01, 1.850805e+01, 1.565527e+01, 1.324830e+01, 1.121701e+01, 9.492788e+00, 8.035202e+00,
    6.806373e+00, 5.769110e+00, 4.890300e+00, 4.149837e+00, 3.525052e+00, 2.997115e+00, 2.551962e+00};
constexpr std::array<double, 12> kTungstenAboveK = {1.123391e+01, 9.365796e+00, 7.820561e+00, 6.544554e+00,
                                                    5.484415e+00, 4.596587e+00, 3.848958e+00, 3.220052e+00,
                                                    2.692987e+00, 2.252728e+00, 1.886008e+00, 1.581253e+00};
constexpr std::array<double, 20> kCsIBelowIodineK = {
    9.436395e+01, 8.231556e+01, 7.181848e+01, 6.267221e+01, 5.463804e+01, 4.757663e+01, 4.143781e+01,
    3.609999e+01, 3.145766e+01, 2.741925e+01, 2.386583e+01, 2.077276e+01, 1.808617e+01, 1.575234e+01,
    1.372473e+01, 1.196294e+01, 1.043197e+01, 9.101433e+00, 7.934738e+00, 6.921483e+00};
constexpr std::array<double, 4> kCsIBetween = {2.122057e+01, 1.977831e+01, 1.843476e+01, 1.718281e+01};
constexpr std::array<double, 20> kCsIAboveCaesiumK = {
    3.026265e+01, 2.487304e+01, 2.046785e+01, 1.685481e+01, 1.386521e+01, 1.137582e+01, 9.311273e+00,
    7.615392e+00, 6.230392e+00, 5.098859e+00, 4.173716e+00, 3.416906e+00, 2.798183e+00, 2.293406e+00,
    1.882330e+00, 1.547942e+00, 1.276021e+00, 1.054955e+00, 8.752405e-01, 7.291130e-01};
constexpr std::array<double, 20> kIodineBelowK = {
    8.952384e+01, 7.806942e+01, 6.809354e+01, 5.940435e+01, 5.177736e+01, 4.507889e+01, 3.925663e+01,
    3.419494e+01, 2.979353e+01, 2.596534e+01, 2.259743e+01, 1.966636e+01, 1.712097e+01, 1.491027e+01,
    1.299004e+01, 1.132195e+01, 9.872748e+00, 8.613602e+00, 7.510648e+00, 6.552904e+00};
constexpr std::array<double, 24> kIodineAboveK = {
    3.582729e+01, 3.025336e+01, 2.554209e+01, 2.155348e+01, 1.817429e+01, 1.530941e+01, 1.288100e+01, 1.082337e+01,
    9.085195e+00, 7.622278e+00, 6.394581e+00, 5.364839e+00, 4.501335e+00, 3.777441e+00, 3.170727e+00, 2.662694e+00,
    2.237830e+00, 1.882890e+00, 1.586636e+00, 1.339410e+00, 1.133154e+00, 9.610952e-01, 8.175561e-01, 6.977814e-01};

// Hubbell and Seltzer, NISTIR 5632 (1995), air, dry, near sea level: μ_en/ρ, cm²/g. (xraylib's CS_Energy is no
// substitute: at 20 keV it is a third lower.)
constexpr std::array<double, 10> kAirKev = {10.0, 15.0, 20.0, 30.0, 40.0, 50.0, 60.0, 80.0, 100.0, 150.0};
constexpr std::array<double, 10> kAirAbsorption = {4.742,   1.334,   0.5389,  0.1537,  0.06833,
                                                   0.04098, 0.03041, 0.02407, 0.02325, 0.02496};

// Lagrange's cubic through four points of log μ.
double cubic(const std::array<double, 4>& x, const std::array<double, 4>& log_y, double at) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    double weight = 1.0;
    for (std::size_t j = 0; j < 4; ++j)
      if (j != i) weight *= (at - x[j]) / (x[i] - x[j]);
    sum += weight * log_y[i];
  }
  return exact_exp(sum);
}

double in_table(double from_kev, double to_kev, std::span<const double> values, double energy_kev) {
  const double at =
      exact_log(energy_kev / from_kev) / exact_log(to_kev / from_kev) * static_cast<double>(values.size() - 1);
  const auto first = static_cast<std::size_t>(std::clamp(at - 1.0, 0.0, static_cast<double>(values.size() - 4)));
  std::array<double, 4> log_y;
  for (std::size_t i = 0; i < 4; ++i) log_y[i] = exact_log(values[first + i]);
  return cubic({0.0, 1.0, 2.0, 3.0}, log_y, at - static_cast<double>(first));
}

double caesium_iodide(double energy_kev) {
  if (energy_kev < kIodineKKev) return in_table(kLowestTableKev, kIodineKKev, kCsIBelowIodineK, energy_kev);
  if (energy_kev < kCaesiumKKev) return in_table(kIodineKKev, kCaesiumKKev, kCsIBetween, energy_kev);
  return in_table(kCaesiumKKev, kHighestTableKev, kCsIAboveCaesiumK, energy_kev);
}

double iodine(double energy_kev) {
  if (energy_kev < kIodineKKev) return in_table(kLowestTableKev, kIodineKKev, kIodineBelowK, energy_kev);
  return in_table(kIodineKKev, kHighestTableKev, kIodineAboveK, energy_kev);
}

double tungsten(double energy_kev) {
  if (energy_kev < kTungstenKKev) return in_table(kLowestTableKev, kTungstenKKev, kTungstenBelowK, energy_kev);
  return in_table(kTungstenKKev, kHighestTableKev, kTungstenAboveK, energy_kev);
}

}  // namespace

double mass_attenuation_cm2_g(Material material, double energy_kev) {
  CHECK(energy_kev >= kLowestTableKev && energy_kev <= kHighestTableKev);
  const auto whole = [&](std::span<const double> values) {
    return in_table(kLowestTableKev, kHighestTableKev, values, energy_kev);
  };
  switch (material) {
    case Material::water:
      return whole(kWater);
    case Material::cortical_bone:
      return whole(kCorticalBone);
    case Material::iron:
      return whole(kIron);
    case Material::aluminium:
      return whole(kAluminium);
    case Material::copper:
      return whole(kCopper);
    case Material::tungsten:
      return tungsten(energy_kev);
    case Material::caesium_iodide:
      return caesium_iodide(energy_kev);
    case Material::iodine:
      return iodine(energy_kev);
  }
  CHECK(false);
}

double density_g_cm3(Material material) noexcept {
  switch (material) {
    case Material::water:
      return 1.000;
    case Material::cortical_bone:
      return 1.85;  // of xraylib's "Bone, Cortical (ICRP)"
    case Material::iron:
      return 7.874;
    case Material::aluminium:
      return 2.699;
    case Material::copper:
      return 8.96;
    case Material::tungsten:
      return 19.3;
    case Material::caesium_iodide:
      return 4.51;
    case Material::iodine:
      return 4.93;
  }
  CHECK(false);
}

double attenuation_per_mm(Material material, double energy_kev) {
  return 0.1 * density_g_cm3(material) * mass_attenuation_cm2_g(material, energy_kev);
}

double air_energy_absorption_cm2_g(double energy_kev) {
  CHECK(energy_kev >= kLowestTableKev && energy_kev <= kHighestTableKev);
  std::size_t first = 0;
  while (first + 4 < kAirKev.size() && energy_kev > kAirKev[first + 2]) ++first;
  std::array<double, 4> log_x, log_y;
  for (std::size_t i = 0; i < 4; ++i) {
    log_x[i] = exact_log(kAirKev[first + i]);
    log_y[i] = exact_log(kAirAbsorption[first + i]);
  }
  return cubic(log_x, log_y, exact_log(energy_kev));
}

}  // namespace seldinger::imaging
