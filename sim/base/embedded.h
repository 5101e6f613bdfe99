// A file built into the program (cmake/embed.cmake): migrations, SQL, shaders, web pages.
#pragma once

#include <cstddef>
#include <string_view>

namespace seldinger::base {

struct EmbeddedFile {
  std::string_view name;  // file name without folder
  std::string_view content;
};

}  // namespace seldinger::base
