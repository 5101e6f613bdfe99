// A standard from judges who say of each item with what probability somebody just good enough gets it right
// (modified Angoff: Angoff, in Thorndike, Educational Measurement, 1971; Cizek, Bunch, Standard Setting, 2007).
#pragma once

#include <cstddef>
#include <vector>

#include "assessment/statistics/answer.h"
#include "assessment/statistics/complete_table.h"

namespace seldinger::assessment::statistics {

// One round of judging: a row for each item, a column for each judge.
struct AngoffRound {
  double number = 0.0;
  CompleteTable judged;  // shares from 0 to 1
};
// The last round is the answer, all stand in the rows. Interval by t over judges.
Answer angoff(const std::vector<AngoffRound>& rounds);

}  // namespace seldinger::assessment::statistics
