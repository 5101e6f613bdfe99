#include "reports/studies/study_words.h"
#include "reports/studies/validity_sections.h"
#include "reports/words/metric_words.h"
#include "reports/words/people_words.h"

namespace seldinger::reports {
namespace {

namespace study = assessment::study;

std::string groups_words(const study::PlannedGroup& group, bool arm) {
  if (arm) return group.name + " (ratio " + std::to_string(group.ratio) + ")";
  std::string text = group.name + ": ";
  for (std::size_t i = 0; i < group.facts.size(); ++i) {
    const study::FactCriterion& one = group.facts[i];
    text += (i == 0 ? "" : " and ") + one.fact + " " + std::string(assessment::sign_of(one.comparison)) + " " +
            one.value;
  }
  return text;
}

std::string outcome_words(const ValidityReport& report, const study::Outcome& one) {
  const auto title = report.case_titles.find(one.case_id);
  return one.name + ": " + one.metric + " version " + std::to_string(one.version) + ", at " +
         (title == report.case_titles.end() ? one.case_id : title->second) + ", visit " + one.visit + "; " +
         one.first + " against " + one.second + " by " + test_text(one.test) + "; better is " +
         (one.better == assessment::Direction::lower_is_better ? "lower" : "higher") +
         "; smallest worthwhile difference " + digits_text(one.smallest_worthwhile) +
         (one.failure_value ? "; a failure counts as " + digits_text(*one.failure_value) : std::string());
}

}  // namespace

Html plan_section(const ValidityReport& report) {
  const study::Plan& plan = report.plan.plan;
  Html html;
  html.raw("<section id=\"plan\">\n<h2>9 The plan</h2>\n<table class=\"facts\"><tbody>\n");
  add_fact_row(html, "Whose attempts", whose_attempts_words(plan.people));
  for (const study::PlannedGroup& group : plan.groups)
    add_fact_row(html, plan.randomised ? "Arm" : "Group", groups_words(group, plan.randomised));
  if (plan.randomised) {
    std::string sizes, strata;
    for (const int size : plan.randomisation.block_sizes)
      sizes += (sizes.empty() ? "" : ", ") + std::to_string(size);
    for (const std::string& fact : plan.randomisation.strata) strata += (strata.empty() ? "" : ", ") + fact;
    add_fact_row(html, "Randomisation",
                 "permuted blocks of " + sizes + (strata.empty() ? "" : "; strata by " + strata) +
                     "; a seed drawn at the freeze and kept by the library; concealed until "
                     "enrolment");
  }
  for (const study::Visit& one : plan.visits)
    add_fact_row(
        html, "Visit",
        one.name + ": days " + digits_text(one.from_day) + " to " + digits_text(one.to_day) + " since enrolment");
  for (const study::Outcome& one : plan.primary) add_fact_row(html, "Primary outcome", outcome_words(report, one));
  for (const study::Outcome& one : plan.secondary)
    add_fact_row(html, "Secondary outcome", outcome_words(report, one));
  add_fact_row(html, "Stops at", std::to_string(plan.per_group) + " in each group: " + plan.stopping_rule);
  add_fact_row(html, "Gave up", "by the metric’s own rule: a failure or a censored time, ranked last");
  add_fact_row(
      html, "No attempt",
      (plan.absent == study::Absent::failure ? std::string("counts as a failure: ") : std::string("left out: ")) +
          plan.missing_why);
  if (plan.imputations > 0)
    add_fact_row(html, "Imputed", "absent people, of means, in " + std::to_string(plan.imputations) + " draws");
  for (const study::Outcome& one : plan.primary)
    if (!one.impute_from.empty())
      add_fact_row(html, "Imputed from", "“" + one.name + "” from “" + one.impute_from + "”");
  for (const study::Exclusion& one : plan.exclusions)
    add_fact_row(html, "Attempt left out",
                 one.metric + " " + std::string(assessment::sign_of(one.comparison)) + " " +
                     digits_text(one.value) + ": " + one.why);
  add_fact_row(html, "Hands",
               plan.hands == study::Hands::one ? "one kind; mixed kinds are not analysed"
                                               : "each kind a comparison of its own, all in one family");
  add_fact_row(html, "α", digits_text(plan.alpha) + ", of all primary outcomes together, by Holm");
  return html
      .raw("</tbody></table>\n<details><summary>Canonical JSON, whose SHA-256 is the plan’s</summary>\n<pre>")
      .text(report.plan.body)
      .raw("</pre></details>\n</section>\n");
}

}  // namespace seldinger::reports
