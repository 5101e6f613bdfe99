// Simulated people answer a questionnaire and simulated raters rate replays, in rounds of a library as people do:
// so that pages, exports and reports have them. Everything of it says that it is simulated.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "casedb/database/library.h"
#include "sim/base/result.h"

namespace seldinger::casedb {

struct SimulatedAnswers {
  std::size_t sent = 0, there = 0;  // sets of answers, or ratings: sent now; were sent before
};
// All or none. Of a questionnaire everybody simulated who is enrolled in the round's study answers the items on
// scales, under their pseudonym. Of a round of ratings each rater is drawn by the seed, with a severity, halo and
// drift, and sends every rating (assessment/population/raters.h). What was sent before stays. `no_round`,
// `round_closed`, `nobody_simulated` (the study has no simulated people, or a replay is another one's),
// `round_in_use` (people rate in this round), and as begin_response.
base::Result<SimulatedAnswers> simulate_answers(Library& library, const std::string& code, std::uint64_t seed);

}  // namespace seldinger::casedb
