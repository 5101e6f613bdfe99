#include "reports/pages/compare_page.h"

#include <algorithm>

#include "assessment/grading/plain_words.h"
#include "reports/markup/html.h"
#include "reports/pages/page.h"
#include "reports/pages/sections/grade_section.h"
#include "reports/pages/sections/metric_details.h"
#include "reports/words/attempt_words.h"
#include "reports/words/dependability_words.h"
#include "reports/words/grade_words.h"
#include "reports/words/metric_words.h"

namespace seldinger::reports {
namespace {

using casedb::ComparedAttempt;
using casedb::ComparedGroup;
using casedb::Comparison;

std::string of(std::size_t some, std::size_t all) {
  return std::to_string(some) + " of " + std::to_string(all);
}

void add_head(Html& html, const Comparison& comparison, std::string_view first) {
  html.raw("<thead><tr><th scope=\"col\">").text(first).raw("</th>");
  for (const ComparedGroup& group : comparison.groups)
    html.raw("<th scope=\"col\" class=\"number\">").name(group_label(group)).raw("</th>");
  if (comparison.experts.standard()) html.raw("<th scope=\"col\" class=\"number\">Consultants</th>");
  html.raw("</tr></thead>\n");
}

void add_band_cell(Html& html, const Comparison& comparison, std::string_view id, int version) {
  if (!comparison.experts.standard()) return;
  const std::string band = band_text(comparison.experts, id, version);
  const std::string beside = tolerance_text(comparison.experts, id, version);
  html.raw("<td class=\"number\">").text(band.empty() ? "–" : band);
  if (!beside.empty()) html.raw(" <span class=\"why\">").text(beside).raw("</span>");
  html.raw("</td>");
}

void add_count_row(Html& html, const Comparison& comparison, std::string_view label,
                   std::string (*cell)(const ComparedGroup&)) {
  html.raw("<tr><th scope=\"row\">").text(label).raw("</th>");
  for (const ComparedGroup& group : comparison.groups)
    html.raw("<td class=\"number\">").text(cell(group)).raw("</td>");
  if (comparison.experts.standard()) html.raw("<td></td>");
  html.raw("</tr>\n");
}

void add_criteria(Html& html, const Comparison& comparison) {
  html.raw(
      "<div class=\"wide compare\" role=\"region\" tabindex=\"0\" aria-label=\"Criteria\"><table>\n<caption>Who "
      "passes, and by which criterion: how many met it, then the median with lowest and highest</caption>\n");
  add_head(html, comparison, "Criterion");
  html.raw("<tbody>\n");
  add_count_row(html, comparison, "Attempts",
                [](const ComparedGroup& group) { return std::to_string(group.attempts.size()); });
  add_count_row(html, comparison, "Left out: procedure not performed",
                [](const ComparedGroup& group) { return std::to_string(group.not_performed); });
  add_count_row(html, comparison, "Passed, of those graded",
                [](const ComparedGroup& group) { return of(group.passed, group.gradable); });
  add_count_row(html, comparison, "With a critical error",
                [](const ComparedGroup& group) { return of(group.with_critical_errors, group.gradable); });
  for (std::size_t i = 0; i < comparison.criteria.size(); ++i) {
    const assessment::CriterionResult& one = comparison.criteria[i];
    html.raw("<tr><th scope=\"row\">")
        .add(metric_details(
            one.criterion.metric, one.criterion.version,
            metric_label(one.criterion.metric) + ", " + assessment::limit_text(one.criterion, one.unit)));
    if (one.criterion.critical) html.raw(" <span class=\"mark critical\">critical</span>");
    if (one.of_the_time_limit) html.raw(" <span class=\"mark\">time limit</span>");
    html.raw("</th>");
    for (const ComparedGroup& group : comparison.groups) {
      const bool all = group.met[i] == group.gradable;
      html.raw("<td class=\"number\">");
      if (all) {
        html.raw("<span class=\"yes\">");
      } else {
        html.raw("<span class=\"no\">");
      }
      html.text(of(group.met[i], group.gradable)).raw("</span>");
      if (one.unit != "bool")
        html.raw(" <span class=\"why\">").text(compared_text(group.of_criteria[i], one.unit)).raw("</span>");
      html.raw("</td>");
    }
    add_band_cell(html, comparison, one.criterion.metric, one.criterion.version);
    html.raw("</tr>\n");
  }
  html.raw("</tbody>\n</table></div>\n");
}

void add_metrics(Html& html, const Comparison& comparison) {
  html.raw(
      "<details open><summary>Every metric</summary>\n<div class=\"wide compare\" role=\"region\" tabindex=\"0\" "
      "aria-label=\"Metrics\"><table>\n<caption>Median (of rare events the mean), and lowest to highest; for yes "
      "or no, how many. Attempts in which the procedure was performed; one neither fired nor deferred counts as "
      "the worst where it says so</caption>\n");
  add_head(html, comparison, "Metric");
  html.raw("<tbody>\n");
  for (std::size_t i = 0; i < comparison.metrics.size(); ++i) {
    const assessment::MetricInfo& info = comparison.metrics[i];
    html.raw("<tr><th scope=\"row\">").add(metric_details(info.id, info.version)).raw("</th>");
    for (const ComparedGroup& group : comparison.groups) {
      html.raw("<td class=\"number\">").text(estimate_text(group.of_metrics[i], info));
      if (group.of_metrics[i].n > 0 && group.of_metrics[i].n < group.gradable)
        html.raw(" <span class=\"why\">n = ").text(std::to_string(group.of_metrics[i].n)).raw("</span>");
      html.raw("</td>");
    }
    add_band_cell(html, comparison, info.id, info.version);
    html.raw("</tr>\n");
  }
  html.raw("</tbody>\n</table></div>\n</details>\n");
}

void add_debriefs(Html& html, const Comparison& comparison) {
  html.raw("<section>\n<h2>Feedback on each attempt</h2>\n<div class=\"columns\">\n");
  for (const ComparedGroup& group : comparison.groups) {
    html.raw("<div>\n<h3>").name(group_label(group)).raw("</h3>\n");
    for (const ComparedAttempt& attempt : group.attempts) {
      html.raw("<article>\n<h4>").text(utc_text(attempt.row.started_us));
      if (!group.person_id) html.text(", seed " + std::to_string(attempt.row.seed));
      html.raw(": ").text(verdict_text(attempt.grade.grade));
      if (attempt.grade.score.value) html.text(", score " + score_text(attempt.grade.score));
      html.raw("</h4>\n").add(debrief_list(attempt.grade.debrief)).raw("</article>\n");
    }
    html.raw("</div>\n");
  }
  html.raw("</div>\n</section>\n");
}

}  // namespace

std::string group_label(const casedb::ComparedGroup& group) {
  return group.person_id ? person_text(*group.person_id) : simulated_operator_text(group.operator_name);
}

std::string compared_text(const casedb::ComparedMetric& metric, std::string_view unit) {
  if (metric.n == 0) return "—";
  if (unit == "bool")
    return number_text(metric.mean * static_cast<double>(metric.n), 0) + " of " + std::to_string(metric.n);
  std::string text = assessment::plain_value(metric.median, unit);
  if (metric.low != metric.high) text += " (" + assessment::plain_range(metric.low, metric.high, unit) + ")";
  return text;
}

std::string estimate_text(const casedb::ComparedMetric& metric, const assessment::MetricInfo& info) {
  const assessment::OnePerson& one = metric.one;
  std::string text;
  if (info.estimand.aggregation == assessment::Aggregation::proportion && one.estimate) {
    const std::size_t all = one.values + one.failures;
    text = number_text(*one.estimate * static_cast<double>(all), 0) + " of " + std::to_string(all);
  } else if (one.worst) {
    text = "worse than any value";
  } else if (one.estimate) {
    text = assessment::plain_value(*one.estimate, info.unit);
  } else {
    return "—";
  }
  if (metric.n > 0 && metric.low != metric.high && std::string_view(info.unit) != "bool")
    text += " (" + assessment::plain_range(metric.low, metric.high, info.unit) + ")";
  if (one.failures > 0) text += ", " + std::to_string(one.failures) + " without success";
  if (one.censored > 0) text += ", " + std::to_string(one.censored) + " not ended";
  return text;
}

std::string compare_page(const casedb::Comparison& comparison, std::string_view style) {
  Html html;
  html.raw("<h1>Side by side</h1>\n<p class=\"sub\">")
      .name(comparison.row.title)
      .raw(", version ")
      .text(std::to_string(comparison.row.version))
      .raw(" · ")
      .text(comparison.manner.modality == cases::Modality::ultrasound ? "ultrasound"
            : comparison.manner.modality == cases::Modality::xray     ? "fluoroscopy"
                                                                      : "CT slices")
      .raw("</p>\n");
  const bool simulated = std::any_of(comparison.groups.begin(), comparison.groups.end(),
                                     [](const ComparedGroup& group) { return !group.person_id; });
  if (simulated)
    html.raw(
        "<p class=\"note\">Simulated operators test the software. They set no standard, and their differences say "
        "nothing about validity.</p>\n");
  html.raw("<p class=\"note\">").text(experts_text(comparison.experts));
  if (comparison.experts.standard()) html.text(" " + bands_note());
  html.raw("</p>\n");
  if (comparison.other_tasks > 0)
    html.raw("<p class=\"note\">Left out: ")
        .text(std::to_string(comparison.other_tasks))
        .raw(" with another target, guidance, approach or kind of needle.</p>\n");
  add_criteria(html, comparison);
  if (comparison.dependability)
    html.raw("<p class=\"note\">")
        .text(kWhatPassingShows)
        .raw(": ")
        .text(dependability_text(*comparison.dependability, casedb::Learners::people))
        .raw("</p>\n");
  add_debriefs(html, comparison);
  add_metrics(html, comparison);
  return page_with_style("Side by side", style, html);
}

}  // namespace seldinger::reports
