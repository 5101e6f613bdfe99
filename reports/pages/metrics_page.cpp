#include "reports/pages/metrics_page.h"

#include "assessment/registry.h"
#include "reports/pages/sections/metric_details.h"
#include "reports/words/metric_card.h"
#include "reports/words/metric_words.h"

namespace seldinger::reports {

std::string metrics_page(const Visitor& visitor) {
  Html html;
  html.raw(
      "<h1>Metrics</h1>\n<p class=\"sub\">What is measured in an attempt, and how. A value without a number says "
      "why; it is never shown as 0. A stored value keeps the definition it was measured by.</p>\n");
  html.raw("<nav class=\"jumps\" aria-label=\"Groups of metrics\">");
  Html sections;
  for (const std::string& group : metric_groups()) {
    Html cards;
    for (const assessment::MetricInfo& info : assessment::registry()) {
      if (metric_group(info.id) != group) continue;
      cards.raw("<article class=\"card\" id=\"metric-").text(info.id).raw("\">\n<h3>").text(info.label);
      cards.raw(" <span class=\"id\">").text(info.id).raw("</span></h3>\n");
      cards.add(card_body(metric_card(info.id))).raw("</article>\n");
    }
    if (cards.empty()) continue;
    html.raw("<a href=\"#group-").text(group).raw("\">").text(group).raw("</a> ");
    sections.raw("<section class=\"cards\" aria-labelledby=\"group-").text(group).raw("\">\n<h2 id=\"group-");
    sections.text(group).raw("\">").text(group).raw("</h2>\n").add(cards).raw("</section>\n");
  }
  html.raw("</nav>\n").add(sections);
  return page("Metrics", visitor, html);
}

}  // namespace seldinger::reports
