// A file built into the program (cmake/embed.cmake): migrations, SQL, shaders, web pages.
#pragma once

#include <algorithm>
#include <span>
#include <string_view>

#include "sim/base/check.h"

namespace seldinger::base {

struct EmbeddedFile {
  std::string_view name;  // file name without folder
  std::string_view content;
};

// What the file of that name holds. It is among them: they are built in.
inline std::string_view content_of(std::span<const EmbeddedFile> files, std::string_view name) {
  const auto found = std::find_if(files.begin(), files.end(), [&](const auto& file) { return file.name == name; });
  CHECK(found != files.end());
  return found->content;
}

}  // namespace seldinger::base
