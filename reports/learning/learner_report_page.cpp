#include <cmath>

#include "assessment/grading/plain_words.h"
#include "assessment/grading/progress.h"
#include "assessment/population/person.h"
#include "reports/learning/learner_report.h"
#include "reports/learning/learning_page.h"
#include "reports/words/dependability_words.h"
#include "reports/words/metric_words.h"

namespace seldinger::reports {
namespace {

std::string per_cent(double share) {
  return number_text(100.0 * share, 0) + " %";
}

Html item_section(const LearnerItem& item) {
  std::vector<assessment::Verdict> verdicts;
  for (const casedb::LearningAttempt& one : item.attempts) verdicts.push_back(one.verdict);
  Html html;
  html.raw("<section class=\"learned\">\n<h2>").name(item.title).raw("</h2>\n<p>").text(passed_text(item));
  html.raw(". In the curriculum: ");
  html.text(assessment::plain_code(assessment::name_of(assessment::proficiency_of(verdicts)))).raw(".</p>\n");
  return html.add(learning_charts(item)).raw("</section>\n");
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
    html.raw("<section>\n<h2>")
        .text(kWhatPassingShows)
        .raw("</h2>\n<p>")
        .text(dependability_text(report.dependability, report.whose))
        .raw("</p>\n</section>\n");
  return learning_page(report.learner + " – learning", html);
}

}  // namespace seldinger::reports
