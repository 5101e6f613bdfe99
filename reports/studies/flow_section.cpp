#include "reports/studies/numbers/baseline.h"
#include "reports/studies/study_words.h"
#include "reports/studies/validity_sections.h"
#include "reports/words/people_words.h"

namespace seldinger::reports {
namespace {

void add_box(Html& html, std::string_view words, std::size_t count) {
  html.raw("<div class=\"box\"><strong>").text(std::to_string(count)).raw("</strong> ").text(words).raw("</div>\n");
}

Html baseline_table(const ValidityReport& report) {
  Html html;
  const std::vector<BaselineRow> rows = baseline_of(report.plan.plan, report.backgrounds);
  if (rows.empty()) return html.raw("<p>Nobody stated their experience before enrolment.</p>\n");
  html.raw(
      "<table><caption>What people stated about themselves before enrolment: median (quartiles); withheld for "
      "fewer than 5</caption>\n<thead><tr><th scope=\"col\">Stated</th>");
  for (const auto& group : report.plan.plan.groups) html.raw("<th scope=\"col\">").text(group.name).raw("</th>");
  html.raw("</tr></thead><tbody>\n");
  for (const BaselineRow& row : rows) {
    html.raw("<tr><th scope=\"row\">").text(row.fact->words).raw("</th>");
    for (const BaselineCell& cell : row.groups) {
      html.raw("<td>");
      if (cell.median)
        html.text(digits_text(*cell.median) + " (" + digits_text(*cell.low_quartile) + " to " +
                  digits_text(*cell.high_quartile) + "), n = " + std::to_string(cell.stated.size()));
      else
        html.text(cell.stated.empty() ? "–" : "withheld");
      html.raw("</td>");
    }
    html.raw("</tr>\n");
  }
  return html.raw("</tbody></table>\n");
}

}  // namespace

Html flow_section(const ValidityReport& report) {
  Html html;
  html.raw("<section id=\"flow\">\n<h2>4 How far people came</h2>\n");
  if (!report.plan.frozen()) return html.raw("<p>Nobody is enrolled until the plan is frozen.</p>\n</section>\n");
  const casedb::ParticipantFlow& flow = report.flow;
  html.raw("<div class=\"flow\">\n");
  add_box(html, study_people_words(flow.people), static_cast<std::size_t>(flow.people.count));
  add_box(html, "enrolled", flow.ever_enrolled);
  html.raw("<div class=\"groups\">\n");
  for (const casedb::GroupFlow& group : flow.groups) {
    html.raw("<div class=\"group\"><h3>").text(group.name).raw("</h3>\n");
    add_box(html, report.plan.plan.randomised ? "allocated" : "in the group by their facts", group.allocated);
    if (!flow.people.simulated) add_box(html, "withdrew consent since", group.withdrew);
    add_box(html, "made an attempt at the plan’s cases", group.attempted);
    add_box(html, "analysed at the first primary outcome", group.analysed);
    html.raw("</div>\n");
  }
  html.raw("</div>\n</div>\n");
  if (flow.unknown > 0)
    html.raw("<p>")
        .text(std::to_string(flow.unknown))
        .raw(" who were enrolled have been erased since; nothing is known about them any more.</p>\n");
  html.add(baseline_table(report));
  bool any = false;
  for (const auto* outcomes : {&report.result.primary, &report.result.secondary})
    for (const assessment::study::Compared& one : *outcomes)
      for (const assessment::study::LeftOut& why : one.left_out) {
        if (!any)
          html.raw(
              "<table><caption>Attempts at any of the plan’s cases that are not part of an outcome, and why; the "
              "person stays in the analysis with their other attempts</caption>\n<thead><tr><th "
              "scope=\"col\">Outcome</th><th scope=\"col\">Why</th><th scope=\"col\" "
              "class=\"number\">Attempts</th></tr></thead><tbody>\n");
        any = true;
        html.raw("<tr><th scope=\"row\">").text(one.outcome.name + (one.hand.empty() ? "" : ", hand: " + one.hand));
        html.raw("</th><td>").text(why.why).raw("</td><td class=\"number\">").text(std::to_string(why.attempts));
        html.raw("</td></tr>\n");
      }
  if (any) html.raw("</tbody></table>\n");
  return html.raw("</section>\n");
}

}  // namespace seldinger::reports
