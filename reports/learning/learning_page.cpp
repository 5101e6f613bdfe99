#include "reports/learning/learning_page.h"

#include <span>

#include "reports/pages/page.h"
#include "reports/pages/style_sheet.h"
#include "reports/studies/study_style.h"
#include "reports/words/metric_words.h"
#include "sim/base/embedded.h"

namespace seldinger::embedded {
std::span<const base::EmbeddedFile> learning_files();
}

namespace seldinger::reports {

Html made_by(std::int64_t made_us, const std::string& program_version, bool simulated) {
  Html html;
  html.raw("<p class=\"sub\">Made ").text(utc_text(made_us)).raw(" by version ").text(program_version);
  html.raw(".</p>\n");
  if (simulated)
    html.raw(
        "<p class=\"simulated\"><strong>SIMULATED.</strong> Every attempt in this report was made by a simulated "
        "person. Nothing in it is about people.</p>\n");
  return html;
}

std::string learning_page(std::string_view title, const Html& content) {
  return page_with_style(
      title, report_style() + std::string(base::content_of(embedded::learning_files(), "learning.css")), content);
}

}  // namespace seldinger::reports
