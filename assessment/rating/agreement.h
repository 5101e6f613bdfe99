// How far raters agree, at any time while they rate: with each other, with themselves and with known scores, how
// severe each is, and whether that drifts.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "assessment/rating/assignment.h"
#include "assessment/statistics/answer.h"

namespace seldinger::assessment::rating {

// A score that a rater gave.
struct Rating {
  std::string rater, view;
  Part part = Part::rated;
  std::size_t number = 0;         // of this rater's ratings, in their order
  double score = 0.0;             // finite
  std::optional<double> known{};  // of the calibration set
};

struct Estimated {
  double value = 0.0;
  statistics::Interval ci95;
};

struct RaterResult {
  std::string rater;
  std::size_t rated = 0;
  // Points that this rater takes off, against the mean of all raters of the same replays; minus: lenient.
  std::optional<Estimated> severity{};
  std::optional<Estimated> drift{};  // points more, from one rating to the tenth after it
  std::size_t calibrated = 0;
  std::optional<double> off_known{};  // mean of what they gave less what is known
  std::size_t repeated = 0;
  std::optional<double> off_self{};  // root of half the mean squared difference: what one rating is wrong by
};

struct Agreement {
  std::size_t ratings = 0;          // without calibration and repeats
  statistics::Answer one, mean;     // ICC of one rating, and of the mean of a replay's
  statistics::Answer kappa;         // of the score's categories, where it has whole ones
  std::vector<RaterResult> raters;  // by name
};

// Of one item, or of a total. Which raters a replay has is not the same for all, so raters are taken as
// interchangeable: one-way, with severity in the error. `each`: as many ratings as a replay gets.
Agreement agreement_of(const std::vector<Rating>& ratings, std::size_t each);

}  // namespace seldinger::assessment::rating
