// Tests of sim/haptics/needle_tissue: the table.
#include "sim/haptics/needle_tissue.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace seldinger::haptics {
namespace {

TEST(NeedleTissues, HoldTheThesisLines) {
  EXPECT_EQ(find_needle_tissue("kidney")->slope_n_mm, 0.010);
  EXPECT_EQ(find_needle_tissue("kidney")->intercept_n, 1.53);
  EXPECT_EQ(find_needle_tissue("liver")->slope_n_mm, 0.020);
  EXPECT_EQ(find_needle_tissue("liver")->intercept_n, 0.38);
  EXPECT_EQ(find_needle_tissue("aluminium"), nullptr);
}

TEST(NeedleTissues, EveryRowSaysWhereItComesFromAndIsPhysical) {
  std::set<std::string> names;
  for (const NeedleTissue& tissue : needle_tissues()) {
    EXPECT_TRUE(names.insert(tissue.name).second) << tissue.name;
    EXPECT_NE(std::string(tissue.provenance), "") << tissue.name;
    EXPECT_NE(std::string(tissue.validated_against), "") << tissue.name;
    EXPECT_GT(tissue.tip_stiffness_n_mm, 0.0) << tissue.name;
    if (tissue.impenetrable) continue;
    EXPECT_GE(tissue.slope_n_mm, 0.0) << tissue.name;
    EXPECT_GT(tissue.dent_mm, 0.0) << tissue.name;
    EXPECT_GT(tissue.rupture_n, tissue.intercept_n + tissue.slope_n_mm * tissue.dent_mm)
        << tissue.name << ": a capsule is felt as a fall";
  }
}

TEST(NeedleTissues, ThickerNeedlesTakeMoreForce) {
  const NeedleTissue& liver = *find_needle_tissue("liver");
  const NeedleTissue same = at_gauge(liver, *cases::gauge(22)), thick = at_gauge(liver, *cases::gauge(18));
  EXPECT_EQ(same.intercept_n, liver.intercept_n);
  EXPECT_NEAR(thick.intercept_n / liver.intercept_n, 1.270 / 0.718, 1e-12);
  EXPECT_NEAR(thick.slope_n_mm / liver.slope_n_mm, 1.270 / 0.718, 1e-12);
  EXPECT_NEAR(thick.rupture_n / liver.rupture_n, 1.270 / 0.718, 1e-12);
}

}  // namespace
}  // namespace seldinger::haptics
