#include "reports/pages/attempts_page.h"

#include "reports/words/grade_words.h"
#include "reports/words/metric_words.h"

namespace seldinger::reports {
namespace {

void add_metric_cell(Html& html, const casedb::AttemptRow& row, std::string_view id) {
  const casedb::MetricValue missing{std::string(id), 1, std::nullopt, "", "not_measured"};
  const casedb::MetricValue* found = find_metric(row.metrics, id);
  const casedb::MetricValue& metric = found != nullptr ? *found : missing;
  html.raw("<td class=\"number\" data-label=\"").text(id == "hit" ? "Hit" : metric_label(id)).raw("\">");
  const std::string value = value_text(metric);
  if (value == "Yes" || value == "No") {
    if (value == "Yes") {
      html.raw("<span class=\"yes\">Yes</span>");
    } else {
      html.raw("<span class=\"no\">No</span>");
    }
  } else {
    html.text(value);
  }
  const std::string reason = reason_text(metric);
  if (!reason.empty()) html.raw(" <span class=\"why\">").text(reason).raw("</span>");
  html.raw("</td>");
}

void add_grade_cell(Html& html, const assessment::Grade& grade) {
  html.raw("<td class=\"short\" data-label=\"Result\">");
  switch (grade.verdict) {
    case assessment::Verdict::passed:
      html.raw("<span class=\"yes\">");
      break;
    case assessment::Verdict::failed:
      html.raw("<span class=\"no\">");
      break;
    case assessment::Verdict::not_gradable:
    case assessment::Verdict::no_rule:
      html.raw("<span class=\"note\">");
      break;
  }
  html.text(verdict_word(grade.verdict)).raw("</span>");
  if (grade.critical_errors() > 0) html.raw(" <span class=\"why\">critical error</span>");
  html.raw("</td>");
}

void add_row(Html& html, const AttemptView& view) {
  const casedb::AttemptRow& row = view.row;
  html.raw("<tr><th scope=\"row\"><a href=\"/attempts/")
      .text(row.attempt_id)
      .raw("\"><time datetime=\"")
      .text(told_machine_text(row.started_us))
      .raw("\">")
      .text(told_text(row.started_us))
      .raw("</time></a></th><td data-label=\"Case\">")
      .name(row.case_title)
      .raw("</td><td data-label=\"Operator\">")
      .name(view.operator_label)
      .raw("</td><td class=\"short\" data-label=\"Instrument\">")
      .text(instrument_text(row.instrument))
      .raw("</td>");
  add_grade_cell(html, view.grade.grade);
  for (const std::string_view id : {"hit", "tip_target_dist", "time_total"}) add_metric_cell(html, row, id);
  html.raw("</tr>\n");
}

void add_pages(Html& html, const ListPart& part) {
  if (part.pages <= 1) return;
  html.raw("<nav class=\"pages\" aria-label=\"Pages of the list\">");
  if (part.page > 1) {
    html.raw("<a rel=\"prev\" href=\"/attempts?page=").text(std::to_string(part.page - 1)).raw("\">Newer</a> ");
  }
  html.raw("<span>Page ")
      .text(std::to_string(part.page))
      .raw(" of ")
      .text(std::to_string(part.pages))
      .raw("</span>");
  if (part.page < part.pages) {
    html.raw(" <a rel=\"next\" href=\"/attempts?page=").text(std::to_string(part.page + 1)).raw("\">Older</a>");
  }
  html.raw("</nav>\n");
}

}  // namespace

std::string attempts_page(const Visitor& visitor, std::span<const AttemptView> attempts, const ListPart& part) {
  Html html;
  html.raw("<h1>Attempts</h1>\n");
  if (attempts.empty()) {
    html.raw("<div class=\"message\"><p>There are no attempts here yet.</p>\n<p>");
    if (part.own_only) {
      html.raw("You see your own attempts. Make one with <code>seldinger train</code>, then reload this page.");
    } else {
      html.raw(
          "Make one with <code>seldinger train</code>, or let a simulated operator make some with "
          "<code>seldinger simulate</code>, then reload this page.");
    }
    html.raw("</p></div>\n");
    return page("Attempts", visitor, html);
  }
  html.raw("<div class=\"wide\">\n<table class=\"list\">\n<caption>");
  html.text(part.own_only ? "Your attempts" : "Attempts that you may see")
      .raw(", newest first: ")
      .text(std::to_string(part.total));
  html.raw(
      ". Times are in UTC; the endpoint is the tip, with a core needle the middle of its "
      "notch.</caption>\n<thead><tr><th scope=\"col\">When</th><th scope=\"col\">Case</th>"
      "<th scope=\"col\">Operator</th><th scope=\"col\">Instrument</th><th scope=\"col\">Result</th><th "
      "scope=\"col\" class=\"number\"><a href=\"/metrics#metric-hit\">Hit</a></th>"
      "<th scope=\"col\" class=\"number\"><a href=\"/metrics#metric-tip_target_dist\">Endpoint to centre</a></th>"
      "<th scope=\"col\" class=\"number\"><a href=\"/metrics#metric-time_total\">Time</a></th></tr></thead>\n"
      "<tbody>\n");
  for (const AttemptView& view : attempts) add_row(html, view);
  html.raw("</tbody>\n</table>\n</div>\n");
  add_pages(html, part);
  return list_page("Attempts", visitor, html);
}

std::string no_attempts_page(const Visitor& visitor) {
  Html html;
  html.raw(
      "<div class=\"message\">\n<h1>No individual attempts</h1>\n<p>Your role does not see individual attempts. "
      "Trainees see their own; mentors, directors and researchers those of the people who are theirs to "
      "see.</p>\n</div>\n");
  return page("No individual attempts", visitor, html);
}

}  // namespace seldinger::reports
