// The acoustic table against what the literature says of pairs of tissues.
#include "sim/imaging/ultrasound/view/tissue.h"

#include <gtest/gtest.h>

#include <cmath>

#include "shaders/shared/ultrasound.glsl.h"
#include "sim/case/case.h"

namespace seldinger::imaging {
namespace {

using volume::TissueClass;

const Acoustics& of(TissueClass tissue) {
  return acoustic_table()[static_cast<std::size_t>(tissue)];
}
double reflection_db(TissueClass a, TissueClass b) {
  return 20.0 * std::log10(std::abs(shaders::us_reflection(of(a).impedance_mrayl, of(b).impedance_mrayl)));
}

TEST(AcousticTable, PairsReflectAsMeasured) {
  EXPECT_NEAR(reflection_db(TissueClass::fat, TissueClass::muscle), -19.7, 0.5);
  EXPECT_NEAR(reflection_db(TissueClass::fat, TissueClass::liver), -21.0, 1.5);
  EXPECT_NEAR(reflection_db(TissueClass::liver, TissueClass::kidney), -40.7, 2.0);
  EXPECT_NEAR(reflection_db(TissueClass::liver, TissueClass::bone), -3.7, 0.3);
  EXPECT_NEAR(reflection_db(TissueClass::muscle, TissueClass::gas), -0.004, 0.001);
  EXPECT_NEAR(reflection_db(TissueClass::muscle, TissueClass::metal), -0.6, 0.1);
  // A vessel full of contrast is blood: 38 to 50 dB, not the 19 to 23 that its HU would give.
  EXPECT_LT(reflection_db(TissueClass::liver, TissueClass::vessel), -38.0);
}

TEST(AcousticTable, TwoWayThroughAStep) {
  const auto loss_db = [](TissueClass a, TissueClass b) {
    return shaders::us_step_loss_db(shaders::us_reflection(of(a).impedance_mrayl, of(b).impedance_mrayl));
  };
  EXPECT_NEAR(loss_db(TissueClass::liver, TissueClass::bone), 4.8, 0.2);
  EXPECT_NEAR(loss_db(TissueClass::muscle, TissueClass::gas), 60.5, 0.5);
  EXPECT_NEAR(loss_db(TissueClass::muscle, TissueClass::metal), 17.6, 0.5);
  EXPECT_EQ(shaders::us_step_loss_db(0.0), 0.0);
  EXPECT_NEAR(shaders::us_step_loss_db(1.0), 120.0, 1e-6);  // a mirror, not infinity
  EXPECT_EQ(loss_db(TissueClass::fat, TissueClass::bone), loss_db(TissueClass::bone, TissueClass::fat));
}

TEST(AcousticTable, EveryRowIsPhysical) {
  for (const Acoustics& tissue : acoustic_table()) {
    EXPECT_GT(tissue.impedance_mrayl, 0.0);
    EXPECT_GT(tissue.attenuation_db_cm_mhz, 0.0);
    EXPECT_GE(tissue.exponent, 1.0);
    EXPECT_LE(tissue.scatter_db, 6.0);
  }
  // Fei and Shung 1985: of the organs the liver scatters most, the spleen least.
  EXPECT_GT(of(TissueClass::liver).scatter_db, of(TissueClass::kidney).scatter_db);
  EXPECT_GT(of(TissueClass::kidney).scatter_db, of(TissueClass::spleen).scatter_db);
}

TEST(AcousticTable, TheOverrideIsOfSoftClassesOnly) {
  const AcousticTable table = acoustic_table(0.7);
  for (std::size_t i = 0; i < table.size(); ++i) {
    const Acoustics& stored = acoustic_table()[i];
    EXPECT_EQ(table[i].attenuation_db_cm_mhz, stored.soft ? 0.7 : stored.attenuation_db_cm_mhz) << i;
    EXPECT_EQ(table[i].exponent, stored.soft ? 1.0 : stored.exponent) << i;
    EXPECT_EQ(table[i].impedance_mrayl, stored.impedance_mrayl) << i;
  }
  EXPECT_FALSE(of(TissueClass::fluid).soft);  // a cyst keeps its enhancement
  EXPECT_FALSE(of(TissueClass::bone).soft);
}

TEST(AcousticTable, LesionsByHu) {
  EXPECT_EQ(cases::tissue_of_lesion(-100.0), TissueClass::fat);
  EXPECT_EQ(cases::tissue_of_lesion(5.0), TissueClass::fluid);
  EXPECT_EQ(cases::tissue_of_lesion(60.0), TissueClass::soft_tissue);
  EXPECT_EQ(cases::tissue_of_lesion(-1000.0), TissueClass::gas);
  EXPECT_EQ(cases::tissue_of_lesion(700.0), TissueClass::bone);
  EXPECT_EQ(cases::tissue_of_lesion(3000.0), TissueClass::metal);
  EXPECT_EQ(cases::tissue_of_lesion(std::nan("")), TissueClass::gas);
}

}  // namespace
}  // namespace seldinger::imaging
