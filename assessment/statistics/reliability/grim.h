// Whether a reported mean, or a mean and its standard deviation, can come from so many whole numbers (GRIM: Brown,
// Heathers, Soc. Psychol. Pers. Sci. 8, 2017; GRIMMER: Anaya, PeerJ Preprints 4:e2400, 2016).
#pragma once

#include <cstddef>
#include <optional>

#include "assessment/statistics/answer.h"

namespace seldinger::assessment::statistics {

// What a paper says of a scale of whole numbers. A person's score is the mean of `items` answers.
struct ReportedScale {
  std::size_t n = 0;
  double mean = 0.0;
  std::size_t mean_decimals = 2;
  std::optional<double> sd = {};  // of n − 1
  std::size_t sd_decimals = 2;
  std::size_t items = 1;
  std::optional<double> low = {}, high = {};  // whole numbers: the ends of the scale
};

// Rounded half up, half down or half to even alike.
bool mean_is_possible(const ReportedScale& reported);

enum class Possible { kNo, kYes, kNotRefuted };
// kNotRefuted: too large to look through; only that a whole sum of squares of the right parity exists was shown.
// Of at least two persons; `sd` is there.
Possible sd_is_possible(const ReportedScale& reported);

Answer grim(const ReportedScale& reported);
Answer grimmer(const ReportedScale& reported);

}  // namespace seldinger::assessment::statistics
