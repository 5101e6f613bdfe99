// Tests of sim/haptics/needle/needle_tissue: the table.
#include "sim/haptics/needle/needle_tissue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace seldinger::haptics {
namespace {

using volume::TissueClass;

TEST(NeedleTissues, HoldTheThesisLines) {
  EXPECT_EQ(needle_tissue(TissueClass::kidney).slope_n_mm, 0.010);
  EXPECT_EQ(needle_tissue(TissueClass::kidney).intercept_n, 1.53);
  EXPECT_EQ(needle_tissue(TissueClass::liver).slope_n_mm, 0.020);
  EXPECT_EQ(needle_tissue(TissueClass::liver).intercept_n, 0.38);
}

TEST(NeedleTissues, EveryClassHasItsRow) {
  for (std::size_t i = 0; i < volume::kTissueClasses; ++i)
    EXPECT_EQ(needle_tissues()[i].tissue, static_cast<TissueClass>(i)) << i;
  for (const TissueClass hard : {TissueClass::bone, TissueClass::metal})
    EXPECT_TRUE(needle_tissue(hard).impenetrable);
  for (const TissueClass empty : {TissueClass::air, TissueClass::gas, TissueClass::fluid})
    EXPECT_EQ(needle_tissue(empty).intercept_n + needle_tissue(empty).slope_n_mm, 0.0);
}

TEST(NeedleTissues, EveryRowSaysWhereItComesFromAndIsPhysical) {
  for (const NeedleTissueRow& row : needle_tissues()) {
    const std::string name = volume::about(row.tissue).name;
    const NeedleTissue& tissue = row.needle;
    EXPECT_NE(std::string(row.provenance), "") << name;
    EXPECT_NE(std::string(row.validated_against), "") << name;
    if (tissue.impenetrable || tissue.rupture_n == 0.0) continue;
    EXPECT_GT(tissue.slope_n_mm, 0.0) << name;
    EXPECT_GT(tissue.tip_stiffness_n_mm, 2.0 * tissue.slope_n_mm) << name;
    EXPECT_GT(tissue.dent_mm, 0.0) << name;
    EXPECT_GT(tissue.rupture_n, tissue.intercept_n + tissue.slope_n_mm * tissue.dent_mm)
        << name << ": a capsule is felt as a fall";
  }
}

TEST(NeedleTissues, BetweenFatAndTissueHuDecides) {
  const NeedleTissue &fat = needle_tissue(TissueClass::fat), &full = needle_tissue(TissueClass::soft_tissue);
  for (const double hu : {-300.0, -100.0}) {
    EXPECT_EQ(soft_tissue_of_hu(hu).intercept_n, fat.intercept_n);
    EXPECT_EQ(soft_tissue_of_hu(hu).rupture_n, fat.rupture_n);
  }
  for (const double hu : {40.0, 300.0}) {
    EXPECT_NEAR(soft_tissue_of_hu(hu).intercept_n, full.intercept_n, 1e-12);
    EXPECT_NEAR(soft_tissue_of_hu(hu).dent_mm, full.dent_mm, 1e-12);
  }
  EXPECT_NEAR(soft_tissue_of_hu(-30.0).intercept_n, 0.5 * (fat.intercept_n + full.intercept_n), 1e-12);
  EXPECT_NEAR(soft_tissue_of_hu(-30.0).slope_n_mm, 0.5 * (fat.slope_n_mm + full.slope_n_mm), 1e-12);
}

TEST(NeedleTissues, ThickerNeedlesTakeMoreForce) {
  const NeedleTissue& liver = needle_tissue(TissueClass::liver);
  const NeedleTissue same = at_gauge(liver, *cases::gauge(22)), thick = at_gauge(liver, *cases::gauge(18));
  EXPECT_EQ(same.intercept_n, liver.intercept_n);
  EXPECT_NEAR(thick.intercept_n / liver.intercept_n, 1.270 / 0.718, 1e-12);
  EXPECT_NEAR(thick.slope_n_mm / liver.slope_n_mm, 1.270 / 0.718, 1e-12);
  EXPECT_NEAR(thick.rupture_n / liver.rupture_n, 1.270 / 0.718, 1e-12);
  EXPECT_EQ(thick.dent_mm, liver.dent_mm);
  const NeedleTissue back = at_table_gauge(thick, *cases::gauge(18));
  EXPECT_NEAR(back.intercept_n, liver.intercept_n, 1e-12);
  EXPECT_NEAR(back.slope_n_mm, liver.slope_n_mm, 1e-12);
  EXPECT_NEAR(back.rupture_n, liver.rupture_n, 1e-12);
  EXPECT_EQ(back.dent_mm, liver.dent_mm);
}

// Published and older cases: bit for bit, whatever their tip.
TEST(NeedleTips, ByTheLawOfBeforeTheGaugeAloneCounts) {
  for (const NeedleTissueRow& row : needle_tissues())
    for (const int number : {16, 18, kTableGauge, 25})
      for (const NeedleTipRow& tip : needle_tips()) {
        const cases::Gauge gauge = *cases::gauge(number);
        const NeedleTissue before = at_gauge(row.needle, gauge);
        const NeedleTissue felt = felt_by(row.needle, gauge, {tip.tip, cases::TouchLaw::steady});
        EXPECT_EQ(felt.slope_n_mm, before.slope_n_mm);
        EXPECT_EQ(felt.intercept_n, before.intercept_n);
        EXPECT_EQ(felt.rupture_n, before.rupture_n);
        EXPECT_EQ(felt.tip_stiffness_n_mm, before.tip_stiffness_n_mm);
      }
}

TEST(NeedleTips, EachHasItsRowAndSaysWhereItComesFrom) {
  for (std::size_t i = 0; i < needle_tips().size(); ++i) {
    const NeedleTipRow& tip = needle_tips()[i];
    EXPECT_EQ(tip.tip, static_cast<cases::NeedleTip>(i));
    EXPECT_NE(std::string(tip.provenance), "");
  }
  const NeedleTissue& kidney = needle_tissue(TissueClass::kidney);
  const NeedleTissue chiba = felt_by(kidney, *cases::gauge(kTableGauge), {.law = cases::TouchLaw::by_speed});
  EXPECT_NEAR(chiba.intercept_n, kidney.intercept_n, 1e-12) << "the rows are a Chiba's";
  EXPECT_NEAR(chiba.slope_n_mm, kidney.slope_n_mm, 1e-12);
  EXPECT_NEAR(chiba.rupture_n, kidney.rupture_n, 1e-12);
}

// What shares an end with a plateau's: friction is the circumference's, cutting lies between the blade's width and
// the hole's area.
TEST(NeedleTips, BladeAndShaftGrowApart) {
  for (const NeedleTissueRow& row : needle_tissues()) {
    if (!(row.needle.rupture_n > 0.0)) continue;
    for (const NeedleTipRow& tip : needle_tips())
      for (const int number : {16, 18, 25}) {
        const cases::Gauge gauge = *cases::gauge(number), table = *cases::gauge(kTableGauge);
        const cases::Touch touch{tip.tip, cases::TouchLaw::by_speed};
        const NeedleTissue at_table = felt_by(row.needle, table, touch), felt = felt_by(row.needle, gauge, touch);
        const double wide = gauge.outer_mm / table.outer_mm;
        EXPECT_NEAR(felt.slope_n_mm / at_table.slope_n_mm, wide, 1e-12);
        const double cutting = felt.intercept_n / at_table.intercept_n;
        EXPECT_GT(cutting, std::min(wide, wide * wide));
        EXPECT_LT(cutting, std::max(wide, wide * wide));
        EXPECT_NEAR(felt.rupture_n / at_table.rupture_n, wide, 1e-12);
        EXPECT_GT(felt.rupture_n, felt.intercept_n + felt.slope_n_mm * felt.dent_mm)
            << base::name_of(cases::kNeedleTipNames, tip.tip) << " " << number << " "
            << volume::about(row.tissue).name << ": a capsule is felt as a fall";
      }
  }
}

// Skin, 18 to 22 G: 2 to 4 N (van Gerwen 2012, Healey 2005, recalled), by the needles of these sizes.
TEST(NeedleTips, SkinOpensWithinThePublishedRange) {
  const NeedleTissue& skin = needle_tissue(TissueClass::skin);
  const NeedleTissue chiba = felt_by(skin, *cases::gauge(22), {.law = cases::TouchLaw::by_speed});
  const NeedleTissue core = felt_by(skin, *cases::gauge(18), {cases::NeedleTip::core, cases::TouchLaw::by_speed});
  for (const double opens_n : {chiba.rupture_n, core.rupture_n}) {
    EXPECT_GE(opens_n, 2.0);
    EXPECT_LE(opens_n, 4.0);
  }
}

}  // namespace
}  // namespace seldinger::haptics
