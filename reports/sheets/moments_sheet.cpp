#include "reports/sheets/moments_sheet.h"

#include "reports/sheets/sheet_parts.h"

namespace seldinger::reports {

DrawnPictures moments_sheet(const ReplaySheet& sheet) {
  DrawnPictures drawn;
  const Placed beside = [&](const std::vector<std::byte>& png) {
    drawn.pngs.push_back(png);
    return "pictures.png?n=" + std::to_string(drawn.pngs.size());
  };
  Html html;
  html.raw("<div class=\"replay\">\n");
  if (!sheet.note.empty()) html.raw("<p class=\"note\">").text(sheet.note).raw("</p>\n");
  html.add(sheet_strip(sheet, beside)).add(sheet_planes(sheet, beside)).raw("</div>\n");
  drawn.markup = html.str();
  return drawn;
}

}  // namespace seldinger::reports
