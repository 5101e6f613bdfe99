#include "reports/pages/sections/metric_details.h"

#include "assessment/registry.h"
#include "reports/words/metric_card.h"
#include "reports/words/metric_words.h"

namespace seldinger::reports {

Html card_body(const Card& card) {
  Html html;
  html.raw("<p>").text(card.definition).raw("</p>\n<dl>\n");
  for (const CardLine& line : card.lines)
    html.raw("<div><dt>").text(line.name).raw("</dt><dd>").text(line.text).raw("</dd></div>\n");
  html.raw("</dl>\n");
  return html;
}

Html card_details(const Card& card, std::string_view words) {
  Html html;
  html.raw("<details class=\"metric\"><summary>").text(words).raw("</summary>\n<div class=\"card\">\n");
  return html.add(card_body(card)).raw("</div></details>");
}

Html metric_details(std::string_view id, int version, std::string_view words) {
  Html html;
  const std::string label = words.empty() ? metric_label(id) : std::string(words);
  if (assessment::find_metric(std::string(id)) == nullptr) return html.text(label);
  return card_details(metric_card(id, version), label);
}

}  // namespace seldinger::reports
