// How people did at ultrasound-guided punctures of phantoms and simulators, as it was published: where the values
// of a metric lay and how far they spread, beside which simulated people's are drawn. The tasks are others than
// ours, so nothing is fitted to these rows, and how far simulated people lie from them is told, not judged.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "assessment/statistics/answer.h"

namespace seldinger::assessment::population {

enum class Centre {
  mean,
  median,
  share,     // of attempts or people
  not_told,  // a figure of which what was read does not say what it is
};
enum class Spread {
  none,                // not reported, or not in what was read
  standard_deviation,  // about the mean: low and high are one of them away
  quartiles,
};

struct ReferenceDistribution {
  std::string_view source;  // as it is cited
  std::string_view group;   // who, and at what
  std::string_view metric;  // ours of the same thing, or of the nearest
  std::string_view level;   // novice, intermediate or expert: the simulated people whose experience is nearest
  Centre centre = Centre::mean;
  double value = 0.0;
  Spread spread = Spread::none;
  double low = 0.0, high = 0.0;  // of the spread
  std::string_view unit;         // the metric's own; yes and no as a share
  std::size_t n = 0;
  std::string_view counted;  // what n counts: "people", "in both groups", "attempts of 35 people"
  std::string_view how;      // what the figure is of, and how it was had from the publication's
};
std::span<const ReferenceDistribution> reference_distributions();

// One standard deviation on both sides, or the quartiles; nothing where no spread was reported.
std::optional<statistics::Interval> spread_of(const ReferenceDistribution& row);
const char* words(Centre centre) noexcept;  // "mean"
const char* words(Spread spread) noexcept;  // "SD", "quartiles", "no spread reported"

}  // namespace seldinger::assessment::population
