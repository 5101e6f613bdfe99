#include "reports/pages/style_sheet.h"

#include <span>

#include "sim/base/check.h"
#include "sim/base/embedded.h"

namespace seldinger::embedded {
std::span<const base::EmbeddedFile> page_files();
}

namespace seldinger::reports {

namespace {

std::string_view page_file(std::string_view name) {
  for (const base::EmbeddedFile& file : embedded::page_files())
    if (file.name == name) return file.content;
  CHECK(false);
}

}  // namespace

std::string_view style_sheet() {
  return page_file("style.css");
}

std::string_view keep_typed_script() {
  return page_file("keep_typed.js");
}

std::string_view replay_script() {
  return page_file("replay.js");
}

std::string_view film_script() {
  return page_file("film.js");
}

std::string_view tables_script() {
  return page_file("tables.js");
}

std::string_view jobs_script() {
  return page_file("jobs.js");
}

std::string_view icon() {
  return page_file("icon.svg");
}

}  // namespace seldinger::reports
