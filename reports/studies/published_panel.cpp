// The study's differences beside those that were published of other simulators, in standard deviations.
#include <cmath>

#include "assessment/population/reference_effects.h"
#include "assessment/statistics/groups/effect_sizes.h"
#include "reports/charts/interval_chart.h"
#include "reports/studies/validity_sections.h"
#include "reports/words/metric_words.h"

namespace seldinger::reports {
namespace {

namespace population = assessment::population;
namespace study = assessment::study;
using assessment::statistics::Interval;

struct StandardisedEffect {
  std::string label;
  double size = 0.0;  // whichever group did better
  std::optional<Interval> interval;
  std::size_t n1 = 0, n2 = 0;
};

// Hedges' g of those who have a value; nothing where it cannot be told.
std::optional<StandardisedEffect> standardised(const study::Compared& one) {
  std::vector<double> first, second;
  for (const study::PersonValue& person : one.people)
    if (person.standing == study::Standing::value)
      (person.group == one.outcome.first ? first : second).push_back(person.value);
  if (!one.refused.empty() || first.size() < 2 || second.size() < 2) return std::nullopt;
  const auto effect = assessment::statistics::hedges_g(first, second);
  if (!std::isfinite(effect.value)) return std::nullopt;
  StandardisedEffect made{one.outcome.name + (one.hand.empty() ? "" : ", hand: " + one.hand),
                          std::abs(effect.value), effect.ci95, first.size(), second.size()};
  if (effect.value < 0.0 && made.interval) made.interval = Interval{-made.interval->high, -made.interval->low};
  return made;
}

std::string two_groups_text(std::size_t n1, std::size_t n2) {
  return std::to_string(n1) + " and " + std::to_string(n2);
}

std::string sizes_text(double size, const std::optional<Interval>& interval) {
  std::string text = number_text(size, 2);
  if (interval) text += " [" + number_text(interval->low, 2) + " to " + number_text(interval->high, 2) + "]";
  return text;
}

void add_size_row(Html& html, std::string_view what, std::string_view source, std::string_view size,
                  std::string_view people, std::string_view likely) {
  html.raw("<tr><th scope=\"row\">").text(what).raw("<span class=\"why\">").text(source).raw("</span></th><td>");
  html.text(size).raw("</td><td>").text(people).raw("</td><td>").text(likely).raw("</td></tr>\n");
}

}  // namespace

Html published_panel(const ValidityReport& report) {
  IntervalChart chart{"Differences of this study and published ones, in standard deviations",
                      "difference in standard deviations, whoever did better",
                      {},
                      {},
                      {}};
  Html rows;
  for (const study::Compared& one : report.result.primary) {
    const auto effect = standardised(one);
    if (!effect) continue;
    const std::string people = two_groups_text(effect->n1, effect->n2);
    chart.rows.push_back({effect->label, effect->size, effect->interval, people, true});
    add_size_row(rows, effect->label, "this study", sizes_text(effect->size, effect->interval), people, "");
  }
  if (chart.rows.empty())
    return no_evidence_yet("Relations to other variables", "Beside published differences",
                           "No primary outcome has a difference in standard deviations.");
  for (const population::ReferenceEffect& one : population::reference_effects()) {
    if (one.kind != population::EffectKind::difference || one.of_answers) continue;
    const std::string people = two_groups_text(one.n1, one.n2);
    const Interval interval = population::interval95(one).value();  // every difference has one
    chart.rows.push_back({std::string(one.what), one.value, interval, people});
    add_size_row(rows, one.what, one.source, sizes_text(one.value, interval), people,
                 one.selected ? number_text(population::unselected(one.value, one.n1, one.n2), 2) : "");
  }
  Html html = evidence_panel("Relations to other variables", "Beside published differences");
  return html.add(interval_chart(chart))
      .raw(
          "<table><thead><tr><th scope=\"col\">Difference</th><th scope=\"col\">Standard deviations, 95 % "
          "interval</th><th scope=\"col\">People</th><th scope=\"col\">Likeliest without "
          "selection</th></tr></thead><tbody>\n")
      .add(rows)
      .raw(
          "</tbody></table>\n<p class=\"note\">Filled: this study, Hedges’ g of those who have a value; those who "
          "failed are not in it. Hollow: other simulators, other metrics and other people, so similarity proves "
          "nothing. What was reported because it was significant is too large; the last column is the likeliest "
          "size allowing for that (Hedges 1984).</p>\n</article>\n");
}

}  // namespace seldinger::reports
