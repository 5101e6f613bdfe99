// Evidence by internal structure: whether items of a questionnaire hang together, and how far raters agree.
#include "reports/studies/validity_sections.h"
#include "reports/words/metric_words.h"

namespace seldinger::reports {
namespace {

namespace statistics = assessment::statistics;

void add_estimate(Html& html, const statistics::Answer& answer) {
  html.raw("<td>");
  if (!answer.estimate) {
    html.raw("not estimated: too few, or all alike</td>");
    return;
  }
  html.text(number_text(*answer.estimate, 2));
  if (answer.ci95)
    html.text(" [" + number_text(answer.ci95->low, 2) + " to " + number_text(answer.ci95->high, 2) + "]");
  html.raw("</td>");
}

Html forms_panel(const ValidityReport& report) {
  Html html = evidence_panel("Internal structure", "Whether the items of a questionnaire hang together");
  html.raw(
      "<table><thead><tr><th scope=\"col\">Questionnaire</th><th scope=\"col\">Items</th><th "
      "scope=\"col\">Persons</th><th scope=\"col\">Cronbach’s α</th><th scope=\"col\">McDonald’s "
      "ω</th></tr></thead>"
      "<tbody>\n");
  for (const FormReliability& one : report.forms) {
    html.raw("<tr><th scope=\"row\">").text(one.form_title + ", version " + std::to_string(one.version));
    html.raw("<span class=\"why\">").text(one.round_title).raw("</span></th><td>");
    html.text(std::to_string(one.items) + " on a scale from " + std::to_string(one.low) + " to " +
              std::to_string(one.high));
    html.raw("</td><td>").text(std::to_string(one.alpha.n));
    if (one.alpha.missing > 0)
      html.text("; " + std::to_string(one.alpha.missing) + " left out because they did not answer every item");
    html.raw("</td>");
    add_estimate(html, one.alpha);
    add_estimate(html, one.omega);
    html.raw("</tr>\n");
  }
  return html.raw(
      "</tbody></table>\n<p class=\"note\">95 % intervals in brackets. Each round is analysed on its own, and so "
      "is each version of a form.</p>\n</article>\n");
}

Html raters_panel(const ValidityReport& report) {
  Html html = evidence_panel("Internal structure", "How far raters agree");
  html.raw(
      "<table><thead><tr><th scope=\"col\">Form</th><th scope=\"col\">Ratings</th><th scope=\"col\">Agreement of "
      "one "
      "rating (ICC)</th><th scope=\"col\">Of a replay’s mean</th></tr></thead><tbody>\n");
  for (const casedb::RatedRound& one : report.rated_rounds) {
    html.raw("<tr><th scope=\"row\">").text(one.form_title + ", version " + std::to_string(one.version));
    html.raw("<span class=\"why\">").text(one.round_title).raw("</span></th><td>");
    html.text(std::to_string(one.agreement.ratings)).raw("</td>");
    add_estimate(html, one.agreement.one);
    add_estimate(html, one.agreement.mean);
    html.raw("</tr>\n");
  }
  return html.raw(
      "</tbody></table>\n<p class=\"note\">One-way, random: severity counts as error. Without calibration and "
      "repeats.</p>\n</article>\n");
}

}  // namespace

Html structure_panels(const ValidityReport& report) {
  if (report.forms.empty() && report.rated_rounds.empty())
    return no_evidence_yet("Internal structure", "Whether items and raters agree",
                           "No questionnaire of the study was answered, and nothing was rated.");
  Html html;
  if (!report.forms.empty()) html.add(forms_panel(report));
  if (!report.rated_rounds.empty()) html.add(raters_panel(report));
  return html;
}

}  // namespace seldinger::reports
