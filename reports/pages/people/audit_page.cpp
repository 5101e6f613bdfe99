#include "reports/pages/people/audit_page.h"

#include "reports/words/attempt_words.h"
#include "reports/words/metric_words.h"

namespace seldinger::reports {
namespace {

// In words, where this program knows the act.
std::string act_text(const std::string& code) {
  for (std::size_t i = 0; i < casedb::kActs; ++i)
    if (casedb::name_of(static_cast<casedb::Act>(i)) == code)
      return std::string(casedb::words_of(static_cast<casedb::Act>(i)));
  return code;
}

std::string person_text_of(const AuditView& view, const std::string& person_id) {
  const auto name = view.names.find(person_id);
  return name == view.names.end() ? person_text(person_id) : name->second;
}

void add_row(Html& html, const AuditView& view, const casedb::AuditRow& row) {
  html.raw("<tr><th scope=\"row\" class=\"number\">").text(std::to_string(row.sequence));
  html.raw("</th><td data-label=\"When\"><time datetime=\"").text(utc_machine_text(row.at_us)).raw("\">");
  html.text(utc_text(row.at_us)).raw("</time></td><td data-label=\"Who\">");
  if (row.person_id) html.name(person_text_of(view, *row.person_id));
  if (row.actor != "person") html.text(row.person_id ? " (through the operator)" : row.actor);
  html.raw("</td><td data-label=\"What\">").text(act_text(row.act));
  if (row.result != "done") html.raw(" <span class=\"no\">refused</span>");
  html.raw("</td><td data-label=\"Of\">");
  if (row.object == "person")
    html.name(person_text_of(view, row.object_id));
  else
    html.text(row.object).raw(" <span class=\"why\">").text(row.object_id).raw("</span>");
  html.raw("</td></tr>\n");
}

}  // namespace

std::string audit_page(const Visitor& visitor, const AuditView& view) {
  Html html;
  html.raw("<h1>Audit log</h1>\n");
  if (view.problems.empty()) {
    html.raw("<p class=\"note\"><span class=\"yes\">Every row is as it was written.</span> ")
        .text(std::to_string(view.count));
    html.raw(
        " rows; each carries its own hash and that of the row before it. docs/keeping.md says what that shows and "
        "what it cannot.</p>\n");
  } else {
    html.raw("<div class=\"problem\" role=\"alert\">\n<p>The log was changed after it was written:</p>\n<ul>\n");
    for (const std::string& one : view.problems) html.raw("<li>").text(one).raw("</li>\n");
    html.raw("</ul>\n</div>\n");
  }
  html.raw(
          "<form class=\"filter\" method=\"get\" action=\"/audit\">\n<p><label for=\"days\">Days</label>\n<input "
          "id=\"days\" "
          "name=\"days\" type=\"number\" min=\"1\" max=\"3650\" value=\"")
      .text(std::to_string(view.days));
  html.raw("\"></p>\n<p><button class=\"quiet\">Show</button></p>\n</form>\n");
  if (view.rows.empty()) {
    html.raw("<p>Nothing was done in these days.</p>\n");
    return page("Audit log", visitor, html);
  }
  html.raw("<div class=\"wide\">\n<table class=\"list\">\n<caption>").text(std::to_string(view.rows.size()));
  html.text(view.more ? " acts, newest first; older ones of these days are left out" : " acts, newest first");
  html.raw(
      "</caption>\n<thead><tr><th scope=\"col\" class=\"number\">Row</th><th scope=\"col\">When (UTC)</th><th "
      "scope=\"col\">Who</th><th scope=\"col\">What</th><th scope=\"col\">Of</th></tr></thead>\n<tbody>\n");
  for (const casedb::AuditRow& row : view.rows) add_row(html, view, row);
  html.raw("</tbody>\n</table>\n</div>\n");
  return list_page("Audit log", visitor, html);
}

}  // namespace seldinger::reports
