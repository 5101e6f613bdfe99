// The tube's spectrum against published half-value layers and outputs, and against what must hold of any.
#include "sim/imaging/xray/beam/spectrum.h"

#include <gtest/gtest.h>
#include <xraylib/xraylib.h>

#include <cmath>
#include <numbers>

namespace seldinger::imaging {
namespace {

// What xraylib knows and the tables do not: window, foil and air of the laboratories.
void weaken(Spectrum& spectrum, const char* compound, double density_g_cm3, double mm) {
  for (std::size_t i = 0; i < spectrum.energy_kev.size(); ++i)
    spectrum.photons_per_mas_mm2[i] *=
        std::exp(-0.1 * mm * density_g_cm3 * CS_Total_CP(compound, spectrum.energy_kev[i], nullptr));
}
constexpr const char* kAir = "Air, Dry (near sea level)";

double second_layer_mm(const Spectrum& spectrum) {
  return aluminium_layer_mm(spectrum, 0.25) - aluminium_layer_mm(spectrum);
}

struct Measured {
  const char* name;
  double kv, beryllium_mm, aluminium_mm, first_mm, second_mm;
};
// PTB's realisation of IEC 61267, measured with a germanium spectrometer (Ankerhold, PTB-Dos-34, 2000;
// doi 10.7795/110.20190315B): anode 20°, 0.25 mm polyimide monitor foil, 950 mm of air.
constexpr Measured kPtb[] = {{"RQR2", 40, 1, 2.5, 1.36, 1.72},     {"RQR3", 50, 1, 2.5, 1.72, 2.30},
                             {"RQR4", 60, 1, 2.5, 2.02, 2.84},     {"RQR5", 70, 1, 2.5, 2.29, 3.37},
                             {"RQR6", 80, 1, 2.5, 2.59, 3.96},     {"RQR7", 90, 1, 2.5, 2.91, 4.57},
                             {"RQR8", 100, 1, 2.5, 3.23, 5.19},    {"RQR9", 120, 1, 2.5, 3.88, 6.37},
                             {"RQR10", 150, 7, 2.5, 5.01, 8.15},   {"RQA2", 40, 1, 6.5, 2.13, 2.41},
                             {"RQA3", 50, 1, 12.5, 3.67, 4.05},    {"RQA4", 60, 1, 18.5, 5.24, 5.70},
                             {"RQA5", 70, 1, 23.5, 6.64, 7.16},    {"RQA6", 80, 1, 28.5, 7.96, 8.50},
                             {"RQA7", 90, 1, 32.5, 9.03, 9.57},    {"RQA8", 100, 1, 36.5, 9.93, 10.47},
                             {"RQA9", 120, 1, 42.5, 11.37, 11.97}, {"RQA10", 150, 7, 50.0, 12.97, 13.66}};

TEST(Spectrum, HalfValueLayersThatPtbMeasured) {
  for (const Measured& m : kPtb) {
    Spectrum spectrum = anode_spectrum(m.kv, 20.0);
    weaken(spectrum, "Be", 1.848, m.beryllium_mm);
    add_filter(spectrum, Material::aluminium, m.aluminium_mm);
    weaken(spectrum, "Kapton Polyimide Film", 1.42, 0.25);
    weaken(spectrum, kAir, 0.0012, 950.0);
    const double first = aluminium_layer_mm(spectrum) / m.first_mm - 1.0;
    const double second = second_layer_mm(spectrum) / m.second_mm - 1.0;
    RecordProperty(m.name, std::to_string(100.0 * first) + " % " + std::to_string(100.0 * second) + " %");
    // 150 kV is beyond fluoroscopy (and its tube another): not fitted, but kept in sight.
    const bool fitted = m.kv <= 120.0;
    EXPECT_NEAR(first, 0.0, fitted ? 0.015 : 0.05) << m.name;
    EXPECT_NEAR(second, 0.0, fitted ? 0.03 : 0.05) << m.name;
  }
}

struct Computed {
  double kv, copper_mm, first_mm;
};
// SpekPy's values for an angiographic unit in PySkinDose (HVL_simulated, AXIOM-Artis): anode 8°, 4.1 mm aluminium,
// 770 mm of air. A model too: it is 2 % harder at 40 to 50 kV, and so cannot be met closer together with PTB.
constexpr Computed kAngiographic[] = {
    {40, 0.0, 1.7956},  {50, 0.0, 2.3310},  {50, 0.1, 3.0940},  {50, 0.3, 3.9935},
    {70, 0.0, 3.2759},  {70, 0.1, 4.4231},  {70, 0.3, 5.8163},  {80, 0.0, 3.7573},
    {80, 0.1, 5.0642},  {80, 0.3, 6.6343},  {80, 0.9, 8.6561},  {90, 0.1, 5.6768},
    {100, 0.0, 4.7314}, {100, 0.1, 6.2437}, {100, 0.3, 7.9741}, {100, 0.9, 10.1126}};

TEST(Spectrum, HalfValueLayersOfAnAngiographicUnit) {
  for (const Computed& c : kAngiographic) {
    Spectrum spectrum = anode_spectrum(c.kv, 8.0);
    add_filter(spectrum, Material::aluminium, 4.1);
    add_filter(spectrum, Material::copper, c.copper_mm);
    weaken(spectrum, kAir, 0.0012, 770.0);
    EXPECT_NEAR(aluminium_layer_mm(spectrum) / c.first_mm, 1.0, c.kv < 60.0 ? 0.025 : 0.021)
        << c.kv << " kV " << c.copper_mm << " mm Cu";
  }
}

// SpekCalc (Poludniowski et al., Phys. Med. Biol. 54 (2009) N433) at 110 kV, 12°, 3.4 mm Al + 0.2 mm Cu + 1 m of
// air: 41.92 µGy/mAs at 1 m sets our scale, 7.53 and 9.01 mm are the layers. With 80 kV and 0.5 mm Al only, 194.1
// µGy/mAs, much of it from where our bins begin.
TEST(Spectrum, OutputOfSpekCalc) {
  Spectrum hard = anode_spectrum(110.0, 12.0);
  add_filter(hard, Material::aluminium, 3.4);
  add_filter(hard, Material::copper, 0.2);
  weaken(hard, kAir, 0.0012, 1000.0);
  EXPECT_NEAR(1000.0 * air_kerma_mgy_per_mas(hard), 41.92, 0.42);
  EXPECT_NEAR(aluminium_layer_mm(hard), 7.531, 0.02 * 7.531);
  EXPECT_NEAR(second_layer_mm(hard), 9.012, 0.02 * 9.012);
  Spectrum soft = anode_spectrum(80.0, 12.0);
  add_filter(soft, Material::aluminium, 0.5);
  weaken(soft, kAir, 0.0012, 1000.0);
  EXPECT_NEAR(1000.0 * air_kerma_mgy_per_mas(soft), 194.1, 0.1 * 194.1);
}

TEST(Spectrum, LayersGrowWithVoltageAndFilter) {
  double before_mm = 0.0;
  for (double kv = 40.0; kv <= 150.0; kv += 5.0) {
    const double layer_mm = aluminium_layer_mm(fluoroscope_spectrum({}, kv));
    EXPECT_GT(layer_mm, before_mm) << kv;
    before_mm = layer_mm;
    Spectrum spectrum = anode_spectrum(kv, 12.0);
    add_filter(spectrum, Material::aluminium, 2.5);
    const double kerma = air_kerma_mgy_per_mas(spectrum), layer = aluminium_layer_mm(spectrum);
    EXPECT_GT(second_layer_mm(spectrum), layer) << kv;  // a beam hardens
    add_filter(spectrum, Material::copper, 0.1);
    EXPECT_GT(aluminium_layer_mm(spectrum), layer) << kv;
    EXPECT_LT(air_kerma_mgy_per_mas(spectrum), kerma) << kv;
  }
}

TEST(Spectrum, OneEnergyIsBeerLambert) {
  for (const double e : {30.0, 60.0, 100.0}) {
    const Spectrum line{e, {e}, {1e6}};
    EXPECT_NEAR(aluminium_layer_mm(line) * attenuation_per_mm(Material::aluminium, e), std::numbers::ln2, 1e-12);
    EXPECT_NEAR(second_layer_mm(line) / aluminium_layer_mm(line), 1.0, 1e-12);
    // 1e6 photons/mm² of E keV: Φ E μ_en/ρ.
    const double gray = 1e8 * e * 1.602176634e-16 * air_energy_absorption_cm2_g(e) * 1000.0;
    EXPECT_NEAR(air_kerma_mgy_per_mas(line) / (1000.0 * gray), 1.0, 1e-12);
  }
}

TEST(Spectrum, EndsAtTheVoltageAndHasItsLinesAboveTheirEdgeOnly) {
  for (const double kv : {40.0, 69.0, 70.0, 72.5, 90.0, 150.0}) {
    const Spectrum spectrum = anode_spectrum(kv, 12.0);
    ASSERT_EQ(spectrum.energy_kev.size(), spectrum.photons_per_mas_mm2.size());
    EXPECT_LT(spectrum.energy_kev.back(), kv);
    EXPECT_GE(spectrum.energy_kev.back(), kv - 1.0);
    for (std::size_t i = 0; i < spectrum.energy_kev.size(); ++i) {
      EXPECT_GT(spectrum.photons_per_mas_mm2[i], 0.0) << kv << ' ' << i;
      if (i > 0) {
        EXPECT_GT(spectrum.energy_kev[i], spectrum.energy_kev[i - 1]);
      }
    }
    if (kv < 62.0) continue;
    const auto at = [&](double e) { return spectrum.photons_per_mas_mm2[static_cast<std::size_t>(e - 13.0)]; };
    const double over_neighbours = at(59.0) / (0.25 * at(56.0) + 0.75 * at(60.0));  // Kα1
    if (kv < 69.5) {
      EXPECT_NEAR(over_neighbours, 1.0, 0.01) << kv;
    } else if (kv >= 90.0) {
      EXPECT_GT(over_neighbours, 1.5) << kv;
    }
  }
}

// Of the order that hospitals measure: about 0.05 to 0.1 mGy/mAs at 1 m, 80 kV and 2.5 mm Al.
TEST(Spectrum, OutputIsOfTheRightOrder) {
  Spectrum spectrum = anode_spectrum(80.0, 12.0);
  add_filter(spectrum, Material::aluminium, 2.5);
  EXPECT_GT(air_kerma_mgy_per_mas(spectrum), 0.05);
  EXPECT_LT(air_kerma_mgy_per_mas(spectrum), 0.1);
}

TEST(SpectrumDeathTest, VoltagesOutside) {
  EXPECT_DEATH(anode_spectrum(39.9, 12.0), "kv");
  EXPECT_DEATH(anode_spectrum(150.1, 12.0), "kv");
}

}  // namespace
}  // namespace seldinger::imaging
