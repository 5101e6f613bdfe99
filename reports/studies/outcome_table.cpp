#include "reports/studies/outcome_table.h"

#include <algorithm>
#include <string>

#include "assessment/registry.h"
#include "reports/studies/forest_plot.h"
#include "reports/studies/study_words.h"
#include "reports/words/metric_words.h"

namespace seldinger::reports {
namespace {

namespace study = assessment::study;

std::string title_of(const study::Compared& one) {
  return one.outcome.name + (one.hand.empty() ? "" : ", hand: " + one.hand);
}

std::string unit_of(const study::Compared& one) {
  const assessment::MetricInfo* info = assessment::find_metric(one.outcome.metric);
  const std::string unit = info == nullptr ? "" : info->unit;
  return unit == "bool" ? "(share)" : unit == "count" || unit == "share" ? "" : unit;
}

std::string effect_words(const study::Compared& one) {
  if (!one.refused.empty() || !one.answer.estimate) return "–";
  const bool in_unit = one.outcome.test != study::Test::brunner_munzel;
  const std::string unit = in_unit && !unit_of(one).empty() ? " " + unit_of(one) : "";
  return one.answer.estimate_name + " = " + digits_text(*one.answer.estimate) + unit + "; 95 % " +
         interval_text(one.answer.ci95);
}

bool is_drawn(const study::Compared& one) {
  return one.refused.empty() && one.answer.estimate.has_value();
}

bool is_probability(const study::Compared& one) {
  return one.outcome.test == study::Test::brunner_munzel;
}

void add_effect(Html& html, const study::Compared& one) {
  const std::string words = effect_words(one);
  if (is_drawn(one)) {
    const bool probability = is_probability(one);
    ForestRow row{.estimate = *one.answer.estimate,
                  .interval = one.answer.ci95,
                  .nothing = probability ? 0.5 : 0.0,
                  .worthwhile = {},
                  .bounds = {}};
    if (probability)
      row.bounds = assessment::statistics::Interval{0.0, 1.0};
    else
      row.worthwhile = one.outcome.smallest_worthwhile;
    html.add(forest_plot(row, title_of(one) + ": " + words));
  }
  html.raw("<span class=\"effect\">").text(words).raw("</span>");
  if (const auto delta = further(one.answer, "cliff_delta"); delta && one.refused.empty())
    html.raw(" <span class=\"why\">Cliff’s δ = ").text(digits_text(*delta)).raw("</span>");
}

}  // namespace

bool draws_worthwhile(const std::vector<study::Compared>& outcomes) {
  return std::any_of(outcomes.begin(), outcomes.end(),
                     [](const study::Compared& one) { return is_drawn(one) && !is_probability(one); });
}

Html outcome_table(const std::vector<study::Compared>& outcomes, double alpha, bool confirmatory,
                   std::string_view caption) {
  Html html;
  html.raw("<table class=\"outcomes\"><caption>").text(caption);
  html.raw(
      "</caption>\n<thead><tr><th scope=\"col\">Outcome</th><th scope=\"col\">Groups</th><th scope=\"col\">"
      "Effect, 95 % interval</th>");
  if (confirmatory)
    html.raw("<th scope=\"col\" class=\"number\">p</th><th scope=\"col\" class=\"number\">p, Holm</th>");
  html.raw("<th scope=\"col\">Would have been found</th></tr></thead>\n<tbody>\n");
  for (const study::Compared& one : outcomes) {
    html.raw("<tr><th scope=\"row\">").text(title_of(one)).raw("<span class=\"why\">");
    html.text(metric_label(one.outcome.metric)).raw(" (<code>").text(one.outcome.metric).raw("</code>, version ");
    html.text(std::to_string(one.outcome.version)).raw("), visit ").text(one.outcome.visit).raw(". ");
    html.text(one.answer.method.empty() ? test_text(one.outcome.test) : one.answer.method);
    html.raw(". Better is ")
        .text(one.outcome.better == assessment::Direction::lower_is_better ? "lower" : "higher");
    html.raw(".</span></th><td>");
    for (const study::GroupSum* sum : {&one.first, &one.second})
      html.raw("<p><strong>")
          .text(sum->name.empty() ? "?" : sum->name)
          .raw("</strong>: ")
          .text(group_text(*sum, unit_of(one)))
          .raw("</p>");
    html.raw("</td><td>");
    add_effect(html, one);
    html.raw("</td>");
    if (confirmatory)
      html.raw("<td class=\"number\">")
          .text(p_text(one.refused.empty() ? one.answer.p_value : std::nullopt))
          .raw("</td><td class=\"number\">")
          .text(p_text(one.p_adjusted))
          .raw("</td>");
    html.raw("<td>").text(detectable_text(one)).raw("</td></tr>\n");
    if (confirmatory) {
      html.raw("<tr class=\"verdict-row\"><td colspan=\"6\">").text(verdict_text(one, alpha));
    } else if (!one.refused.empty() || !one.answer.estimable()) {
      html.raw("<tr class=\"verdict-row\"><td colspan=\"4\">").text(verdict_text(one, alpha));
    } else {
      continue;
    }
    for (const std::string& note : one.answer.notes)
      if (!note.starts_with("Not significant")) html.raw(" <span class=\"why\">").text(note).raw("</span>");
    html.raw("</td></tr>\n");
  }
  return html.raw("</tbody></table>\n");
}

Html sensitivity_table(const std::vector<study::Compared>& outcomes) {
  Html html;
  bool any = false;
  for (const study::Compared& one : outcomes)
    for (const study::Sensitivity& other : one.sensitivity) {
      if (!any)
        html.raw(
            "<table class=\"outcomes\"><caption>The same comparisons under other rules for what is missing, and "
            "per protocol; the conclusion rests on the plan’s rule, and p here is not "
            "adjusted</caption>\n<thead><tr><th scope=\"col\">Outcome</th><th scope=\"col\">Rule</th><th "
            "scope=\"col\">Effect, 95 % interval</th><th scope=\"col\" class=\"number\">p</th><th scope=\"col\" "
            "class=\"number\">n</th></tr></thead>\n<tbody>\n");
      any = true;
      html.raw("<tr><th scope=\"row\">").text(title_of(one)).raw("</th><td>").text(other.rule);
      if (other.shift) html.text(" (by " + digits_text(*other.shift) + " " + unit_of(one) + ")");
      html.raw("</td><td>");
      html.text(other.answer.estimate
                    ? digits_text(*other.answer.estimate) + "; 95 % " + interval_text(other.answer.ci95)
                    : std::string("not estimable"));
      html.raw("</td><td class=\"number\">").text(p_text(other.answer.p_value)).raw("</td><td class=\"number\">");
      html.text(std::to_string(other.answer.n)).raw("</td></tr>\n");
    }
  if (any) html.raw("</tbody></table>\n");
  return html;
}

}  // namespace seldinger::reports
