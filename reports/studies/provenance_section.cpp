#include "reports/studies/study_words.h"
#include "reports/studies/validity_sections.h"
#include "reports/words/metric_words.h"

namespace seldinger::reports {
namespace {

std::string who(const casedb::StudyNote& note) {
  if (note.actor == "person") return note.pseudonym.value_or("somebody who was erased");
  if (note.actor == "operator") return note.pseudonym ? "the operator, for " + *note.pseudonym : "the operator";
  return note.actor;
}

Html notes_table(const std::vector<casedb::StudyNote>& notes, bool looks) {
  Html html;
  if (notes.empty()) return html.raw("<p>None.</p>\n");
  html.raw(
      "<table><thead><tr><th scope=\"col\" class=\"number\">No.</th><th scope=\"col\">When</th><th "
      "scope=\"col\">Who"
      "</th><th scope=\"col\">What</th>");
  if (looks) html.raw("<th scope=\"col\" class=\"number\">People with an outcome by then</th>");
  html.raw("</tr></thead><tbody>\n");
  for (const casedb::StudyNote& one : notes) {
    html.raw("<tr><td class=\"number\">")
        .text(std::to_string(one.number))
        .raw("</td><td>")
        .text(utc_text(one.at_us));
    html.raw("</td><td>").text(who(one)).raw("</td><td>").text(one.text).raw("</td>");
    if (looks) html.raw("<td class=\"number\">").text(std::to_string(one.people)).raw("</td>");
    html.raw("</tr>\n");
  }
  return html.raw("</tbody></table>\n");
}

}  // namespace

void add_fact_row(Html& html, std::string_view name, std::string_view value) {
  html.raw("<tr><th scope=\"row\">").text(name).raw("</th><td>").text(value).raw("</td></tr>\n");
}

Html provenance_section(const ValidityReport& report) {
  Html html;
  html.raw("<section id=\"provenance\">\n<h2>7 Plan, looks, deviations</h2>\n<table class=\"facts\"><tbody>\n");
  add_fact_row(html, "Plan, SHA-256", report.plan.body_hash);
  add_fact_row(html, "Frozen", report.plan.frozen() ? utc_text(*report.plan.frozen_us) : "not yet");
  if (report.plan.frozen()) {
    if (report.plan.plan.randomised) add_fact_row(html, "Seed of the allocation, SHA-256", report.plan.seed_hash);
    add_fact_row(html, "Analysed values, SHA-256", report.data_hash);
    add_fact_row(html, "Data locked", report.lock ? utc_text(report.lock->locked_us) : "not yet");
    if (report.lock)
      add_fact_row(html, "Locked values, SHA-256",
                   report.lock->data_hash +
                       (report.lock->data_hash == report.data_hash
                            ? ": those that are analysed here"
                            : ": not those analysed here, as when somebody has withdrawn or was erased since, an "
                              "attempt begun before was stored later, or values were recomputed"));
  }
  add_fact_row(html, "Report made", utc_text(report.made_us));
  add_fact_row(html, "Program", "Seldinger " + report.program_version);
  html.raw("</tbody></table>\n<h3>Looks at outcomes by group</h3>\n").add(notes_table(report.looks, true));
  html.raw("<h3>Deviations from the plan</h3>\n").add(notes_table(report.deviations, false));
  return html.raw("</section>\n");
}

}  // namespace seldinger::reports
