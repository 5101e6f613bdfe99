#include <span>
#include <string>

#include "reports/pages/page.h"
#include "reports/pages/style_sheet.h"
#include "reports/studies/study_style.h"
#include "reports/studies/validity_sections.h"
#include "reports/words/metric_words.h"
#include "sim/base/embedded.h"

namespace seldinger::embedded {
std::span<const base::EmbeddedFile> study_files();
}

namespace seldinger::reports {

std::string report_style() {
  return std::string(style_sheet()) + std::string(base::content_of(embedded::study_files(), "report.css"));
}

std::string validity_page(const ValidityReport& report) {
  const assessment::study::Plan& plan = report.plan.plan;
  Html html;
  html.raw("<h1>")
      .text(plan.title)
      .raw("</h1>\n<p class=\"sub\">Validity report of the study ")
      .name(report.study.title);
  html.raw(", ").text(utc_text(report.made_us)).raw(". Plan ").text(report.plan.body_hash.substr(0, 12));
  html.raw("…, ").text(report.plan.frozen() ? "frozen " + utc_text(*report.plan.frozen_us) : "a draft");
  html.raw(".</p>\n");
  if (plan.people == assessment::study::People::simulated)
    html.raw(
        "<p class=\"simulated\"><strong>SIMULATED.</strong> Every attempt in this report was made by a simulated "
        "operator. Nothing in it is about people.</p>\n");
  for (const auto section :
       {&argument_section, &conclusions_section, &sources_section, &flow_section, &limits_section,
        &reviewer_section, &provenance_section, &checklist_section, &plan_section})
    html.add(section(report));
  return page_with_style(plan.title + " – validity", report_style(), html);
}

}  // namespace seldinger::reports
