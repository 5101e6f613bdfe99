#include "sim/volume/label_numbering.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace seldinger::volume {
namespace {

// Numbers as TotalSegmentator 2's class_map["total"] has them.
TEST(LabelNumbering, TotalSegmentatorsNumbersAreItsOwn) {
  const std::pair<int, const char*> known[] = {
      {1, "spleen"},        {5, "liver"},         {21, "urinary_bladder"}, {31, "vertebrae_L1"},
      {43, "vertebrae_T1"}, {50, "vertebrae_C1"}, {52, "aorta"},           {63, "inferior_vena_cava"},
      {79, "spinal_cord"},  {92, "rib_left_1"},   {115, "rib_right_12"},   {117, "costal_cartilages"}};
  for (const auto& [number, name] : known) {
    const auto label = total_segmentator_label(number);
    ASSERT_TRUE(label.has_value()) << number;
    EXPECT_STREQ(label->name, name);
  }
  EXPECT_FALSE(total_segmentator_label(0).has_value());
  EXPECT_FALSE(total_segmentator_label(118).has_value());
  EXPECT_FALSE(total_segmentator_label(-3).has_value());
}

TEST(LabelNumbering, EveryNameIsOneLabelsAndHasATissueByName) {
  std::set<std::string> names;
  for (int number = 1; number <= 117; ++number) {
    const NumberedLabel label = total_segmentator_label(number).value();
    EXPECT_TRUE(names.insert(label.name).second) << label.name;
    EXPECT_EQ(tissue_of_name(label.name), label.tissue) << label.name;
  }
  EXPECT_EQ(tissue_of_name("vertebrae_L3"), TissueClass::bone);
  EXPECT_EQ(tissue_of_name("kidney_left"), TissueClass::kidney);
  EXPECT_EQ(tissue_of_name("kidney_cyst_left"), TissueClass::fluid);
  EXPECT_EQ(tissue_of_name("iliac_vena_right"), TissueClass::vessel);
}

}  // namespace
}  // namespace seldinger::volume
