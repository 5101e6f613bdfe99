// The block that the X-ray shaders read has the offsets that C++ writes, and the formulas they share hold in
// double.
#include <gtest/gtest.h>

#include <cstddef>
#include <map>
#include <span>
#include <string>

#include "shaders/shared/xray_layer.glsl.h"
#include "sim/base/embedded.h"
#include "sim/base/rng.h"
#include "tests/gpu_cpu/shader_offsets.h"

namespace seldinger::embedded {
std::span<const base::EmbeddedFile> xray_shaders();
}

namespace seldinger::imaging {
namespace {

TEST(XrayParameters, HaveTheOffsetsOfTheShadersBlock) {
  using P = shaders::XrayParameters;
  const std::map<std::string, std::size_t> ours{
      {"pixel_first", offsetof(P, pixel_first)},
      {"pixel_first_rest", offsetof(P, pixel_first_rest)},
      {"pixel_per_column", offsetof(P, pixel_per_column)},
      {"per_column_rest", offsetof(P, per_column_rest)},
      {"pixel_per_row", offsetof(P, pixel_per_row)},
      {"per_row_rest", offsetof(P, per_row_rest)},
      {"source", offsetof(P, source)},
      {"source_rest", offsetof(P, source_rest)},
      {"clip_low", offsetof(P, clip_low)},
      {"clip_high", offsetof(P, clip_high)},
      {"metric", offsetof(P, metric)},
      {"metric_mixed", offsetof(P, metric_mixed)},
      {"width_px", offsetof(P, width_px)},
      {"height_px", offsetof(P, height_px)},
      {"column_first", offsetof(P, column_first)},
      {"row_first", offsetof(P, row_first)},
      {"size_y", offsetof(P, size_y)},
      {"size_z", offsetof(P, size_z)},
      {"parallel", offsetof(P, parallel)},
      {"wins_ties_y", offsetof(P, wins_ties_y)},
      {"wins_ties_z", offsetof(P, wins_ties_z)},
      {"only_x", offsetof(P, only_x)},
  };
  ASSERT_EQ(embedded::xray_shaders().size(), 4U);
  for (const base::EmbeddedFile& shader : embedded::xray_shaders())
    EXPECT_EQ(offsets_from_compiler(shader), ours) << shader.name;  // and no field is read that is not named here
}

// Against the piece walked in small steps.
TEST(XrayLayer, ExactSharesAreTheLengthsInEachVoxel) {
  base::Rng rng(71);
  constexpr int kSteps = 20000;
  for (int trial = 0; trial < 200; ++trial) {
    const double y = rng.uniform(), z = rng.uniform(), slope_y = 2.0 * rng.uniform() - 1.0,
                 slope_z = trial % 5 == 0 ? 0.0 : 2.0 * rng.uniform() - 1.0, length = rng.uniform();
    const auto far = [](double slope) {
      return slope == 0.0 ? shaders::kXrayFar : std::min(1.0 / std::abs(slope), shaders::kXrayFar);
    };
    const double low_y = std::floor(std::min(y, y + length * slope_y));
    const double low_z = std::floor(std::min(z, z + length * slope_z));
    const glm::dvec4 shares = shaders::xray_exact_shares(
        length, low_y + 1.0 - std::min(y, y + length * slope_y), low_z + 1.0 - std::min(z, z + length * slope_z),
        far(slope_y), far(slope_z), (slope_y >= 0.0) == (slope_z >= 0.0));
    glm::dvec4 walked(0.0);
    for (int i = 0; i < kSteps; ++i) {
      const double at = length * (i + 0.5) / kSteps;
      const int high_y = y + at * slope_y >= low_y + 1.0 ? 1 : 0, high_z = z + at * slope_z >= low_z + 1.0 ? 1 : 0;
      walked[high_y + 2 * high_z] += length / kSteps;
    }
    for (int i = 0; i < 4; ++i) {
      EXPECT_NEAR(shares[i], walked[i], 3.0 * length / kSteps) << trial << ' ' << i;
      EXPECT_GE(shares[i], 0.0);
    }
    EXPECT_NEAR(shares.x + shares.y + shares.z + shares.w, length, 1e-15);
  }
}

TEST(XrayLayer, SlabSharesAreBilinear) {
  base::Rng rng(72);
  for (int trial = 0; trial < 100; ++trial) {
    const double y = rng.uniform(), z = rng.uniform(), length = rng.uniform();
    const glm::dvec4 shares = shaders::xray_slab_shares(length, y, z);
    EXPECT_NEAR(shares.x, length * (1.0 - y) * (1.0 - z), 1e-15);
    EXPECT_NEAR(shares.y, length * y * (1.0 - z), 1e-15);
    EXPECT_NEAR(shares.z, length * (1.0 - y) * z, 1e-15);
    EXPECT_NEAR(shares.w, length * y * z, 1e-15);
  }
}

}  // namespace
}  // namespace seldinger::imaging
