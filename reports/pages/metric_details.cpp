#include "reports/pages/metric_details.h"

#include "assessment/registry.h"
#include "reports/words/metric_words.h"

namespace seldinger::reports {

Html card_body(const MetricCard& card) {
  Html html;
  html.raw("<p>").text(card.definition).raw("</p>\n<dl>\n");
  for (const CardLine& line : card.lines)
    html.raw("<div><dt>").text(line.name).raw("</dt><dd>").text(line.text).raw("</dd></div>\n");
  html.raw("</dl>\n");
  return html;
}

Html metric_details(std::string_view id, int version, std::string_view words) {
  Html html;
  const std::string label = words.empty() ? metric_label(id) : std::string(words);
  if (assessment::find_metric(std::string(id)) == nullptr) return html.text(label);
  html.raw("<details class=\"metric\"><summary>").text(label).raw("</summary>\n<div class=\"card\">\n");
  return html.add(card_body(metric_card(id, version))).raw("</div></details>");
}

}  // namespace seldinger::reports
