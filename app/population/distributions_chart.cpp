#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/population/distributions.h"
#include "assessment/registry.h"
#include "reports/charts/box_chart.h"

namespace seldinger::app {
namespace {

namespace population = assessment::population;
using population::ReferenceDistribution;

std::string short_figure(double value) {
  char text[32];
  std::snprintf(text, sizeof text, std::abs(value) >= 1000.0 ? "%.0f" : "%.3g", value);
  return text;
}

reports::BoxRow row_of_level(const MetricDistribution& metric, const LevelDistribution& level) {
  reports::BoxRow row;
  row.label = "simulated " + level.level + "s";
  if (level.sorted.size() < 2) {
    row.beside = "no values";
    return row;
  }
  row.centre = level.mean;
  if (metric.yes_or_no) {
    row.beside = short_figure(level.mean);
    return row;
  }
  row.box = level.quantiles;
  row.beside = "median " + short_figure(level.quantiles[2]) + ", mean " + short_figure(level.mean);
  return row;
}

// Sources are numbered as they are met; a note below says which is which.
std::size_t number_of(std::vector<std::string_view>& sources, std::string_view source) {
  const auto found = std::find(sources.begin(), sources.end(), source);
  if (found != sources.end()) return static_cast<std::size_t>(found - sources.begin()) + 1;
  sources.push_back(source);
  return sources.size();
}

reports::BoxRow row_of_published(const ReferenceDistribution& row, std::size_t number) {
  reports::BoxRow made;
  made.reported = true;
  made.label = "[" + std::to_string(number) + "] " + std::string(row.group) + ", n = " + std::to_string(row.n);
  if (row.counted != "people") made.label += " " + std::string(row.counted);
  made.centre = row.value;
  made.spread = population::spread_of(row);
  made.beside = short_figure(row.value);
  if (row.spread == population::Spread::standard_deviation) {
    made.beside += " ± " + short_figure(row.high - row.value);
    made.spread->low = std::max(made.spread->low, 0.0);  // where no value is below it
  } else if (row.spread == population::Spread::quartiles) {
    made.beside += " (" + short_figure(row.low) + " to " + short_figure(row.high) + ")";
  } else if (row.centre != population::Centre::share) {
    made.beside += row.centre == population::Centre::not_told ? "" : std::string(", ") + words(row.centre);
    made.beside += ", no spread reported";
  }
  return made;
}

reports::BoxPanel panel_of(const MetricDistribution& metric, std::vector<std::string_view>& sources) {
  reports::BoxPanel panel;
  panel.title = std::string(assessment::find_metric(metric.metric)->label) + ", " + metric.unit;
  if (metric.unit == "share") {
    panel.low = 0.0;
    panel.high = 1.0;
  }
  for (const LevelDistribution& level : metric.levels) panel.rows.push_back(row_of_level(metric, level));
  const auto published = beside_published(metric);
  for (const BesidePublished& one : published)
    panel.rows.push_back(row_of_published(*one.row, number_of(sources, one.row->source)));
  if (published.empty()) {
    reports::BoxRow& none = panel.rows.emplace_back();
    none.label = "published: none reported in what was read";
    none.reported = true;
  }
  return panel;
}

}  // namespace

std::string svg_of_distributions(const SimulatedDistributions& made) {
  reports::BoxChart chart;
  chart.said =
      "Simulated novices, intermediates and experts in each metric, as boxes, and below them in red what was "
      "published of people at ultrasound-guided punctures.";
  std::vector<std::string_view> sources;
  for (const MetricDistribution& metric : made.metrics) chart.panels.push_back(panel_of(metric, sources));
  chart.notes = {"Simulated (blue), nothing here is about people: first attempts of " +
                     std::to_string(made.people) + " of each level at " + made.case_title + ", drawn from a",
                 "surrogate of " + std::to_string(made.simulated_attempts) +
                     " whole attempts. Box: 25th to 75th percentile; line in it: median; whiskers: 5th and 95th; "
                     "dot: mean; square: share.",
                 "Published (red): square: mean, median or share; whiskers: ± one SD, not below 0, or the "
                 "quartiles. Tasks and "
                 "phantoms are others than ours."};
  for (std::size_t i = 0; i < sources.size(); ++i)
    chart.notes.push_back("[" + std::to_string(i + 1) + "] " + std::string(sources[i]));
  return reports::box_chart(chart).str();
}

}  // namespace seldinger::app
