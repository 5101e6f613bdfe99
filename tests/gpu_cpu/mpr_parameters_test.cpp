// The block that MPR's shader reads has the offsets that C++ writes: the GLSL compiler's answer against offsetof.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <span>
#include <string>

#include "shaders/shared/mpr.glsl.h"
#include "sim/base/embedded.h"

namespace seldinger::embedded {
std::span<const base::EmbeddedFile> mpr_shaders();
}

namespace seldinger::imaging {
namespace {

// Offsets in the block Parameters as `glslangValidator -q` tells them.
std::map<std::string, std::size_t> offsets_from_compiler(const std::string& shader_text) {
  const std::filesystem::path folder = std::filesystem::path(SELDINGER_TEST_OUT_DIR) / "mpr_parameters";
  std::filesystem::create_directories(folder);
  const std::filesystem::path file = folder / "mpr_slice.comp";
  std::ofstream(file) << shader_text;
  const std::string command = std::string(SELDINGER_GLSLANG) + " -l -q '" + file.string() + "'";
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return {};
  std::map<std::string, std::size_t> offsets;
  std::array<char, 4096> line{};
  while (std::fgets(line.data(), static_cast<int>(line.size()), pipe) != nullptr) {
    std::array<char, 64> field{};
    std::size_t offset = 0;
    if (std::sscanf(line.data(), "parameters.%63[a-z_]: offset %zu", field.data(), &offset) == 2)
      offsets[field.data()] = offset;
  }
  if (pclose(pipe) != 0) return {};
  return offsets;
}

TEST(MprParameters, HaveTheOffsetsOfTheShadersBlock) {
  const auto files = embedded::mpr_shaders();
  ASSERT_EQ(files.size(), 1U);
  const std::map<std::string, std::size_t> offsets = offsets_from_compiler(std::string(files[0].content));
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

}  // namespace
}  // namespace seldinger::imaging
