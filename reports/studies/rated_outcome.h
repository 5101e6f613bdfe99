// An outcome beside what raters made of the same people: of those who have a value and were rated at its case.
#pragma once

#include "assessment/statistics/answer.h"
#include "assessment/statistics/data_table.h"
#include "assessment/study/analysis.h"
#include "casedb/ratings/rated_people.h"

namespace seldinger::reports {

// The first column: what was measured; x: the mean rating.
assessment::statistics::DataTable with_ratings(const assessment::study::Compared& outcome,
                                               const casedb::RatedPeople& rated);
// Spearman's ρ of these.
assessment::statistics::Answer rank_correlation(const assessment::statistics::DataTable& rated);

}  // namespace seldinger::reports
