#include "tests/gpu_cpu/shader_offsets.h"

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "tests/fixtures/places.h"

namespace seldinger::imaging {

std::map<std::string, std::size_t> offsets_from_compiler(const base::EmbeddedFile& shader,
                                                         const std::string& block) {
  const std::filesystem::path folder = fixtures::test_out_dir() / "shader_offsets";
  std::filesystem::create_directories(folder);
  const std::filesystem::path file = folder / shader.name;
  std::ofstream(file) << shader.content;
  const std::string command = std::string(SELDINGER_GLSLANG) + " -l -q '" + file.string() + "'";
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return {};
  std::map<std::string, std::size_t> offsets;
  std::array<char, 4096> line{};
  while (std::fgets(line.data(), static_cast<int>(line.size()), pipe) != nullptr) {
    std::array<char, 64> field{};
    std::size_t offset = 0;
    if (std::sscanf(line.data(), (block + ".%63[a-z_]: offset %zu").c_str(), field.data(), &offset) == 2)
      offsets[field.data()] = offset;
  }
  if (pclose(pipe) != 0) return {};
  return offsets;
}

}  // namespace seldinger::imaging
