// Where a shader's compiler puts the fields of its blocks.
#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "sim/base/embedded.h"

namespace seldinger::imaging {

// Offsets of the fields of `… { … block; }` (or `block[]`) that the shader reads, as `glslangValidator -q` tells
// them; empty when it refuses the shader.
std::map<std::string, std::size_t> offsets_from_compiler(const base::EmbeddedFile& shader,
                                                         const std::string& block = "parameters");

}  // namespace seldinger::imaging
