#include "app/population/distributions.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "assessment/population/person.h"
#include "assessment/registry.h"
#include "assessment/statistics/groups/describe.h"
#include "sim/base/check.h"

namespace seldinger::app {
namespace {

namespace population = assessment::population;
using population::ReferenceDistribution;

constexpr const char* kDrawnLevels[] = {"novice", "intermediate", "expert"};

std::string figure(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  // 1.23e+03 is no way to write 1230.
  if (std::abs(value) >= 1000.0 && std::abs(value) < 1e9) std::snprintf(text, sizeof text, "%.0f", value);
  return text;
}

double figure_of(const LevelDistribution& level, population::Centre centre) {
  const bool a_mean = centre == population::Centre::mean || centre == population::Centre::share;
  return a_mean ? level.mean : level.quantiles[2];
}

}  // namespace

std::vector<std::string> drawn_metrics() {
  return {"time_total",       "time_puncture_to_target", "path_in_tissue",        "path_inefficiency",
          "swept_area",       "tip_target_dist",         "skin_punctures",        "withdrawals_partial",
          "withdrawals_full", "first_pass_success",      "advance_visible_share", "vis_joint"};
}

LevelDistribution distribution_of(std::string level, std::vector<double> values) {
  LevelDistribution made;
  made.level = std::move(level);
  made.sorted = std::move(values);
  std::sort(made.sorted.begin(), made.sorted.end());
  if (made.sorted.size() < 2) return made;
  for (std::size_t q = 0; q < kDrawnPercentiles.size(); ++q)
    made.quantiles[q] = assessment::statistics::quantile_of(made.sorted, kDrawnPercentiles[q]);
  const auto n = static_cast<double>(made.sorted.size());
  made.mean = std::accumulate(made.sorted.begin(), made.sorted.end(), 0.0) / n;
  const double squares = std::accumulate(made.sorted.begin(), made.sorted.end(), 0.0, [&](double sum, double one) {
    return sum + (one - made.mean) * (one - made.mean);
  });
  made.sd = std::sqrt(squares / (n - 1.0));
  return made;
}

SimulatedDistributions simulated_distributions(const population::Surrogate& surrogate,
                                               const std::vector<std::string>& metrics, std::size_t people,
                                               std::uint64_t seed) {
  SimulatedDistributions made{surrogate.mark().case_title, people, surrogate.attempts().size(), {}};
  std::vector<std::size_t> index;
  for (const std::string& metric : metrics) {
    const assessment::MetricInfo* info = assessment::find_metric(metric);
    CHECK(info != nullptr);
    const bool yes_or_no = std::string_view(info->unit) == "bool";
    index.push_back(surrogate.index_of(metric));
    made.metrics.push_back({metric, yes_or_no ? "share" : info->unit, yes_or_no, {}});
  }
  for (const char* level : kDrawnLevels) {
    const auto group = *population::named_group(level);
    std::vector<std::vector<double>> values(metrics.size());
    for (std::size_t number = 1; number <= people; ++number) {
      const auto drawn = surrogate.draw(population::drawn_person(group, seed, number), {1, 0, 0.0});
      for (std::size_t m = 0; m < metrics.size(); ++m)
        if (index[m] < drawn.size() && drawn[index[m]]) values[m].push_back(*drawn[index[m]]);
    }
    for (std::size_t m = 0; m < metrics.size(); ++m)
      made.metrics[m].levels.push_back(distribution_of(level, std::move(values[m])));
  }
  std::erase_if(made.metrics, [](const MetricDistribution& one) {
    return std::all_of(one.levels.begin(), one.levels.end(),
                       [](const LevelDistribution& level) { return level.sorted.size() < 2; });
  });
  return made;
}

std::vector<BesidePublished> beside_published(const MetricDistribution& metric) {
  std::vector<BesidePublished> made;
  for (const ReferenceDistribution& row : population::reference_distributions()) {
    if (row.metric != metric.metric) continue;
    const auto level = std::find_if(metric.levels.begin(), metric.levels.end(),
                                    [&](const LevelDistribution& one) { return one.level == row.level; });
    if (level == metric.levels.end() || level->sorted.size() < 2) continue;
    BesidePublished& one = made.emplace_back();
    one.row = &row;
    one.simulated = figure_of(*level, row.centre);
    const auto [first, last] = std::equal_range(level->sorted.begin(), level->sorted.end(), row.value);
    one.below = (static_cast<double>(first - level->sorted.begin()) + 0.5 * static_cast<double>(last - first)) /
                static_cast<double>(level->sorted.size());
    if (const auto spread = population::spread_of(row))
      one.within_spread = spread->low <= one.simulated && one.simulated <= spread->high;
  }
  return made;
}

namespace {

std::string spread_text(const ReferenceDistribution& row) {
  if (row.spread == population::Spread::standard_deviation) return "± " + figure(row.high - row.value);
  if (row.spread == population::Spread::quartiles) return figure(row.low) + " to " + figure(row.high);
  return "not reported";
}

void add_levels(const SimulatedDistributions& made, std::string& text) {
  text +=
      "| metric | unit | level | values | 5 % | 25 % | 50 % | 75 % | 95 % | mean | SD |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const MetricDistribution& metric : made.metrics)
    for (const LevelDistribution& level : metric.levels) {
      text += "| `" + metric.metric + "` | " + metric.unit + " | " + level.level + " | " +
              std::to_string(level.sorted.size());
      const bool told = level.sorted.size() > 1;
      for (const double quantile : level.quantiles)
        text += " | " + (told && !metric.yes_or_no ? figure(quantile) : "–");
      text += " | " + (told ? figure(level.mean) : "–") + " | " +
              (told && !metric.yes_or_no ? figure(level.sd) : "–") + " |\n";
    }
}

void add_published(const SimulatedDistributions& made, std::string& text) {
  text +=
      "\n| metric | published | of | value | spread | n | simulated | published lies above | "
      "simulated in the spread | what it is of |\n|---|---|---|---|---|---|---|---|---|---|\n";
  std::string without;
  for (const MetricDistribution& metric : made.metrics) {
    const auto published = beside_published(metric);
    if (published.empty()) without += (without.empty() ? "`" : ", `") + metric.metric + "`";
    for (const BesidePublished& one : published) {
      const ReferenceDistribution& row = *one.row;
      const std::string unit = metric.unit == "share" || metric.unit == "count" ? "" : " " + metric.unit;
      char below[32];
      std::snprintf(below, sizeof below, "%.0f %%", 100.0 * one.below);
      text += "| `" + metric.metric + "` | " + std::string(row.source) + " | " + std::string(row.group) + " | " +
              words(row.centre) + " " + figure(row.value) + unit + " | " + spread_text(row) + " | " +
              std::to_string(row.n) + " " + std::string(row.counted) + " | " + figure(one.simulated) + " (" +
              std::string(row.level) + ") | " + (metric.yes_or_no ? "–" : below) + " | " +
              (!one.within_spread   ? "–"
               : *one.within_spread ? "yes"
                                    : "**no**") +
              " | " + std::string(row.how) + " |\n";
    }
  }
  if (!without.empty()) text += "\nOf " + without + " no published distribution was found.\n";
}

}  // namespace

std::string text_of_distributions(const SimulatedDistributions& made) {
  std::string text = "Simulated, nothing here is about people: first attempts of " + std::to_string(made.people) +
                     " people of each level at `" + made.case_title + "`, drawn from a surrogate of " +
                     std::to_string(made.simulated_attempts) + " whole attempts.\n\n";
  add_levels(made, text);
  add_published(made, text);
  std::size_t with_spread = 0, within = 0;
  for (const MetricDistribution& metric : made.metrics)
    for (const BesidePublished& one : beside_published(metric)) {
      with_spread += one.within_spread ? 1U : 0U;
      within += one.within_spread.value_or(false) ? 1U : 0U;
    }
  text +=
      "\nOf " + std::to_string(with_spread) +
      " published distributions with a spread, the figure of the nearest simulated level lies in the spread of " +
      std::to_string(within) + ".\n";
  return text;
}

}  // namespace seldinger::app
