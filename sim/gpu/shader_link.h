// A GL program from the texts of its stages. Only sim/gpu/*.cpp include this.
#pragma once

#include <span>
#include <string_view>

namespace seldinger::gpu {

struct ShaderStage {
  unsigned int kind = 0;  // GL_COMPUTE_SHADER, …
  const char* name = "";  // as a failure tells it: "compute"
  std::string_view text;
};

// The GL name of the linked program, whose owner deletes it; a context is current. Throws base::Failure("gl", the
// compiler's or linker's log).
unsigned int link_shaders(std::span<const ShaderStage> stages);

}  // namespace seldinger::gpu
