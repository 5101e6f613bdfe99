#include "reports/learning/standard_report.h"

#include <algorithm>

#include "assessment/grading/debrief.h"
#include "assessment/registry.h"
#include "casedb/database/uuid.h"
#include "casedb/grading/dependability.h"
#include "reports/charts/interval_chart.h"
#include "reports/learning/cut_words.h"
#include "reports/learning/learning_page.h"
#include "reports/studies/study_words.h"
#include "reports/words/dependability_words.h"
#include "reports/words/metric_words.h"

namespace seldinger::reports {
namespace {

using casedb::Cut;

// What the case's own rule asks of that metric, beside the cuts; empty: nothing.
std::string rule_text(const StandardReport& report, const std::string& metric_id) {
  for (const assessment::Criterion& one : report.rule.criteria)
    if (one.metric == metric_id) {
      const assessment::MetricInfo* info = assessment::find_metric(metric_id);
      return "The case’s rule asks for " + assessment::limit_text(one, info == nullptr ? "" : info->unit) + ".";
    }
  return {};
}

void add_scale(Html& html, const StandardReport& report, const std::vector<const Cut*>& cuts) {
  const Cut& first = *cuts.front();
  const Cut* holds = casedb::cut_in_force(report.cuts, first.metric_id);
  IntervalChart chart;
  chart.said = "Cuts by method: " + cut_scale_text(first);
  chart.x_label = cut_scale_text(first);
  for (const Cut* one : cuts)
    chart.rows.push_back(
        {cut_method_text(one->method), one->value, one->interval, "n = " + std::to_string(one->n), one == holds});
  html.raw("<section class=\"learned\">\n<h2>")
      .text(cut_scale_text(first))
      .raw("</h2>\n")
      .add(interval_chart(chart));
  html.raw("<p>");
  if (holds != nullptr)
    html.raw("<strong>").text(cut_text(*holds)).raw("</strong> holds. ").text(cut_standing_text(*holds)).raw(". ");
  else
    html.raw("None is frozen yet: a director who did not propose it can freeze one. ");
  html.text(rule_text(report, first.metric_id)).raw("</p>\n");
  html.raw(
      "<table class=\"outcomes\"><thead><tr><th scope=\"col\">Method</th><th scope=\"col\" "
      "class=\"number\">Cut</th><th scope=\"col\">95 % interval</th><th scope=\"col\" class=\"number\">n</th><th "
      "scope=\"col\">How, and by whom</th></tr></thead><tbody>\n");
  for (const Cut* one : cuts) {
    html.raw("<tr><th scope=\"row\">").text(cut_method_text(one->method)).raw("</th><td class=\"number\">");
    html.text(digits_text(one->value)).raw("</td><td>").text(interval_text(one->interval));
    html.raw("</td><td class=\"number\">").text(std::to_string(one->n)).raw("</td><td>").text(one->words);
    html.raw("<span class=\"why\">").text(cut_standing_text(*one));
    if (!one->options.empty()) html.raw(". Options: ").text(one->options);
    html.raw("</span></td></tr>\n");
  }
  html.raw("</tbody></table>\n");
  for (const Cut* one : cuts) {
    html.raw("<details><summary>The data of ").text(cut_method_text(one->method)).raw(", ");
    html.text(utc_text(one->proposed_us)).raw("</summary><pre>").text(one->data).raw("</pre></details>\n");
  }
  html.raw("</section>\n");
}

}  // namespace

StandardReport standard_report_of(casedb::Library& library, const casedb::CaseRow& row,
                                  const std::string& program_version) {
  return {row.title,
          row.version,
          casedb::now_us(),
          program_version,
          row.rule,
          casedb::list_cuts(library, row.case_id),
          casedb::dependability(casedb::learning_attempts(library, casedb::Learners::people))};
}

std::string standard_report_page(const StandardReport& report) {
  Html html;
  html.raw("<h1>Standard: ")
      .name(report.title)
      .raw(", version ")
      .text(std::to_string(report.version))
      .raw("</h1>\n");
  html.add(made_by(report.made_us, report.program_version, false));
  if (report.cuts.empty()) html.raw("<p>Nobody has proposed a cut for this case.</p>\n");
  std::vector<std::string> scales;
  for (const Cut& one : report.cuts)
    if (std::find(scales.begin(), scales.end(), one.metric_id) == scales.end()) scales.push_back(one.metric_id);
  for (const std::string& scale : scales) {
    std::vector<const Cut*> cuts;
    for (const Cut& one : report.cuts)
      if (one.metric_id == scale) cuts.push_back(&one);
    add_scale(html, report, cuts);
  }
  if (!report.cuts.empty())
    html.raw(
        "<p class=\"note\">The filled mark is the cut that holds. Methods that disagree by more than their "
        "intervals answer different questions: which one counts is a decision, and whoever makes it signs for "
        "it.</p>\n");
  html.raw("<h2>")
      .text(kWhatPassingShows)
      .raw("</h2>\n<p>")
      .text(dependability_text(report.dependability, casedb::Learners::people))
      .raw("</p>\n");
  return learning_page(report.title + " – standard", html);
}

}  // namespace seldinger::reports
