#include "assessment/statistics/reasons.h"
#include "casedb/people/cohorts.h"
#include "reports/charts/interval_chart.h"
#include "reports/charts/series_chart.h"
#include "reports/learning/case_report.h"
#include "reports/learning/learning_page.h"
#include "reports/studies/study_words.h"
#include "reports/words/dependability_words.h"
#include "reports/words/grade_words.h"
#include "reports/words/metric_words.h"

namespace seldinger::reports {
namespace {

namespace statistics = assessment::statistics;

bool told(const CaseReport& report, std::size_t persons) {
  return report.whose == casedb::Learners::simulated || persons >= static_cast<std::size_t>(casedb::kSmallestCell);
}

std::string rule_text(const assessment::PassRule& rule) {
  std::string text;
  for (const RuleLine& one : rule_lines(rule)) text += (text.empty() ? "" : "; ") + one.metric + ": " + one.bound;
  return text.empty() ? "no pass rule" : text;
}

// The number, and its interval below it.
void add_cell(Html& html, const std::string& number, const std::string& interval) {
  html.raw("<td>").text(number);
  if (!interval.empty()) html.raw("<span class=\"why\">").text(interval).raw("</span>");
  html.raw("</td>");
}

void add_share(Html& html, std::size_t passes, std::size_t persons, const statistics::Interval& interval) {
  add_cell(html, of_text(passes, persons),
           number_text(100.0 * interval.low, 0) + " to " + number_text(100.0 * interval.high, 0) + " %");
}

void add_discrimination(Html& html, const statistics::Answer& answer) {
  if (!answer.estimate)
    return add_cell(html, "–",
                    answer.estimable() ? "" : std::string(statistics::find_reason(answer.reason.c_str())->words));
  add_cell(
      html, number_text(*answer.estimate, 2),
      answer.ci95 ? number_text(answer.ci95->low, 2) + " to " + number_text(answer.ci95->high, 2) : "no interval");
}

void add_charts(Html& html, const CaseReport& report, const std::vector<CaseNumbers>& numbers) {
  IntervalChart easy{
      "Share of persons who pass each case at their first attempt", "passed at the first attempt", {}, 0.0, 1.0};
  IntervalChart apart{
      "How well each case agrees with the others", "correlation with the other cases", {}, -1.0, 1.0};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const CaseNumbers& one = numbers[i];
    if (one.persons == 0 || !told(report, one.persons)) continue;
    const std::string n = "n = " + std::to_string(one.persons);
    easy.rows.push_back({report.cases[i].title,
                         static_cast<double>(one.first_passes) / static_cast<double>(one.persons), one.first, n});
    if (one.discrimination.estimate)
      apart.rows.push_back({report.cases[i].title, *one.discrimination.estimate, one.discrimination.ci95,
                            "n = " + std::to_string(one.discrimination.n)});
  }
  if (!easy.rows.empty())
    html.raw("<h2>Difficulty</h2>\n")
        .add(interval_chart(easy))
        .raw("<p class=\"note\">Left is hard, right is easy. A person counts once.</p>\n");
  if (!apart.rows.empty())
    html.raw("<h2>Discrimination</h2>\n")
        .add(interval_chart(apart))
        .raw(
            "<p class=\"note\">At the right end, those who pass more often here pass more often elsewhere. Around "
            "0 the case measures something other than the rest, or chance.</p>\n");
}

void add_table(Html& html, const CaseReport& report, const std::vector<CaseNumbers>& numbers) {
  html.raw(
      "<h2>Case by case</h2>\n<div class=\"wide\"><table class=\"outcomes numbers\"><thead><tr><th "
      "scope=\"col\">Case and "
      "pass rule</th><th "
      "scope=\"col\" class=\"number\">Attempts</th><th scope=\"col\">Pass at first</th><th "
      "scope=\"col\">Pass at last</th><th scope=\"col\">With the others</th><th scope=\"col\">What to do"
      "</th></tr></thead><tbody>\n");
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const CaseNumbers& one = numbers[i];
    const bool tell = one.persons > 0 && told(report, one.persons);
    html.raw("<tr><th scope=\"row\">").name(report.cases[i].title).raw("<span class=\"why\">");
    html.text(rule_text(report.cases[i].rule)).raw("</span></th><td class=\"number\">");
    html.text(tell ? std::to_string(report.cases[i].attempts.size()) : "–").raw("</td>");
    if (tell) {
      add_share(html, one.first_passes, one.persons, one.first);
      add_share(html, one.last_passes, one.persons, one.last);
      add_discrimination(html, one.discrimination);
    } else {
      html.raw("<td>–</td><td>–</td><td>–</td>");
    }
    html.raw("<td>");
    html.text(advice_text(one)).raw("</td></tr>\n");
  }
  html.raw(
      "</tbody></table></div>\n<p class=\"note\">What to do is a suggestion, by judgement: change or retire a case "
      "that nine in ten pass at the first attempt or that one in ten passes at the last, by the nearer end of the "
      "interval, and one whose correlation with the others stays below 0.2.</p>\n");
}

void add_dependability(Html& html, const CaseReport& report) {
  html.raw("<h2>How many cases a decision takes</h2>\n<p>");
  html.text(dependability_text(report.dependability, report.whose)).raw("</p>\n");
  if (!report.dependability.estimable() || withheld(report.dependability, report.whose)) return;
  SeriesChart chart{"Dependability by the number of cases", "cases", "Φ", {}, true, {}, {{0.8, "0.8"}}, 0.0, 1.0};
  for (const statistics::Row& row : report.dependability.rows) {
    double cases = 0.0, phi = 0.0;
    for (const statistics::Named& one : row.values) {
      if (one.name == "cases") cases = one.value;
      if (one.name == "phi") phi = one.value;
    }
    chart.points.push_back({cases, phi});
  }
  html.add(series_chart(chart));
  for (const std::string& note : report.dependability.notes)
    html.raw("<p class=\"note\">").text(note).raw("</p>\n");
}

void add_planted(Html& html, const CaseReport& report) {
  const statistics::Answer answer = against_planted(report);
  html.raw("<h2>Compared with what was planted</h2>\n<p>");
  if (!answer.estimate) {
    html.raw("Not estimated: ")
        .text(answer.estimable() ? "the values do not differ"
                                 : statistics::find_reason(answer.reason.c_str())->words);
  } else {
    html.raw(
        "Persons’ share of passes follows the abilities that were planted in them, before practice, with a "
        "Spearman’s ρ of ");
    html.text(number_text(*answer.estimate, 2));
    if (answer.ci95)
      html.text(" (95 % interval " + number_text(answer.ci95->low, 2) + " to " + number_text(answer.ci95->high, 2) +
                ")");
    html.raw("; ").text(std::to_string(answer.n)).raw(" persons");
  }
  html.raw(".</p>\n");
}

}  // namespace

std::string case_report_page(const CaseReport& report) {
  const std::vector<CaseNumbers> numbers = case_numbers(report.cases);
  Html html;
  html.raw("<h1>Cases</h1>\n");
  html.add(made_by(report.made_us, report.program_version, report.whose == casedb::Learners::simulated));
  if (report.cases.empty()) return learning_page("Cases", html.raw("<p>There is no attempt yet.</p>\n"));
  add_table(html, report, numbers);
  add_charts(html, report, numbers);
  add_dependability(html, report);
  if (!report.planted.empty()) add_planted(html, report);
  return learning_page("Cases – difficulty and discrimination", html);
}

}  // namespace seldinger::reports
