// When what a missed criterion counts happened, and what it was: where a debrief plays an attempt from.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "assessment/signals/signals.h"

namespace seldinger::assessment {

struct FaultMoment {
  std::string metric;  // whose criteria it may have missed
  double t_s = 0.0;
  std::string words;  // "the skin was punctured"
};

// Of each metric in time, as the metric counts: the second puncture is the second of skin_punctures. What happens
// in no moment, a mean or a length of time, has none.
std::vector<FaultMoment> fault_moments(const Signals& signals);

// The one with which the metric first had more than `at_most` of what it counts, of other metrics the first; null:
// there is none.
const FaultMoment* find_fault(const std::vector<FaultMoment>& faults, const std::string& metric, double at_most);

}  // namespace seldinger::assessment
