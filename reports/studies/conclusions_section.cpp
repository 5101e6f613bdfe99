#include "reports/studies/outcome_table.h"
#include "reports/studies/study_words.h"
#include "reports/studies/validity_sections.h"
#include "reports/words/people_words.h"

namespace seldinger::reports {

namespace {

// Until the freeze: counts of all together, so that nobody plans by what came out.
Html blinded(const ValidityReport& report) {
  Html html;
  html.raw(
      "<p>The plan is a <strong>draft</strong>: until it is frozen nobody who works on the study sees an outcome "
      "by group. All together:</p>\n<ul><li>");
  html.text(study_people_text(report.blinded.people)).raw("</li><li>");
  html.text(std::to_string(report.blinded.with_attempts))
      .raw(" of them have made attempts at the plan’s cases</li><li>");
  return html.text(std::to_string(report.blinded.attempts)).raw(" attempts</li></ul>\n");
}

}  // namespace

Html conclusions_section(const ValidityReport& report) {
  Html html;
  html.raw(
      "<section id=\"conclusions\">\n<h2>2 Conclusions</h2>\n<p class=\"tag\">Relations to other variables</p>\n");
  if (!report.plan.frozen()) return html.add(blinded(report)).raw("</section>\n");
  const double alpha = report.plan.plan.alpha;
  if (!report.result.stopped) {
    html.raw("<p class=\"problem\">Not all of the planned people are in: the plan stops at ");
    html.text(std::to_string(report.plan.plan.per_group));
    html.raw(
        " in each group. This is an interim look; it concludes nothing that the plan promised to conclude at its "
        "end."
        "</p>\n");
  }
  html.add(outcome_table(report.result.primary, alpha, true,
                         "Primary outcomes: conclusions rest on these alone, at α = " + digits_text(alpha) +
                             " for all of them together (Holm)"));
  html.raw(
      "<p class=\"note\">The square is the estimate, the line its 95 % interval, the dashed line no difference");
  if (draws_worthwhile(report.result.primary))
    html.raw("; the grey band holds differences smaller than the smallest worthwhile one");
  html.raw(
      ". P is the chance that somebody of the first group has a larger value than somebody of the second, ties "
      "counting half. “Would have been found”: with 80 % power at α = 0.05, one test, two-sided.</p>\n");
  return html.add(sensitivity_table(report.result.primary)).raw("</section>\n");
}

}  // namespace seldinger::reports
