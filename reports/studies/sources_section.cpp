#include <set>

#include "assessment/registry.h"
#include "reports/studies/outcome_table.h"
#include "reports/studies/validity_sections.h"
#include "reports/words/metric_words.h"

namespace seldinger::reports {
namespace {

namespace study = assessment::study;

Html content_panel(const study::Plan& plan) {
  Html html = evidence_panel("Content", "What is measured, and by which definition");
  html.raw(
      "<table><thead><tr><th scope=\"col\">Metric</th><th scope=\"col\">Definition</th><th "
      "scope=\"col\">Source</th>"
      "</tr></thead><tbody>\n");
  std::set<std::string> told;
  for (const auto* outcomes : {&plan.primary, &plan.secondary})
    for (const study::Outcome& one : *outcomes) {
      const assessment::MetricInfo* info = assessment::find_metric(one.metric);
      if (info == nullptr || !told.insert(one.metric).second) continue;
      html.raw("<tr><th scope=\"row\">").text(info->label).raw("<span class=\"why\"><code>").text(one.metric);
      html.raw("</code>, version ").text(std::to_string(one.version)).raw(", a person’s attempts: ");
      html.text(assessment::words(info->estimand.aggregation)).raw(", without an endpoint: ");
      html.text(assessment::words(info->estimand.without_endpoint)).raw("</span></th><td>").text(info->definition);
      html.raw("</td><td>").text(info->source).raw("</td></tr>\n");
    }
  return html.raw("</tbody></table>\n</article>\n");
}

Html response_panel(const ValidityReport& report) {
  Html html = evidence_panel("Response process", "Whether what was recorded is what was done");
  html.raw("<ul>");
  for (const study::Compared& one : report.result.primary) {
    std::size_t left_out = 0;
    for (const study::LeftOut& why : one.left_out)
      if (why.why.find("case") == std::string::npos && why.why.find("visit") == std::string::npos)
        left_out += why.attempts;
    const std::size_t counted = one.first.attempts + one.second.attempts;
    html.raw("<li>").text(one.outcome.name + (one.hand.empty() ? "" : ", hand: " + one.hand)).raw(": ");
    html.text(std::to_string(counted)).raw(" attempts count, ").text(std::to_string(left_out));
    html.raw(" of the same case and days do not (section 4 says why). Needle led by: ");
    std::string hands;
    for (const std::string& hand : one.hands) hands += (hands.empty() ? "" : ", ") + hand;
    html.text(hands.empty() ? "nobody yet" : hands).raw(".</li>\n");
  }
  return html.raw("</ul>\n</article>\n");
}

}  // namespace

Html evidence_panel(std::string_view source, std::string_view title) {
  Html html;
  return html.raw("<article class=\"panel\">\n<p class=\"tag\">")
      .text(source)
      .raw("</p>\n<h3>")
      .text(title)
      .raw("</h3>\n");
}

Html no_evidence_yet(std::string_view source, std::string_view title, std::string_view what) {
  Html html = evidence_panel(source, title);
  return html.raw("<p><strong>None yet.</strong> ").text(what).raw("</p>\n</article>\n");
}

Html sources_section(const ValidityReport& report) {
  Html html;
  html.raw(
      "<section id=\"sources\">\n<h2>3 Evidence by source of validity</h2>\n<p class=\"note\">All of this is "
      "exploratory: it has no p-values and supports no conclusions.</p>\n");
  html.add(content_panel(report.plan.plan));
  if (!report.plan.frozen()) return html.raw("</section>\n");
  html.add(response_panel(report));
  html.add(structure_panels(report));
  html.add(internal_structure_panel(report));
  if (report.result.secondary.empty()) {
    html.add(no_evidence_yet("Relations to other variables", "Secondary outcomes", "The plan names none."));
  } else {
    html.add(evidence_panel("Relations to other variables", "Secondary outcomes"));
    html.add(outcome_table(report.result.secondary, report.plan.plan.alpha, false,
                           "Effects with intervals; no p, no verdict"))
        .raw("</article>\n");
  }
  html.add(published_panel(report));
  html.add(relations_panel(report));
  html.add(consequences_panel(report));
  html.add(subgroups_panel(report));
  return html.raw("</section>\n");
}

}  // namespace seldinger::reports
