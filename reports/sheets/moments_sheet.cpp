#include "reports/sheets/moments_sheet.h"

#include "reports/sheets/sheet_parts.h"

namespace seldinger::reports {

std::string moments_sheet(const ReplaySheet& sheet) {
  Html html;
  html.raw("<div class=\"replay\">\n");
  if (!sheet.note.empty()) html.raw("<p class=\"note\">").text(sheet.note).raw("</p>\n");
  html.add(sheet_strip(sheet)).add(sheet_planes(sheet)).raw("</div>\n");
  return html.str();
}

}  // namespace seldinger::reports
