// Analysis of variance of a full table of scores, subjects by raters, one score a cell: where the variance of the
// scores comes from.
#pragma once

#include <cstddef>

#include "assessment/statistics/complete_table.h"

namespace seldinger::assessment::statistics {

struct TwoWay {
  double n = 0.0, k = 0.0;  // subjects, raters
  double mean = 0.0;
  double ms_subjects = 0.0, ms_raters = 0.0, ms_error = 0.0;
  double ms_within = 0.0;    // raters and error together: of a subject's scores about their mean
  double sd = 0.0;           // of all scores
  double sd_of_means = 0.0;  // of the subjects' means
};
// Of a table of at least two subjects and two raters.
TwoWay two_way(const CompleteTable& table);

}  // namespace seldinger::assessment::statistics
