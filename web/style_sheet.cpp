#include "web/style_sheet.h"

#include <span>

#include "sim/base/check.h"
#include "sim/base/embedded.h"

namespace seldinger::embedded {
std::span<const base::EmbeddedFile> frontend();
}

namespace seldinger::web {

std::string_view style_sheet() {
  for (const base::EmbeddedFile& file : embedded::frontend())
    if (file.name == "style.css") return file.content;
  CHECK(false);
}

}  // namespace seldinger::web
