#include "reports/pages/style_sheet.h"

#include <span>

#include "sim/base/check.h"
#include "sim/base/embedded.h"

namespace seldinger::embedded {
std::span<const base::EmbeddedFile> page_files();
}

namespace seldinger::reports {

std::string_view style_sheet() {
  for (const base::EmbeddedFile& file : embedded::page_files())
    if (file.name == "style.css") return file.content;
  CHECK(false);
}

}  // namespace seldinger::reports
