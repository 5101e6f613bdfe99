#include <algorithm>
#include <cmath>

#include "app/population/effects_text.h"
#include "reports/charts/interval_chart.h"

namespace seldinger::app {

namespace population = assessment::population;

std::string svg_of_effects(const SimulatedEffects& effects) {
  reports::IntervalChart chart;
  chart.alone = true;
  chart.said =
      "Differences between experts and novices: published, filled, with 95 % intervals and what simulated people "
      "would have shown as crosses; below them each metric of simulated people, hollow, largest first.";
  chart.x_label = "difference in standard deviations; of metrics its size";
  for (const population::ReferenceEffect& row : population::reference_effects()) {
    if (row.kind != population::EffectKind::difference) continue;
    reports::IntervalRow& made = chart.rows.emplace_back();
    made.label = row.what;
    made.estimate = row.value;
    made.interval = population::interval95(row);
    made.beside = std::to_string(row.n1) + " and " + std::to_string(row.n2) + " people";
    made.marked = true;
    made.truth = predicted(effects, row);
  }
  const auto first_metric = static_cast<std::ptrdiff_t>(chart.rows.size());
  for (const SimulatedEffect& one : effects.metrics) {
    if (!one.difference) continue;
    reports::IntervalRow& made = chart.rows.emplace_back();
    made.label = one.metric;
    made.estimate = std::abs(*one.difference);
    made.beside = "simulated";
  }
  std::stable_sort(chart.rows.begin() + first_metric, chart.rows.end(),
                   [](const auto& a, const auto& b) { return a.estimate > b.estimate; });
  return reports::interval_chart(chart).str();
}

}  // namespace seldinger::app
