// How simulated people of each level spread in a metric, beside what was published of people.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "assessment/population/reference_distributions.h"
#include "assessment/population/surrogate.h"

namespace seldinger::app {

constexpr std::array<double, 5> kDrawnPercentiles{0.05, 0.25, 0.50, 0.75, 0.95};

// Of the first attempts of people of one level. With less than two values only the number of values is told.
struct LevelDistribution {
  std::string level;
  std::vector<double> sorted;         // the values that are not null, ascending
  std::array<double, 5> quantiles{};  // kDrawnPercentiles of them, type 7
  double mean = 0.0, sd = 0.0;
};
struct MetricDistribution {
  std::string metric, unit;
  bool yes_or_no = false;  // whose mean is a share
  std::vector<LevelDistribution> levels;
};
struct SimulatedDistributions {
  std::string case_title;
  std::size_t people = 0;              // of each level
  std::size_t simulated_attempts = 0;  // that the surrogate was fitted to
  std::vector<MetricDistribution> metrics;
};
// Those with a published figure, and what a puncture is about: time, path, accuracy, withdrawals, what was seen.
std::vector<std::string> drawn_metrics();
// Metrics of the registry. Those without a value in any level are left out.
SimulatedDistributions simulated_distributions(const assessment::population::Surrogate& surrogate,
                                               const std::vector<std::string>& metrics, std::size_t people,
                                               std::uint64_t seed);
LevelDistribution distribution_of(std::string level, std::vector<double> values);

// A published figure, and the same figure of the simulated level that it is nearest to.
struct BesidePublished {
  const assessment::population::ReferenceDistribution* row = nullptr;
  double simulated = 0.0;             // mean, median or share, as published; the median where that is not told
  double below = 0.0;                 // which share of that level lies below the published figure, ties half
  std::optional<bool> within_spread;  // the simulated figure, in the published spread; nothing: there is none
};
std::vector<BesidePublished> beside_published(const MetricDistribution& metric);

std::string text_of_distributions(const SimulatedDistributions& made);  // Markdown
std::string svg_of_distributions(const SimulatedDistributions& made);   // an SVG file

}  // namespace seldinger::app
