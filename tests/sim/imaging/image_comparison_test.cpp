// A picture that differs is told, with its worst pixel, and leaves pictures behind.
#include "tests/sim/imaging/image_comparison.h"

#include <cmath>
#include <filesystem>
#include <limits>

#include "tests/fixtures/places.h"

namespace seldinger::imaging {
namespace {

TEST(ImageComparison, NamesTheWorstPixelAndLeavesThreePictures) {
  const HuImage reference(12, 10.0F);
  HuImage result = reference;
  result[2] = 11.0F;
  result[7] = 15.0F;  // column 3, row 1 of width 4
  const auto folder = fixtures::test_out_dir() / "imaging" / "comparison_of_itself";
  std::filesystem::remove_all(folder);
  const testing::AssertionResult answer = images_agree(result, reference, 4, 0.5, {}, "comparison_of_itself");
  EXPECT_FALSE(answer);
  EXPECT_NE(std::string(answer.message()).find("2 of 12 pixels"), std::string::npos) << answer.message();
  EXPECT_NE(std::string(answer.message()).find("worst (3, 1): 15 instead of 10"), std::string::npos);
  for (const char* name : {"result.pgm", "reference.pgm", "difference.pgm"}) {
    ASSERT_TRUE(std::filesystem::exists(folder / name)) << name;
    EXPECT_EQ(std::filesystem::file_size(folder / name), std::string("P5\n4 3\n255\n").size() + 12);
  }
}

TEST(ImageComparison, FailsOnNan) {
  const HuImage reference(4, 0.0F);
  HuImage result = reference;
  result[1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(images_agree(result, reference, 2, 1e9, {}, "comparison_with_nan"));
  EXPECT_FALSE(images_agree(reference, result, 2, 1e9, {}, "comparison_with_nan"));
}

TEST(ImageComparison, LeavesOutWhatTheMaskSays) {
  const HuImage reference(4, 0.0F);
  HuImage result = reference;
  result[1] = 100.0F;
  EXPECT_TRUE(images_agree(result, reference, 2, 0.5, {false, true, false, false}, "comparison_masked"));
  EXPECT_FALSE(images_agree(result, reference, 2, 0.5, {true, false, true, true}, "comparison_masked"));
}

TEST(ImageComparison, RefusesOtherSizes) {
  EXPECT_FALSE(images_agree(HuImage(4), HuImage(5), 2, 1e9, {}, "comparison_sizes"));
}

}  // namespace
}  // namespace seldinger::imaging
