// What the reports of simulated people find, beside what was planted in them: how hard cases are, how fast a
// learner gets better and up to what, how severe raters are. A table of numbers, each with whether its interval
// holds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "assessment/population/person.h"
#include "assessment/statistics/answer.h"

namespace seldinger::app {

struct PlantedNumber {
  std::string what;
  double planted = 0.0;
  double planted_error = 0.0;  // standard error, where it is itself simulated
  std::optional<double> found;
  std::optional<assessment::statistics::Interval> interval;
  // Whether the interval, widened by what is not known of the planted number, holds it; nothing without an
  // interval.
  std::optional<bool> held() const;
};

struct RecoverySection {
  std::string title, words;
  std::vector<PlantedNumber> numbers;
  std::vector<std::string> refused{};  // what could not be told of what was planted itself, and why
  std::size_t held() const;
  std::size_t with_interval() const;
};

// A simulated learner's course at a metric, and what the same person's attempts are once nothing is left to learn.
struct LearnersCourse {
  std::string learner;  // "novice-3"
  assessment::population::Practice practice;
  std::vector<double> values;            // by attempt, from the first; NaN: none
  std::vector<double> practised_values;  // at the ceiling
};
// Of one metric: each learner's plateau and rate, as the report of a learner finds them. People who do not learn
// have no rate.
RecoverySection plateaus_recovered(const std::string& metric, const std::vector<LearnersCourse>& courses);
RecoverySection rates_recovered(const std::string& metric, const std::vector<LearnersCourse>& courses);
// The mean of all of them at each attempt: rate and plateau of one curve, which one learner's scatter hides.
RecoverySection pooled_recovered(const std::string& metric, const std::vector<LearnersCourse>& courses);

// Severity of sets of raters who rate everybody once, in logits of the many-facet Rasch model; planted is what the
// same model finds of the same raters and of `many` other people.
RecoverySection severities_recovered(const std::vector<assessment::population::Person>& people, std::size_t sets,
                                     std::size_t raters, std::size_t many, std::uint64_t seed);

// Markdown.
std::string text_of_recovery(const std::string& of, const std::vector<RecoverySection>& sections);

}  // namespace seldinger::app
