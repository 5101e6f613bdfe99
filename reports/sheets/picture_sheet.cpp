#include "reports/sheets/picture_sheet.h"

#include <algorithm>
#include <string>

#include "reports/markup/base64.h"
#include "reports/markup/html.h"
#include "reports/pages/page.h"
#include "sim/base/check.h"

namespace seldinger::reports {
namespace {

// A PNG's first chunk begins with it, its last byte last.
int width_px(const std::vector<std::byte>& png) {
  constexpr std::size_t kAt = 16;
  int width = 0;
  for (std::size_t i = kAt; i < kAt + 4 && i < png.size(); ++i) width = width << 8 | std::to_integer<int>(png[i]);
  return width;
}

}  // namespace

std::string picture_sheet(const std::string& title, const std::vector<std::string>& columns,
                          const std::vector<SheetRow>& rows) {
  Html html;
  html.raw("<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\"><title>")
      .text(title)
      .raw("</title><style>");
  html.raw(
      "body{background:#111;color:#ddd;font:14px system-ui,sans-serif;margin:16px}"
      "table{border-spacing:6px;table-layout:fixed;width:100%}tr>:first-child{width:2em}"
      "th{font-weight:600;padding:4px;overflow-wrap:anywhere;text-align:center}th[scope=row]{writing-mode:vertical-"
      "rl;transform:rotate("
      "180deg)}"
      "td{vertical-align:top;text-align:center}img{display:block;max-width:100%;background:#000}"
      "small{color:#aaa}</style></head><body><h1>");
  html.text(title).raw("</h1><p>").text(kTrainingOnly).raw("</p>");
  // In columns of one width, none wider than its pictures.
  int widest = 0;
  for (const SheetRow& row : rows)
    for (const auto& png : row.png) widest = std::max(widest, width_px(png));
  html.raw("<table style=\"max-width:")
      .text(std::to_string(40 + static_cast<int>(columns.size()) * (widest + 8)))
      .raw("px\"><tr><td></td>");
  for (const std::string& column : columns) html.raw("<th scope=\"col\">").text(column).raw("</th>");
  html.raw("</tr>");
  for (const SheetRow& row : rows) {
    CHECK(row.png.size() == columns.size() && row.captions.size() == columns.size());
    html.raw("<tr><th scope=\"row\">").text(row.name).raw("</th>");
    for (std::size_t i = 0; i < columns.size(); ++i) {
      html.raw("<td><img alt=\"").text(row.name + ", " + columns[i]).raw("\" src=\"data:image/png;base64,");
      html.text(base64(row.png[i])).raw("\"><small>").text(row.captions[i]).raw("</small></td>");
    }
    html.raw("</tr>");
  }
  html.raw("</table></body></html>\n");
  return html.str();
}

}  // namespace seldinger::reports
