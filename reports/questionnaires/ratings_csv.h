// What raters said as CSV: a line for each rating, as `seldinger stats` takes it by subject `replay` and rater.
#pragma once

#include <string>

#include "casedb/ratings/rating_rounds.h"

namespace seldinger::reports {

// form, version, form_sha256, round, rater, number, part, replay, attempt, mean, then each item: of a scale as it
// counts, a comment as it was typed. `all`: the calibration set and repeats too.
std::string ratings_csv(const casedb::SentRatings& ratings, bool all);

}  // namespace seldinger::reports
