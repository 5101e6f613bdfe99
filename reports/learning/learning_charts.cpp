#include "reports/learning/learning_charts.h"

#include <algorithm>
#include <cmath>

#include "assessment/grading/debrief.h"
#include "assessment/grading/plain_words.h"
#include "assessment/registry.h"
#include "assessment/statistics/growth/cusum_chart.h"
#include "assessment/statistics/growth/learning_curve.h"
#include "assessment/statistics/growth/proficiency.h"
#include "assessment/statistics/reasons.h"
#include "reports/charts/series_chart.h"
#include "reports/studies/study_words.h"
#include "reports/words/grade_words.h"
#include "reports/words/metric_words.h"

namespace seldinger::reports {
namespace {

namespace statistics = assessment::statistics;
using casedb::LearningAttempt;

constexpr int kCurvePoints = 60;
// A standard takes more (assessment/grading/standard.h); a band of fewer would be drawn of persons.
constexpr std::size_t kLeastExpertsDrawn = 5;

std::string share_text(double share) {
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

// Of the graded attempts, in their order: the attempt's number among all, whether it passed, and once they are
// drawn, what the charts show at it.
struct LearnedCourse {
  std::vector<double> x, passed, probability, sum;
};

LearnedCourse learned_course(const LearnerItem& item) {
  LearnedCourse course;
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

// What consultants do, behind the values, as coarsely as it is written; and what says so. Empty: there is no
// standard.
std::string add_expert_band(SeriesChart& chart, const assessment::ExpertSet& experts, std::string_view metric,
                            int version) {
  const std::string words = band_text(experts, metric, version);
  if (words.empty()) return {};
  const assessment::MetricBand& band = *experts.find(metric, version);
  if (band.n < kLeastExpertsDrawn) return {};
  const auto [low, high] = assessment::said_range(band.low, band.high, band.unit);
  chart.band = SeriesBand{low, high, std::to_string(band.n) + " consultants"};
  return "Shaded: " + words + ", from the 10th to the 90th percentile of " + std::to_string(band.n) +
         " consultants.";
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
  // As limits and values are written: a share in per cent, an angle with its sign, a count as itself.
  const std::string_view unit = info.unit;
  chart.y_label = unit == "share" ? "%" : unit == "deg" ? "°" : unit == "count" ? "" : std::string(unit);
  chart.y_shown = unit == "share" ? 100.0 : 1.0;
  chart.y_whole = unit == "count";
  chart.limits = {{criterion.value, assessment::limit_text(criterion, info.unit)}};
  const std::string experts = add_expert_band(chart, item.experts, info.id, criterion.version);
  html.add(series_chart(chart));
  if (!experts.empty()) html.raw("<p class=\"note\">").text(experts).raw("</p>\n");
  if (!answer.estimable()) {
    say_none(html, answer);
  } else if (!learned) {
    const auto& notes = answer.notes;
    const bool sudden = std::find(notes.begin(), notes.end(), statistics::kTooSudden) != notes.end();
    html.raw("<p>").text(sudden ? statistics::kTooSudden : "No learning is seen in these values.").raw("</p>\n");
  } else {
    html.raw("<p>Levels off at ").text(assessment::plain_value(*further(answer, "plateau"), info.unit));
    const auto low = further(answer, "plateau_low"), high = further(answer, "plateau_high");
    if (low && high) html.raw(" (95 % interval ").text(interval_text(statistics::Interval{*low, *high})).raw(")");
    html.raw("; half-way there at attempt ").text(digits_text(*further(answer, "half_way_at")));
    html.raw(", by ").text(answer.method).raw(".</p>\n");
  }
}

// --- LC-CUSUM ---------------------------------------------------------------------------------------------------
void add_cusum(Html& html, LearnedCourse& course) {
  const statistics::CusumRule rule;
  std::vector<double> failed;
  for (const double one : course.passed) failed.push_back(1.0 - one);
  const statistics::Answer answer = statistics::lc_cusum(table_of(course.x, failed), rule);
  html.raw("<h3>Whether failures have become rare (LC-CUSUM)</h3>\n");
  if (!answer.estimable()) return say_none(html, answer);
  SeriesChart chart;
  for (std::size_t i = 0; i < answer.rows.size(); ++i) {
    course.sum.push_back(answer.rows[i].values[1].value);
    chart.points.push_back({course.x[i], course.sum.back(), course.passed[i] == 1.0});
  }
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
  html.raw("It is set so that, of learners who fail ").text(share_text(rule.inadequate));
  html.raw(" of the time ").text(share_text(*further(answer, "false_declaration")));
  html.raw(" reach it within ").text(std::to_string(rule.attempts)).raw(" attempts, and of those who fail ");
  html.text(share_text(rule.adequate)).raw(" of the time ").text(share_text(*further(answer, "true_declaration")));
  html.raw(".</p>\n");
}

// --- proficiency ------------------------------------------------------------------------------------------------
void add_proficiency(Html& html, LearnedCourse& course) {
  const statistics::ProficiencyRule rule;
  const statistics::Answer answer = statistics::proficiency(table_of(course.x, course.passed), rule);
  html.raw("<h3>How probable it is that the learner is proficient</h3>\n");
  if (!answer.estimable()) return say_none(html, answer);
  SeriesChart chart;
  for (std::size_t i = 0; i < answer.rows.size(); ++i) {
    course.probability.push_back(answer.rows[i].values[1].value);
    chart.points.push_back({course.x[i], course.probability.back(), course.passed[i] == 1.0});
  }
  chart.said = "Probability of being proficient after each attempt";
  chart.x_label = "attempt";
  chart.y_label = "probability";
  chart.joined = true;
  chart.y_low = 0.0;
  chart.y_high = 1.0;
  chart.limits = {{rule.sure, "sure enough: " + number_text(rule.sure, 1)}};
  html.add(series_chart(chart));
  html.raw("<p><strong>").text(number_text(*answer.estimate, 2)).raw("</strong> is the probability that ");
  html.text(share_text(rule.share)).raw(" or more of attempts pass now: ");
  html.text(number_text(*further(answer, "passes"), 0) + " of the last " +
            number_text(*further(answer, "attempts"), 0));
  html.raw(" passed, so the share is between ").text(share_text(*further(answer, "share_low")));
  html.raw(" and ").text(share_text(*further(answer, "share_high"))).raw(" (95 %). The rule: proficient from ");
  html.text(number_text(rule.sure, 1)).raw(" on, over the last ").text(std::to_string(rule.last));
  html.raw(" graded attempts.");
  if (course.x.size() < 2) {  // two in a row are yet to be made
    html.raw("</p>\n");
    return;
  }
  html.raw(
      " The curriculum’s own rule, two passes in a row, is weaker: somebody who passes half of the time meets it "
      "within ");
  html.text(std::to_string(course.x.size())).raw(" attempts with a probability of ");
  html.text(number_text(*further(answer, "two_running_by_half"), 2)).raw(".</p>\n");
}

void add_number(Html& html, const std::vector<double>& values, std::size_t at, int digits) {
  html.raw("<td class=\"number\">").text(at < values.size() ? number_text(values[at], digits) : "—").raw("</td>");
}

void add_attempts(Html& html, const LearnerItem& item, const LearnedCourse& course) {
  html.raw(
      "<details class=\"numbers\"><summary>The charts as a table</summary>\n<div "
      "class=\"wide\" tabindex=\"0\" role=\"group\" aria-label=\"The charts as a table\"><table><thead><tr><th "
      "scope=\"col\" class=\"number\">Attempt</th><th scope=\"col\">When</th><th scope=\"col\">Grade</th><th "
      "scope=\"col\" class=\"number\">Probability</th><th scope=\"col\" class=\"number\">LC-CUSUM</th>");
  for (const assessment::Criterion& one : item.rule.criteria)
    html.raw("<th scope=\"col\">").text(metric_label(one.metric)).raw("</th>");
  html.raw("</tr></thead><tbody>\n");
  std::size_t graded = 0;
  for (std::size_t i = 0; i < item.attempts.size(); ++i) {
    const LearningAttempt& attempt = item.attempts[i];
    html.raw("<tr><td class=\"number\">").text(std::to_string(i + 1)).raw("</td><td>");
    html.text(utc_text(attempt.started_us)).raw("</td><td>").text(verdict_word(attempt.verdict)).raw("</td>");
    const std::size_t at = attempt.graded() ? graded++ : course.x.size();
    add_number(html, course.probability, at, 2);
    add_number(html, course.sum, at, 2);
    for (const assessment::Criterion& one : item.rule.criteria) {
      const assessment::MetricValue* value = assessment::find_version(attempt.metrics, one.metric, one.version);
      html.raw("<td>").text(value == nullptr ? "—" : value_text(*value)).raw("</td>");
    }
    html.raw("</tr>\n");
  }
  html.raw("</tbody></table></div></details>\n");
}

}  // namespace

std::string passed_text(const LearnerItem& item) {
  const auto graded =
      std::count_if(item.attempts.begin(), item.attempts.end(), [](const auto& one) { return one.graded(); });
  const auto passed =
      std::count_if(item.attempts.begin(), item.attempts.end(), [](const auto& one) { return one.passed(); });
  std::string text =
      of_text(static_cast<std::size_t>(passed), static_cast<std::size_t>(graded)) + " graded attempts passed";
  if (const std::size_t others = item.attempts.size() - static_cast<std::size_t>(graded); others > 0)
    text += "; " + std::to_string(others) + " more are not graded";
  return text;
}

Html learning_charts(const LearnerItem& item) {
  LearnedCourse course = learned_course(item);
  Html html;
  add_proficiency(html, course);
  add_cusum(html, course);
  for (const assessment::Criterion& one : item.rule.criteria) {
    const assessment::MetricInfo* info = assessment::find_metric(one.metric);
    if (info != nullptr && std::string_view(info->unit) != "bool") add_curve(html, item, one, *info);
  }
  add_attempts(html, item, course);
  return html;
}

}  // namespace seldinger::reports
