#include "assessment/grading/debrief.h"
#include "assessment/grading/plain_words.h"
#include "assessment/registry.h"
#include "assessment/statistics/reasons.h"
#include "assessment/statistics/relations/proportions.h"
#include "reports/studies/numbers/decision_numbers.h"
#include "reports/studies/study_words.h"
#include "reports/studies/validity_sections.h"
#include "reports/words/metric_words.h"

namespace seldinger::reports {
namespace {

namespace study = assessment::study;
namespace statistics = assessment::statistics;

std::string unit_of(const std::string& metric) {
  const assessment::MetricInfo* info = assessment::find_metric(metric);
  return info == nullptr ? "" : info->unit;
}

std::string name_of_outcome(const study::Compared& one) {
  return one.outcome.name + (one.hand.empty() ? "" : ", hand: " + one.hand);
}

std::string number_or_dash(const std::optional<double>& value, const std::string& unit) {
  return value ? digits_text(*value) + " " + unit : "–";
}

// Of a group how many are at the mark.
void add_rate(Html& html, const study::Compared& one, const std::string& group, const PassMark& mark) {
  const AtMark found = at_mark(one, group, mark);
  html.raw("<td>").text(group + ": " +
                        of_text(static_cast<std::size_t>(found.passed), static_cast<std::size_t>(found.n)));
  if (found.n > 0) {
    const statistics::Interval share = statistics::wilson_interval(found.passed, found.n);
    html.raw(" <span class=\"why\">").text(number_text(100.0 * share.low, 0) + " to ");
    html.text(number_text(100.0 * share.high, 0)).raw(" %</span>");
  }
  html.raw("</td>");
}

void add_decisions(Html& html, const study::Compared& one, const PassMark& mark) {
  const statistics::Answer agreement = agreement_of(one);
  const statistics::Answer answer = decisions_of(one, mark, agreement);
  html.raw("<td>");
  if (!answer.estimable() || !answer.estimate) {
    html.raw("not estimated: ")
        .text(agreement.estimable() ? statistics::find_reason(answer.reason.c_str())->words
                                    : "the reliability is not known");
  } else {
    const auto share = [&](const char* name) {
      return number_text(100.0 * further(answer, name).value_or(0.0), 0);
    };
    html.text(number_text(100.0 * *answer.estimate, 0)).raw(" % alike a second time; falsely passed ");
    html.text(share("false_pass")).raw(" %, falsely failed ").text(share("false_fail")).raw(" %");
  }
  html.raw("</td>");
}

}  // namespace

Html internal_structure_panel(const ValidityReport& report) {
  Html html = evidence_panel("Internal structure", "Whether repeated attempts agree");
  html.raw(
      "<div class=\"wide\" tabindex=\"0\" role=\"group\" aria-label=\"Whether repeated attempts "
      "agree\"><table><thead><tr><th scope=\"col\">Outcome</th><th scope=\"col\">Persons</th><th "
      "scope=\"col\">ICC(2,1) of "
      "the last two attempts</th><th scope=\"col\">Error of one attempt</th><th scope=\"col\">Least change of a "
      "person that is more than error</th></tr></thead><tbody>\n");
  for (const study::Compared& one : report.result.primary) {
    const statistics::Answer answer = agreement_of(one);
    const std::string unit = unit_of(one.outcome.metric);
    html.raw("<tr><th scope=\"row\">").text(name_of_outcome(one)).raw("</th><td>").text(std::to_string(answer.n));
    html.raw("</td><td>");
    if (!answer.estimate) {
      html.raw("not estimated: ")
          .text(answer.estimable() ? "the values do not differ"
                                   : statistics::find_reason(answer.reason.c_str())->words);
    } else {
      html.text(number_text(*answer.estimate, 2));
      if (answer.ci95)
        html.text(" [" + number_text(answer.ci95->low, 2) + " to " + number_text(answer.ci95->high, 2) + "]");
    }
    html.raw("</td><td>").text(number_or_dash(further(answer, "sem"), unit)).raw("</td><td>");
    html.text(number_or_dash(further(answer, "mdc95"), unit)).raw("</td></tr>\n");
  }
  return html.raw(
      "</tbody></table></div>\n<p class=\"note\">People who have two attempts with a value, both groups together: "
      "groups that differ raise it, learning between the attempts lowers it.</p>\n</article>\n");
}

Html consequences_panel(const ValidityReport& report) {
  Html html = evidence_panel("Consequences", "What the numbers decide, and for whom");
  Html rows;
  for (const study::Compared& one : report.result.primary) {
    const auto mark = pass_mark_of(report.marks, one.outcome);
    if (!mark) continue;
    rows.raw("<tr><th scope=\"row\">").text(name_of_outcome(one)).raw("</th><td>");
    rows.text(mark->higher_is_better ? "at least " : "at most ");
    rows.text(assessment::plain_value(mark->cut, unit_of(one.outcome.metric)));
    rows.raw(" <span class=\"why\">").text(mark->words).raw("</span></td>");
    add_rate(rows, one, one.outcome.first, *mark);
    add_rate(rows, one, one.outcome.second, *mark);
    add_decisions(rows, one, *mark);
    rows.raw("</tr>\n");
  }
  if (rows.empty())
    return html.raw(
        "<p><strong>None yet.</strong> No case of this plan has a pass mark for a primary outcome, so no false "
        "passes or failures can be estimated.</p>\n</article>\n");
  return html
      .raw(
          "<table><thead><tr><th scope=\"col\">Outcome</th><th scope=\"col\">Pass mark</th><th scope=\"col\" "
          "colspan=\"2\">Persons at it</th><th scope=\"col\">Decisions</th></tr></thead><tbody>\n")
      .add(rows)
      .raw(
          "</tbody></table>\n<p class=\"note\">Persons by the value that the study compares. Decisions are by "
          "normal "
          "scores with the reliability above (Peng and Subkoviak).</p>\n</article>\n");
}

}  // namespace seldinger::reports
