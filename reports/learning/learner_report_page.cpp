#include <algorithm>
#include <cmath>

#include "assessment/grading/debrief.h"
#include "assessment/grading/plain_words.h"
#include "assessment/grading/progress.h"
#include "assessment/population/person.h"
#include "assessment/registry.h"
#include "assessment/statistics/growth/cusum_chart.h"
#include "assessment/statistics/growth/learning_curve.h"
#include "assessment/statistics/growth/proficiency.h"
#include "assessment/statistics/reasons.h"
#include "reports/charts/series_chart.h"
#include "reports/learning/learner_report.h"
#include "reports/learning/learning_page.h"
#include "reports/studies/study_words.h"
#include "reports/words/dependability_words.h"
#include "reports/words/grade_words.h"
#include "reports/words/metric_words.h"

namespace seldinger::reports {
namespace {

namespace statistics = assessment::statistics;
using casedb::LearningAttempt;

constexpr int kCurvePoints = 60;

std::string per_cent(double share) {
  return number_text(100.0 * share, 0) + " %";
}

std::string why_none(const statistics::Answer& answer) {
  return std::string(statistics::find_reason(answer.reason.c_str())->words);
}

// A value an attempt, in order; x counts all attempts at the case, so that charts stand below each other.
statistics::DataTable table_of(const std::vector<double>& x, const std::vector<double>& values) {
  statistics::DataTable table;
  table.rows = values.size();
  table.values.push_back({"value", values});
  table.x = x;
  return table;
}

struct Course {
  std::vector<double> x, passed;  // of the graded
};

Course course_of(const LearnerItem& item) {
  Course course;
  for (std::size_t i = 0; i < item.attempts.size(); ++i) {
    if (!item.attempts[i].graded()) continue;
    course.x.push_back(static_cast<double>(i + 1));
    course.passed.push_back(item.attempts[i].passed() ? 1.0 : 0.0);
  }
  return course;
}

void say_none(Html& html, const statistics::Answer& answer) {
  html.raw("<p class=\"note\">Not estimated: ").text(why_none(answer)).raw(".</p>\n");
}

// --- the curve of a criterion's metric --------------------------------------------------------------------------
void add_curve(Html& html, const LearnerItem& item, const assessment::Criterion& criterion,
               const assessment::MetricInfo& info) {
  std::vector<double> x, y;
  SeriesChart chart;
  for (std::size_t i = 0; i < item.attempts.size(); ++i) {
    const assessment::MetricValue* value =
        assessment::find_version(item.attempts[i].metrics, criterion.metric, criterion.version);
    if (value == nullptr || !value->value || !std::isfinite(*value->value)) continue;
    x.push_back(static_cast<double>(i + 1));
    y.push_back(*value->value);
    chart.points.push_back({x.back(), y.back(), item.attempts[i].passed()});
  }
  html.raw("<h3>").text(info.label).raw("</h3>\n");
  if (y.empty()) {
    html.raw("<p class=\"note\">No attempt has a value.</p>\n");
    return;
  }
  const bool higher = criterion.comparison == assessment::Comparison::at_least;
  const statistics::Answer answer = statistics::learning_curve(table_of(x, y), {.higher_is_better = higher});
  const bool learned = answer.estimable() && further(answer, "half_way_at").has_value();
  if (const auto curve = learned ? statistics::better_curve(x, y) : std::nullopt)
    for (int i = 0; i <= kCurvePoints; ++i) {
      const double t = x.front() + (x.back() - x.front()) * i / kCurvePoints;
      chart.curve.emplace_back(t, statistics::value_at(*curve, t));
    }
  chart.said = std::string(info.label) + " at each attempt";
  chart.x_label = "attempt";
  chart.y_label = std::string(info.unit);
  chart.limits = {{criterion.value, assessment::limit_text(criterion, info.unit)}};
  html.add(series_chart(chart));
  if (!answer.estimable()) {
    say_none(html, answer);
  } else if (!learned) {
    html.raw("<p>No learning is seen in these values.</p>\n");
  } else {
    html.raw("<p>Levels off at ").text(assessment::plain_value(*further(answer, "plateau"), info.unit));
    const auto low = further(answer, "plateau_low"), high = further(answer, "plateau_high");
    if (low && high) html.raw(" (95 % interval ").text(interval_text(statistics::Interval{*low, *high})).raw(")");
    html.raw("; half of the way there at attempt ").text(digits_text(*further(answer, "half_way_at")));
    html.raw(", by ").text(answer.method).raw(".</p>\n");
  }
}

// --- LC-CUSUM ---------------------------------------------------------------------------------------------------
void add_cusum(Html& html, const Course& course) {
  const statistics::CusumRule rule;
  std::vector<double> failed;
  for (const double one : course.passed) failed.push_back(1.0 - one);
  const statistics::Answer answer = statistics::lc_cusum(table_of(course.x, failed), rule);
  html.raw("<h3>Whether failures have become rare (LC-CUSUM)</h3>\n");
  if (!answer.estimable()) return say_none(html, answer);
  SeriesChart chart;
  for (std::size_t i = 0; i < answer.rows.size(); ++i)
    chart.points.push_back({course.x[i], answer.rows[i].values[1].value, course.passed[i] == 1.0});
  chart.said = "LC-CUSUM of failures";
  chart.x_label = "attempt";
  chart.y_label = "sum";
  chart.joined = true;
  chart.y_low = 0.0;
  chart.limits = {{*answer.estimate, "limit " + number_text(*answer.estimate, 2)}};
  html.add(series_chart(chart));
  const double at = *further(answer, "reached_at");
  html.raw("<p>");
  if (at > 0.0)
    html.raw("The limit is reached at attempt ")
        .text(number_text(course.x[static_cast<std::size_t>(at) - 1], 0))
        .raw(": from there on failures count as rare. ");
  else
    html.raw("The limit is not reached yet. ");
  html.raw("It stands where of learners who fail ").text(per_cent(rule.inadequate));
  html.raw(" of the time ").text(per_cent(*further(answer, "false_declaration")));
  html.raw(" reach it within ").text(std::to_string(rule.attempts)).raw(" attempts, and of those who fail ");
  html.text(per_cent(rule.adequate)).raw(" of the time ").text(per_cent(*further(answer, "true_declaration")));
  html.raw(".</p>\n");
}

// --- proficiency ------------------------------------------------------------------------------------------------
void add_proficiency(Html& html, const Course& course) {
  const statistics::ProficiencyRule rule;
  const statistics::Answer answer = statistics::proficiency(table_of(course.x, course.passed), rule);
  html.raw("<h3>How probable it is that the learner is proficient</h3>\n");
  if (!answer.estimable()) return say_none(html, answer);
  SeriesChart chart;
  for (std::size_t i = 0; i < answer.rows.size(); ++i)
    chart.points.push_back({course.x[i], answer.rows[i].values[1].value, course.passed[i] == 1.0});
  chart.said = "Probability of being proficient after each attempt";
  chart.x_label = "attempt";
  chart.y_label = "probability";
  chart.joined = true;
  chart.y_low = 0.0;
  chart.y_high = 1.0;
  chart.limits = {{rule.sure, "sure enough: " + number_text(rule.sure, 1)}};
  html.add(series_chart(chart));
  html.raw("<p><strong>").text(number_text(*answer.estimate, 2)).raw("</strong> is the probability that ");
  html.text(per_cent(rule.share)).raw(" or more of attempts pass now: ");
  html.text(number_text(*further(answer, "passes"), 0) + " of the last " +
            number_text(*further(answer, "attempts"), 0));
  html.raw(" passed, so that the share is between ").text(per_cent(*further(answer, "share_low")));
  html.raw(" and ").text(per_cent(*further(answer, "share_high"))).raw(" (95 %). The rule: proficient from ");
  html.text(number_text(rule.sure, 1)).raw(" on, over the last ").text(std::to_string(rule.last));
  html.raw(
      " graded attempts. The curriculum’s own rule, two passes running, is weaker: somebody who passes half of "
      "the time meets it within ");
  html.text(std::to_string(course.x.size())).raw(" attempts with a probability of ");
  html.text(number_text(*further(answer, "two_running_by_half"), 2)).raw(".</p>\n");
}

void add_attempts(Html& html, const LearnerItem& item) {
  html.raw(
      "<details><summary>The attempts as a table</summary>\n<table><thead><tr><th scope=\"col\" "
      "class=\"number\">Attempt</th><th scope=\"col\">When</th><th scope=\"col\">Grade</th>");
  for (const assessment::Criterion& one : item.rule.criteria)
    html.raw("<th scope=\"col\">").text(metric_label(one.metric)).raw("</th>");
  html.raw("</tr></thead><tbody>\n");
  for (std::size_t i = 0; i < item.attempts.size(); ++i) {
    const LearningAttempt& attempt = item.attempts[i];
    html.raw("<tr><td class=\"number\">").text(std::to_string(i + 1)).raw("</td><td>");
    html.text(utc_text(attempt.started_us)).raw("</td><td>").text(verdict_word(attempt.verdict)).raw("</td>");
    for (const assessment::Criterion& one : item.rule.criteria) {
      const assessment::MetricValue* value = assessment::find_version(attempt.metrics, one.metric, one.version);
      html.raw("<td>").text(value == nullptr ? "—" : value_text(*value)).raw("</td>");
    }
    html.raw("</tr>\n");
  }
  html.raw("</tbody></table></details>\n");
}

Html item_section(const LearnerItem& item) {
  const Course course = course_of(item);
  const auto passes = static_cast<std::size_t>(std::count(course.passed.begin(), course.passed.end(), 1.0));
  std::vector<assessment::Verdict> verdicts;
  for (const LearningAttempt& one : item.attempts) verdicts.push_back(one.verdict);
  Html html;
  html.raw("<section class=\"item\">\n<h2>").name(item.title).raw("</h2>\n<p>");
  html.text(of_text(passes, course.x.size())).raw(" graded attempts passed");
  if (item.attempts.size() > course.x.size())
    html.raw("; ").text(std::to_string(item.attempts.size() - course.x.size())).raw(" more are not graded");
  html.raw(". In the curriculum: ");
  html.text(assessment::plain_code(assessment::name_of(assessment::proficiency_of(verdicts)))).raw(".</p>\n");
  add_proficiency(html, course);
  add_cusum(html, course);
  for (const assessment::Criterion& one : item.rule.criteria) {
    const assessment::MetricInfo* info = assessment::find_metric(one.metric);
    if (info != nullptr && std::string_view(info->unit) != "bool") add_curve(html, item, one, *info);
  }
  add_attempts(html, item);
  return html.raw("</section>\n");
}

// What was planted in a simulated learner, to be held against what is found.
Html truth_section(const casedb::SimulatedTruth& truth) {
  namespace population = assessment::population;
  const population::Group group = population::named_group(truth.group).value_or(population::shifted_group(0.0));
  Html html;
  html.raw("<section>\n<h2>What was planted</h2>\n<p>Group ")
      .text(truth.group)
      .raw("; abilities before practice, in ");
  html.raw("standard deviations of the population: ");
  for (std::size_t i = 0; i < population::kAbilities; ++i)
    html.text((i > 0 ? ", " : "") + assessment::plain_code(population::kAbilityNames[i].name) + " " +
              number_text(truth.ability[i], 2));
  html.raw("; towards fast and rough ").text(number_text(truth.strategy, 2)).raw(".");
  const population::Person person = population::drawn_person(group, truth.seed, truth.number);
  html.raw(" Practice closes ").text(per_cent(1.0 - std::exp(-person.practice.rate)));
  html.raw(" of what is left with each attempt, up to a gain of ").text(number_text(person.practice.ceiling, 2));
  html.raw(" standard deviations; half of it is lost in ").text(number_text(person.practice.half_life_days, 0));
  return html.raw(" days without practice.</p>\n</section>\n");
}

}  // namespace

std::string learner_report_page(const LearnerReport& report) {
  Html html;
  html.raw("<h1>").name(report.learner).raw("</h1>\n");
  html.add(made_by(report.made_us, report.program_version, report.whose == casedb::Learners::simulated));
  if (report.items.empty())
    html.raw("<p>There is no attempt yet.</p>\n");
  else
    html.raw(
        "<p class=\"note\">A filled mark is an attempt that passed, a hollow one did not. None of this is a "
        "verdict: it is for the learner and the mentor to talk about.</p>\n");
  if (report.truth) html.add(truth_section(*report.truth));
  for (const LearnerItem& one : report.items) html.add(item_section(one));
  if (!report.items.empty())
    html.raw("<section>\n<h2>What passing one case tells</h2>\n<p>")
        .text(dependability_text(report.dependability, report.whose))
        .raw("</p>\n</section>\n");
  return learning_page(report.learner + " – learning", html);
}

}  // namespace seldinger::reports
