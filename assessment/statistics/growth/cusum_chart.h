// Charts of successes and failures in order: when a learner may be called competent (LC-CUSUM), and when one who
// was competent no longer is (CUSUM). Limits come from the two rates, the attempts and the error that is permitted.
#pragma once

#include <cstddef>

#include "assessment/statistics/answer.h"
#include "assessment/statistics/data_table.h"

namespace seldinger::assessment::statistics {

// Rates of failure, the attempts over which the error counts, and how often it may happen: LC-CUSUM declares an
// inadequate learner competent, CUSUM gives alarm for an adequate one.
struct CusumRule {
  double adequate = 0.10, inadequate = 0.30;
  std::size_t attempts = 50;
  double permitted = 0.10;
};

// What is asked of a rule: 0 < adequate < inadequate < 1, 1 to 2000 attempts, 0 < permitted < 1.
bool sound(const CusumRule& rule);

// Values are 0 (success) and 1 (failure), in the order of x or of the rows; a chart for each person. LC-CUSUM after
// Biau et al., BMC Med. Res. Methodol. 10:103, 2010.
Answer lc_cusum(const DataTable& table, const CusumRule& rule);
Answer cusum(const DataTable& table, const CusumRule& rule);

// Of any values: (value − target) / sd is added up, less half of `shift`, and the limit is the one with which a
// chart without a shift runs `run_length` attempts on average. Higher is worse unless `lower_is_worse`.
struct NormalCusumRule {
  double target = 0.0, sd = 1.0, shift = 1.0, run_length = 500.0;
  bool lower_is_worse = false;
};
bool sound(const NormalCusumRule& rule);
Answer cusum(const DataTable& table, const NormalCusumRule& rule);

}  // namespace seldinger::assessment::statistics
