// The sheet of a CT's slices: what is tinted, where, and that it says so.
#include "app/cases/tissue_sheet.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace seldinger::app {
namespace {

TEST(TissueSheet, TintsWhatVoxelsAre) {
  volume::Volume made = volume::make_volume({80, 80, 30}, {3, 3, 3}, glm::dmat3(1.0), glm::dvec3(0.0));
  std::vector<volume::TissueClass> classes(made.hu.size(), volume::TissueClass::air);
  for (int k = 0; k < 30; ++k)
    for (int j = 0; j < 80; ++j)
      for (int i = 0; i < 80; ++i)
        if (std::hypot(i - 39.5, j - 39.5) < 30.0) {
          made.hu[made.index(i, j, k)] = 40;
          classes[made.index(i, j, k)] = i < 40 ? volume::TissueClass::bone : volume::TissueClass::soft_tissue;
        }
  volume::Organs organs;
  organs.grid = made;
  organs.at.assign(made.hu.size(), volume::FoundOrgan::none);
  for (int k = 0; k < 30; ++k) organs.at[made.index(60, 40, k)] = volume::FoundOrgan::spleen;
  organs.found.push_back({volume::FoundOrgan::spleen, 0.9, 1.0, 40});
  const Canvas sheet = tissue_sheet(made, classes, organs);
  EXPECT_EQ(sheet.width_px(), 5 * 170);  // five slices of 160 and their gaps are less
  EXPECT_GT(sheet.height_px(), 4 * 160);
  const auto at = [&](int x, int y) {
    const std::size_t from = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(sheet.width_px()) +
                                  static_cast<std::size_t>(x));
    return std::array<int, 3>{sheet.rgb()[from], sheet.rgb()[from + 1], sheet.rgb()[from + 2]};
  };
  const int grey = static_cast<int>(std::lround(255.0 * 0.5));  // of 40 HU
  const auto half = [&](Colour tint) {
    return std::array<int, 3>{(grey + tint.red) / 2, (grey + tint.green) / 2, (grey + tint.blue) / 2};
  };
  EXPECT_EQ(at(40, 80), half(colour_of(volume::TissueClass::bone)));
  EXPECT_EQ(at(90, 80), (std::array<int, 3>{grey, grey, grey}));
  EXPECT_EQ(at(121, 81), half(colour_of(volume::FoundOrgan::spleen)));
  EXPECT_EQ(at(2, 2), (std::array<int, 3>{0, 0, 0}));
  // The legend names the class and the organ that are there: two patches of colour below the slices.
  EXPECT_EQ(at(2, sheet.height_px() - 10), (std::array<int, 3>{255, 190, 110}));
  EXPECT_EQ(at(172, sheet.height_px() - 10), (std::array<int, 3>{170, 80, 255}));
}

}  // namespace
}  // namespace seldinger::app
