// What is lost over a pause: the first value after it against the last one before, a person one value.
#pragma once

#include "assessment/statistics/answer.h"
#include "assessment/statistics/data_table.h"

namespace seldinger::assessment::statistics {

struct DecayOptions {
  double pause = 1.0;  // differences of x that are a pause, from this one up; above 0
  bool higher_is_better = false;
};

// x is when: days. Of each person the mean over their pauses; the loss is above 0 where values are worse after a
// pause. With it how much of a loss goes with a doubling of the pause, where pauses differ.
Answer decay(const DataTable& table, const DecayOptions& options);

}  // namespace seldinger::assessment::statistics
