// The committed tables against xraylib, from which they were made, at and between their points.
#include "sim/imaging/xray/beam/attenuation.h"

#include <gtest/gtest.h>
#include <xraylib/xraylib.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "sim/imaging/xray/beam/coefficients.h"

namespace seldinger::imaging {
namespace {

constexpr const char* kBone = "Bone, Cortical (ICRP)";

double compound(const char* name, double energy_kev) {
  return CS_Total_CP(name, energy_kev, nullptr);
}

// Largest relative difference every 0.05 keV and a little off; +∞ for NaN.
double worst_of(double from_kev, double to_kev, const std::function<double(double)>& ours,
                const std::function<double(double)>& reference) {
  double worst = 0.0;
  for (double energy_kev = from_kev; energy_kev <= to_kev; energy_kev += 0.0497) {
    const double difference = std::abs(ours(energy_kev) / reference(energy_kev) - 1.0);
    if (!(difference < 1e9)) return INFINITY;
    worst = std::max(worst, difference);
  }
  return worst;
}

TEST(Attenuation, AgreesWithXraylib) {
  const auto water = [](double e) { return attenuation_at(e).water_per_mm; };
  const auto iron = [](double e) { return attenuation_at(e).iron_per_mm; };
  EXPECT_LE(worst_of(20.0, 150.0, water, [](double e) { return 0.1 * compound("Water, Liquid", e); }), 1e-4);
  EXPECT_LE(worst_of(20.0, 150.0, iron, [](double e) { return 0.7874 * CS_Total(26, e, nullptr); }), 1e-4);
  const auto table = [](Material material) {
    return [material](double e) { return mass_attenuation_cm2_g(material, e); };
  };
  const auto element = [](int z) { return [z](double e) { return CS_Total(z, e, nullptr); }; };
  EXPECT_LE(worst_of(12.5, 150.0, table(Material::cortical_bone), [](double e) { return compound(kBone, e); }),
            1e-4);
  EXPECT_LE(worst_of(12.5, 150.0, table(Material::aluminium), element(13)), 1e-4);
  EXPECT_LE(worst_of(12.5, 150.0, table(Material::copper), element(29)), 1e-4);
  EXPECT_LE(worst_of(12.5, 69.52, table(Material::tungsten), element(74)), 1e-3);
  EXPECT_LE(worst_of(69.523, 150.0, table(Material::tungsten), element(74)), 1e-3);
  const auto iodide = [](double e) { return compound("Cesium Iodide", e); };
  EXPECT_LE(worst_of(12.5, 33.16, table(Material::caesium_iodide), iodide), 1e-3);
  EXPECT_LE(worst_of(33.18, 35.98, table(Material::caesium_iodide), iodide), 1e-3);
  EXPECT_LE(worst_of(35.99, 150.0, table(Material::caesium_iodide), iodide), 1e-3);
  EXPECT_LE(worst_of(12.5, 33.16, table(Material::iodine), element(53)), 1e-3);
  EXPECT_LE(worst_of(33.18, 150.0, table(Material::iodine), element(53)), 1e-3);
}

TEST(Attenuation, EveryWholeKeV) {
  for (int energy_kev = 20; energy_kev <= 150; ++energy_kev) {
    const double e = energy_kev;
    EXPECT_NEAR(attenuation_at(e).water_per_mm / (0.1 * compound("Water, Liquid", e)), 1.0, 1e-4) << e;
    EXPECT_NEAR(mass_attenuation_cm2_g(Material::cortical_bone, e) / compound(kBone, e), 1.0, 1e-4) << e;
    EXPECT_NEAR(attenuation_at(e).iron_per_mm / (0.7874 * CS_Total(26, e, nullptr)), 1.0, 1e-4) << e;
  }
}

TEST(Attenuation, DensitiesAreXraylibs) {
  compoundDataNIST* bone = GetCompoundDataNISTByName(kBone, nullptr);
  ASSERT_NE(bone, nullptr);
  EXPECT_EQ(density_g_cm3(Material::cortical_bone), bone->density);
  FreeCompoundDataNIST(bone);
  EXPECT_EQ(density_g_cm3(Material::water), 1.0);
  EXPECT_EQ(density_g_cm3(Material::iron), 7.874);
}

TEST(Attenuation, WaterAt80KeV) {
  EXPECT_NEAR(10.0 * attenuation_at(80.0).water_per_mm, 0.18366, 5e-6);
}

// CT numbers are true at kHuEnergyKev for every HU, and a voxel of bone's own CT number is bone at every energy.
TEST(Attenuation, HuAreTrueAtTheirEnergyAndBoneIsBone) {
  const Attenuation at = attenuation_at(kHuEnergyKev);
  EXPECT_NEAR(at.mineral_per_mm, at.water_per_mm, 1e-14);
  const double bone_hu =
      1000.0 * (attenuation_per_mm(Material::cortical_bone, kHuEnergyKev) / at.water_per_mm - 1.0);
  EXPECT_GT(bone_hu, 1000.0);
  for (const double e : {20.0, 33.3, 60.0, 80.0, 119.5, 150.0}) {
    const Attenuation a = attenuation_at(e);
    const double bone = a.water_per_mm + bone_hu / 1000.0 * a.mineral_per_mm;
    EXPECT_NEAR(bone / attenuation_per_mm(Material::cortical_bone, e), 1.0, 1e-13) << e;
  }
}

// Of a CT at any voltage: HU are true at its energy, and what differs is what they are at others.
TEST(Attenuation, HuAreTrueAtTheEnergyOfTheCt) {
  EXPECT_EQ(ct_effective_kev(120.0), kHuEnergyKev);
  for (const std::optional<double> unknown :
       {std::optional<double>(), std::optional(60.0), std::optional(500.0), std::optional(std::nan(""))})
    EXPECT_EQ(ct_effective_kev(unknown), kHuEnergyKev);
  double last_kev = 0.0, last_mineral_per_mm = 1.0, last_hu = 1e9;
  for (const double kv : {80.0, 100.0, 120.0, 140.0}) {
    const double ct_kev = ct_effective_kev(kv);
    const Attenuation at = attenuation_at(ct_kev, ct_kev);
    EXPECT_NEAR(at.mineral_per_mm, at.water_per_mm, 1e-14) << kv;
    EXPECT_NEAR(at.contrast_per_mm * contrast_mm_of_1000_hu(ct_kev), at.water_per_mm, 1e-14) << kv;
    EXPECT_GT(ct_kev, last_kev);
    // The same HU are less mineral, and less iodine, the softer the CT's beam was.
    EXPECT_LT(at.water_per_mm, last_mineral_per_mm);
    EXPECT_LT(iodine_hu_per_mg_ml(ct_kev), last_hu);
    last_kev = ct_kev;
    last_mineral_per_mm = at.water_per_mm;
    last_hu = iodine_hu_per_mg_ml(ct_kev);
  }
  const auto mineral_at_55 = [](double kv) { return attenuation_at(55.0, ct_effective_kev(kv)).mineral_per_mm; };
  EXPECT_LT(mineral_at_55(80.0), mineral_at_55(100.0));
  EXPECT_LT(mineral_at_55(100.0), mineral_at_55(120.0));
  EXPECT_LT(mineral_at_55(120.0), mineral_at_55(140.0));
}

// Huda, Scalzetti and Levin, Radiology 217 (2000) 430: from 80 to 140 kV contrast to water falls by about 50 % for
// iodine and 39 % for bone.
TEST(Attenuation, ContrastFallsWithTheTubesVoltageAsPublished) {
  const double low_kev = ct_effective_kev(80.0), high_kev = ct_effective_kev(140.0);
  EXPECT_NEAR(1.0 - iodine_hu_per_mg_ml(high_kev) / iodine_hu_per_mg_ml(low_kev), 0.50, 0.05);
  const auto bone_hu = [](double kev) {
    return attenuation_per_mm(Material::cortical_bone, kev) / attenuation_per_mm(Material::water, kev) - 1.0;
  };
  EXPECT_NEAR(1.0 - bone_hu(high_kev) / bone_hu(low_kev), 0.39, 0.10);
  RecordProperty("iodine_hu_per_mg_ml_80_kev", std::to_string(iodine_hu_per_mg_ml(80.0)));
  RecordProperty("iodine_fall", std::to_string(1.0 - iodine_hu_per_mg_ml(high_kev) / iodine_hu_per_mg_ml(low_kev)));
  RecordProperty("bone_fall", std::to_string(1.0 - bone_hu(high_kev) / bone_hu(low_kev)));
}

TEST(Attenuation, FallsWithEnergy) {
  for (double e = 20.0; e < 149.9; e += 0.1) {
    const Attenuation a = attenuation_at(e), b = attenuation_at(e + 0.1);
    ASSERT_GT(a.water_per_mm, b.water_per_mm) << e;
    ASSERT_GT(a.mineral_per_mm, b.mineral_per_mm) << e;
    ASSERT_GT(a.iron_per_mm, b.iron_per_mm) << e;
  }
}

// The source's own points.
TEST(Attenuation, AirAbsorptionIsNists) {
  for (const auto& [e, value] :
       {std::pair{15.0, 1.334}, {20.0, 0.5389}, {60.0, 0.03041}, {80.0, 0.02407}, {150.0, 0.02496}})
    EXPECT_NEAR(air_energy_absorption_cm2_g(e) / value, 1.0, 1e-12) << e;
}

TEST(AttenuationDeathTest, OutsideItsEnergies) {
  EXPECT_DEATH(attenuation_at(19.9), "energy_kev");
  EXPECT_DEATH(attenuation_at(150.1), "energy_kev");
  EXPECT_DEATH(attenuation_at(std::nan("")), "energy_kev");
}

}  // namespace
}  // namespace seldinger::imaging
