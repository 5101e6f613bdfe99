// Dose and response: groups whose abilities are shifted by a known amount, what of each metric is then true, and
// how often the interval of a study holds that. The truth is never the shift: it is asked of a crowd that the same
// surrogate draws.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "assessment/population/surrogate.h"

namespace seldinger::assessment::population {

struct DoseOptions {
  std::size_t per_group = 30, studies = 2000;
  std::size_t truth_people = 1'000'000;  // of each group
  std::uint64_t seed = 1;
};
// Of one metric at one shift, of those who have a value.
struct MetricResponse {
  double area = 0.5;                       // P(shifted > others) + ½ P(equal) in the crowd
  std::size_t intervals = 0, covered = 0;  // of the studies: with an interval; it holds `area`
  double mean_width = 0.0;                 // of the intervals
  // Shifted minus others in pooled standard deviations, in the crowd, where the metric is normal enough for it in
  // both groups (skewness within ±0.5, excess kurtosis within ±1); else of its logarithm where that is, and no
  // value is 0 or less; else nothing.
  std::optional<double> d;
  bool of_logarithms = false;
  std::size_t d_intervals = 0, d_covered = 0;
  double paired = 0.0;  // Spearman's correlation of people of the same number, kPairs of them
};
struct MetricDose {
  std::string metric;
  std::vector<MetricResponse> responses;  // one for each shift
};
constexpr std::size_t kPairs = 5000;
// Every metric that has a value in the crowd and is not the same in all. Intervals are of the area under the ROC
// curve: the logit of DeLong's (assessment/statistics/relations/discrimination.h); of d the non-central t's.
std::vector<MetricDose> dose_response(const Surrogate& surrogate, std::span<const double> shifts,
                                      const DoseOptions& options);

}  // namespace seldinger::assessment::population
