#include "reports/pages/case_page.h"

#include "reports/words/attempt_words.h"
#include "reports/words/case_words.h"
#include "reports/words/dependability_words.h"
#include "reports/words/grade_words.h"
#include "reports/words/metric_words.h"

namespace seldinger::reports {
namespace {

void add_fact(Html& html, std::string_view name, std::string_view value) {
  if (value.empty()) return;
  html.raw("<tr><th scope=\"row\">").text(name).raw("</th><td>").text(value).raw("</td></tr>\n");
}

std::string state_text(const casedb::CaseRow& row) {
  return casedb::name_of(row.state) + ", version " + std::to_string(row.version) +
         (row.own_cohort_only ? ", unreviewed: own cohort only" : "");
}

std::string lesion_text(const casedb::LesionRow& lesion) {
  const cases::LesionForm& form = lesion.form;
  return std::string(cases::about(form.kind).words) + ", " +
         std::string(base::name_of(cases::kLesionOutlineNames, form.outline)) + ", " +
         reports::lesion_text(lesion.lesion) + ", " + (form.adds ? "tissue plus " : "") + number_text(form.hu, 0) +
         " HU";
}

void add_table(Html& html, std::string_view caption) {
  html.raw("<div class=\"wide\">\n<table>\n<caption>").text(caption).raw("</caption>\n<tbody>\n");
}
void end_table(Html& html) {
  html.raw("</tbody>\n</table>\n</div>\n");
}

}  // namespace

std::string case_page(const Visitor& visitor, const casedb::CaseParts& parts) {
  const casedb::CaseRow& row = parts.row;
  Html html;
  html.raw("<h1>").name(row.title).raw("</h1>\n");
  add_table(html, "The case");
  add_fact(html, "State", state_text(row));
  const auto review = casedb::review_of(parts.decisions);
  add_fact(html, "Reviewed by", review ? review->who() : "nobody");
  add_fact(html, "Guidance", guidance_text(row));
  add_fact(html, "Needle",
           instrument_text(row.instrument) + ", " + number_text(row.instrument.length_mm, 0) + " mm");
  for (const SettingFact& one : setting_facts(row)) add_fact(html, one.words, one.value);
  for (const casedb::LesionRow& lesion : parts.lesions) add_fact(html, "Lesion", lesion_text(lesion));
  end_table(html);

  if (!parts.structures.empty()) {
    add_table(html, "Structures");
    for (const casedb::StructureRow& one : parts.structures)
      add_fact(html, one.name,
               words_from_code(cases::name_of(one.rule)) + ", " + words_from_code(volume::about(one.tissue).name) +
                   ", " + casedb::name_of(one.kind));
    end_table(html);
  }

  add_table(html, "To pass");
  for (const RuleLine& one : rule_lines(row.rule))
    add_fact(html, one.metric, one.bound + (one.critical ? "; not meeting this is a critical error" : ""));
  // Until a director sets one it is nobody's standard (casedb/grading/standards.h).
  add_fact(html, "Standing",
           row.rule.criteria.empty() ? ""
           : parts.provisional       ? "provisional: no consultant standard has been set"
                                     : "consultants have set the standard");
  if (parts.dependability)
    add_fact(html, kWhatPassingShows, dependability_text(*parts.dependability, casedb::Learners::people));
  end_table(html);

  add_table(html, "Decisions");
  for (const casedb::Decision& one : parts.decisions)
    add_fact(html, casedb::name_of(one.kind),
             one.who() + ", " + told_text(one.decided_us) + (one.note.empty() ? "" : ": " + one.note));
  end_table(html);
  html.raw("<p><a href=\"/cases/").text(row.case_id).raw("/case.json\">as JSON</a>, <a href=\"/cases/");
  html.text(row.case_id).raw("/checks.json\">its checks</a></p>\n");
  return page(row.title, visitor, html);
}

std::string cases_page(const Visitor& visitor, std::span<const casedb::CaseRow> rows) {
  Html html;
  html.raw(
      "<h1>Cases</h1>\n<div class=\"wide\">\n<table class=\"list\">\n<caption>Oldest "
      "first</caption>\n<thead><tr><th "
      "scope=\"col\">Case</th><th scope=\"col\">State</th><th scope=\"col\">Guidance</th></tr></thead>\n<tbody>\n");
  for (const casedb::CaseRow& row : rows)
    html.raw("<tr><th scope=\"row\"><a href=\"/cases/")
        .text(row.case_id)
        .raw("\">")
        .name(row.title)
        .raw("</a></th><td data-label=\"State\">")
        .text(state_text(row))
        .raw("</td><td data-label=\"Guidance\">")
        .text(guidance_text(row))
        .raw("</td></tr>\n");
  end_table(html);
  return list_page("Cases", visitor, html);
}

}  // namespace seldinger::reports
