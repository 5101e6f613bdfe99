// What is told of contrast and classes; the torso in its phases: tissue_grid_test.cpp.
#include "sim/volume/tissue/contrast.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sim/volume/tissue/find_tissue.h"
#include "sim/volume/tissue/tissue_told.h"

namespace seldinger::volume {
namespace {

// A trunk without an enhanced organ, and what somebody drank.
Volume trunk_with_a_drink() {
  Volume made = make_volume({80, 60, 40}, {4, 4, 5}, glm::dmat3(1.0), glm::dvec3(0.0));
  for (int k = 0; k < 40; ++k)
    for (int j = 0; j < 60; ++j)
      for (int i = 0; i < 80; ++i) {
        const double x = (i - 39.5) / 36.0, y = (j - 29.5) / 26.0;
        const bool drunk = std::abs(i - 40) < 8 && std::abs(j - 20) < 6 && std::abs(k - 20) < 8;
        made.hu[made.index(i, j, k)] = x * x + y * y >= 1.0 ? -1000 : drunk ? 350 : 50;
      }
  return made;
}

TEST(Contrast, InTheBowelAloneIsDoubted) {
  const Volume made = trunk_with_a_drink();
  const Contrast told = contrast_of(made, tissue_classes(made));
  EXPECT_EQ(told.phase, ContrastPhase::early);
  EXPECT_NEAR(told.brightest_hu.value_or(0), 350, 2);
  EXPECT_TRUE(told.may_be_swallowed);
}

TEST(Contrast, ThePhaseIsThatOfTheAortaWhereItIsKnown) {
  const Volume made = trunk_with_a_drink();
  const auto classes = tissue_classes(made);
  EXPECT_EQ(contrast_of(made, classes, 160).phase, ContrastPhase::venous);
  EXPECT_EQ(contrast_of(made, classes, 300).phase, ContrastPhase::early);
  EXPECT_EQ(contrast_of(made, classes, 95).phase, ContrastPhase::late);
  EXPECT_EQ(contrast_of(made, classes, 45).phase, ContrastPhase::early) << "not enhanced: no evidence";
  EXPECT_FALSE(contrast_of(made, classes, 160).may_be_swallowed);
  const auto doubts = tell_tissue(made, classes, false, 160).doubts;
  EXPECT_EQ(doubts.front(), "what is brighter than the aorta's blood may be contrast in the bowel or in urine");
}

TEST(TissueTold, SharesAreOfTheBodyAndDoubtsAreSaid) {
  Volume made = trunk_with_a_drink();
  for (int i = 20; i < 23; ++i)
    for (int j = 28; j < 31; ++j) made.hu[made.index(i, j, 20)] = 3071;
  const auto classes = tissue_classes(made);
  const TissueTold told = tell_tissue(made, classes, false);
  EXPECT_NEAR(std::accumulate(told.share.begin(), told.share.end(), 0.0), 1.0, 1e-9);
  EXPECT_EQ(told.share[static_cast<std::size_t>(TissueClass::air)], 0.0);
  const auto body = classes.size() - count_classes(classes)[static_cast<std::size_t>(TissueClass::air)];
  EXPECT_NEAR(told.share[static_cast<std::size_t>(TissueClass::metal)], 9.0 / static_cast<double>(body), 1e-9);
  ASSERT_EQ(told.doubts.size(), 4U);
  EXPECT_EQ(told.doubts.front(), "what is bright may be contrast in the bowel: no organ is enhanced");
  EXPECT_EQ(told.doubts.back(), "voxels are 5 mm long: thin bones and vessels fill parts of them");
}

TEST(Contrast, OfAVolumeWithoutABodyIsNone) {
  Volume air = make_volume({8, 8, 1}, {1, 1, 1}, glm::dmat3(1.0), glm::dvec3(0.0));
  std::fill(air.hu.begin(), air.hu.end(), std::int16_t{-1000});
  const Contrast told = contrast_of(air, tissue_classes(air));
  EXPECT_EQ(told.phase, ContrastPhase::none);
  EXPECT_FALSE(told.brightest_hu);
}

}  // namespace
}  // namespace seldinger::volume
