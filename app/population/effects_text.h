// How groups of simulated people differ in each metric, beside what was published of people.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "assessment/population/reference_effects.h"
#include "assessment/population/surrogate.h"

namespace seldinger::app {

struct SimulatedEffect {
  std::string metric;
  std::size_t values = 0;              // of both groups, of those that are not null
  std::optional<double> difference{};  // in pooled standard deviations, experts minus novices
  std::optional<double> area{};        // P(expert's > novice's) + ½ P(equal)
  // Means of novices: of their first attempts, and of attempts after kPractised others on one day; and of experts'
  // first.
  std::optional<double> novices{}, practised{}, experts{};
};
constexpr std::size_t kPractised = 20;
struct SimulatedEffects {
  std::string case_title;
  std::size_t people = 0;                // in each group
  double practice_gain = 0.0;            // of ability by kPractised attempts on one day, mean of novices
  std::vector<SimulatedEffect> metrics;  // of everybody's first attempt
  std::vector<SimulatedEffect> of_two;   // the same metrics, of the mean of everybody's first two on one day
  std::vector<SimulatedEffect> answers;  // one for each of statements()
};
SimulatedEffects simulated_effects(const assessment::population::Surrogate& surrogate, std::size_t people,
                                   std::uint64_t seed);
std::string text_of_effects(const SimulatedEffects& effects);  // Markdown
// Published differences with their intervals, what such people would have shown, and every metric's, as an SVG
// file.
std::string svg_of_effects(const SimulatedEffects& effects);

// What such people would have shown in the published study, where that is simulated.
std::optional<double> predicted(const SimulatedEffects& effects,
                                const assessment::population::ReferenceEffect& row);
// Whether that lies within .15 of what was published, or within its 95 % interval; nothing: it is not simulated.
std::optional<bool> is_within(const SimulatedEffects& effects, const assessment::population::ReferenceEffect& row);
const char* kind_text(assessment::population::EffectKind kind);

}  // namespace seldinger::app
