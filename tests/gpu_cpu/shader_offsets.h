// Where a shader's compiler puts the fields of its uniform block.
#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "sim/base/embedded.h"

namespace seldinger::imaging {

// Offsets of the fields of `uniform Parameters { … parameters; }` that the shader reads, as `glslangValidator -q`
// tells them; empty when it refuses the shader.
std::map<std::string, std::size_t> offsets_from_compiler(const base::EmbeddedFile& shader);

}  // namespace seldinger::imaging
