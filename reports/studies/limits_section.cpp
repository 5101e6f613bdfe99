#include <algorithm>
#include <set>

#include "reports/studies/study_words.h"
#include "reports/studies/validity_sections.h"
#include "reports/words/metric_words.h"

namespace seldinger::reports {
namespace {

namespace study = assessment::study;

struct Question {
  std::string asked, answered;
};

std::size_t failures_of(const study::Compared& one) {
  return one.first.failures + one.first.censored + one.second.failures + one.second.censored;
}

std::vector<Question> questions_of(const ValidityReport& report) {
  const study::Plan& plan = report.plan.plan;
  std::vector<Question> all;
  all.push_back({"Was the plan made before the data were seen?",
                 "It was frozen on " + utc_text(*report.plan.frozen_us) + " with the hash below; " +
                     (report.looks.size() == 1 ? std::string("this report is the only look since then.")
                                               : std::to_string(report.looks.size()) +
                                                     " looks since then are listed, this report among them.")});
  all.push_back({"How was the number of people chosen?",
                 std::to_string(plan.per_group) + " in each group: " + plan.stopping_rule});
  all.push_back({"Are attempts counted as if they were people?",
                 "No: each person is one value, by the metric’s own rule; the tests refuse a person twice."});
  for (const study::Compared& one : report.result.primary) {
    if (!one.refused.empty()) continue;
    const std::string& name = one.outcome.name;
    if (const std::size_t failed = failures_of(one); failed > 0)
      all.push_back(
          {name + ": what became of those who failed?",
           std::to_string(failed) + " neither fired nor deferred; they " +
               (one.outcome.test == study::Test::welch ? "count as the plan’s failure value." : "rank last.") +
               " Without them: see the table of other rules."});
    if (const std::size_t absent = one.first.absent + one.second.absent; absent > 0)
      all.push_back({name + ": what of those who made no attempt?",
                     std::to_string(absent) + ", " +
                         (plan.absent == study::Absent::failure ? "counted as failures: " : "left out: ") +
                         plan.missing_why + " Best and worst cases: see the table of other rules."});
    const std::size_t n1 = one.first.persons - one.first.absent, n2 = one.second.persons - one.second.absent;
    if (n1 != n2 && std::min(n1, n2) > 0 && std::max(n1, n2) >= 2 * std::min(n1, n2))
      all.push_back({name + ": are the groups equal in size?", std::to_string(n1) + " and " + std::to_string(n2) +
                                                                   ": the smaller one limits what can be found."});
    if (one.p_adjusted && *one.p_adjusted > plan.alpha)
      all.push_back({name + ": could the study have found a difference at all?",
                     "One of this size or more, with 80 % power: " + detectable_text(one) + "."});
    if (one.answer.estimate && !one.answer.ci95)
      all.push_back({name + ": why is there no interval?", one.answer.notes.empty()
                                                               ? "The procedure gives none for these data."
                                                               : one.answer.notes.front()});
  }
  if (report.result.primary.size() > 1)
    all.push_back(
        {"Why not one test for each outcome?", "Holm’s method keeps the chance of any false conclusion among the " +
                                                   std::to_string(report.result.primary.size()) +
                                                   " primary ones at " + digits_text(plan.alpha) + "."});
  all.push_back({"Was anybody blinded?",
                 plan.randomised
                     ? "Nobody learned the next allocation before the person was enrolled. Who practised knew "
                       "their arm; the measuring program does not know it."
                     : "Groups are what people are, so they know them; the measuring program does not."});
  if (!report.deviations.empty())
    all.push_back({"Was the plan kept?",
                   report.deviations.size() == 1
                       ? std::string("One deviation is listed in section 7.")
                       : std::to_string(report.deviations.size()) + " deviations are listed in section 7."});
  return all;
}

}  // namespace

Html limits_section(const ValidityReport& report) {
  const study::Plan& plan = report.plan.plan;
  Html html;
  html.raw("<section id=\"limits\">\n<h2>5 What the data cannot say</h2>\n<ul>\n");
  if (plan.people == study::People::simulated)
    html.raw(
        "<li>Anything about people: every attempt was made by a simulated operator. The report shows that the "
        "procedure works, nothing else.</li>\n");
  if (!plan.randomised)
    html.raw(
        "<li>That experience causes the difference: people were not assigned to their groups by chance, and groups "
        "differ in more than what separates them.</li>\n");
  html.raw(
      "<li>That a person of either group does well with patients: nobody was observed there.</li>\n<li>That those "
      "who score well are competent: groups that differ show that the metric is related to what separates them; "
      "where to draw a line is another study.</li>\n<li>That a metric is valid for another use, another case or "
      "another hand than those named here.</li>\n");
  if (report.plan.frozen())
    for (const study::Compared& one : report.result.primary)
      if (one.refused.empty() &&
          (one.first.attempts < 2 * one.first.persons || one.second.attempts < 2 * one.second.persons)) {
        html.raw("<li>")
            .text(one.outcome.name)
            .raw(": how much of a person’s value belongs to that day: most made fewer than two attempts.</li>\n");
        break;
      }
  return html.raw("</ul>\n</section>\n");
}

Html reviewer_section(const ValidityReport& report) {
  Html html;
  html.raw("<section id=\"reviewer\">\n<h2>6 What a reviewer will ask</h2>\n");
  if (!report.plan.frozen())
    return html.raw("<p>First of all: when was the plan frozen? It is not yet.</p>\n</section>\n");
  html.raw("<dl class=\"questions\">\n");
  for (const Question& one : questions_of(report))
    html.raw("<dt>").text(one.asked).raw("</dt><dd>").text(one.answered).raw("</dd>\n");
  return html.raw("</dl>\n</section>\n");
}

}  // namespace seldinger::reports
