// The block that MPR's shader reads has the offsets that C++ writes: the GLSL compiler's answer against offsetof.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <span>
#include <string>

#include "shaders/shared/mpr.glsl.h"
#include "sim/base/embedded.h"
#include "tests/gpu_cpu/shader_offsets.h"

namespace seldinger::embedded {
std::span<const base::EmbeddedFile> mpr_shaders();
}

namespace seldinger::imaging {
namespace {

const base::EmbeddedFile& shader(std::string_view name) {
  const auto files = embedded::mpr_shaders();
  return *std::find_if(files.begin(), files.end(), [&](const auto& file) { return file.name == name; });
}

TEST(MprParameters, HaveTheOffsetsOfTheShadersBlock) {
  ASSERT_EQ(embedded::mpr_shaders().size(), 3U);
  const std::map<std::string, std::size_t> offsets = offsets_from_compiler(shader("mpr_slice.comp"));
  using P = shaders::MprParameters;
  const std::map<std::string, std::size_t> ours{
      {"index_first", offsetof(P, index_first)},
      {"index_per_column", offsetof(P, index_per_column)},
      {"index_per_row", offsetof(P, index_per_row)},
      {"position_first_mm", offsetof(P, position_first_mm)},
      {"position_per_column_mm", offsetof(P, position_per_column_mm)},
      {"position_per_row_mm", offsetof(P, position_per_row_mm)},
      {"needle_tip_mm", offsetof(P, needle_tip_mm)},
      {"needle_direction", offsetof(P, needle_direction)},
      {"needle_normal_across", offsetof(P, needle_normal_across)},
      {"needle_inner_radius_mm", offsetof(P, needle_inner_radius_mm)},
      {"needle_slab_half_mm", offsetof(P, needle_slab_half_mm)},
      {"needle_hu", offsetof(P, needle_hu)},
      {"needle_present", offsetof(P, needle_present)},
      {"lesion_count", offsetof(P, lesion_count)},
      {"width_px", offsetof(P, width_px)},
      {"height_px", offsetof(P, height_px)},
      {"size_x", offsetof(P, size_x)},
      {"size_y", offsetof(P, size_y)},
      {"size_z", offsetof(P, size_z)},
      {"nearest", offsetof(P, nearest)},
      {"lesion_sphere_mm", offsetof(P, lesion_sphere_mm)},
      {"lesion_hu", offsetof(P, lesion_hu)},
  };
  EXPECT_EQ(offsets, ours);  // and the shader reads no field that is not named here
}

TEST(MprParameters, OfAPatientWhoMovesHaveThemToo) {
  ASSERT_EQ(embedded::mpr_shaders().size(), 3U);
  using D = shaders::MprDisplaced;
  using P = shaders::MprParameters;
  const std::map<std::string, std::size_t> by_pixel{{"voxel_from_center", offsetof(D, voxel_from_center)},
                                                    {"center_lps_mm", offsetof(D, center_lps_mm)},
                                                    {"fixed_point_steps", offsetof(D, fixed_point_steps)},
                                                    {"newton_steps", offsetof(D, newton_steps)}};
  EXPECT_EQ(offsets_from_compiler(shader("mpr_displaced.comp"), "displaced"), by_pixel);
  const std::map<std::string, std::size_t> by_grid{{"voxel_from_center", offsetof(D, voxel_from_center)},
                                                   {"columns", offsetof(D, columns)},
                                                   {"rows", offsetof(D, rows)},
                                                   {"nodes_per_pixel", offsetof(D, nodes_per_pixel)}};
  EXPECT_EQ(offsets_from_compiler(shader("mpr_displaced_grid.comp"), "displaced"), by_grid);
  for (const char* file : {"mpr_displaced.comp", "mpr_displaced_grid.comp"}) {
    const auto parameters = offsets_from_compiler(shader(file));
    ASSERT_EQ(parameters.count("lesion_hu"), 1U);
    EXPECT_EQ(parameters.at("lesion_hu"), offsetof(P, lesion_hu));
  }
}

}  // namespace
}  // namespace seldinger::imaging
