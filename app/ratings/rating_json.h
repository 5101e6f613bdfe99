// What the commands about ratings answer.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "assessment/rating/agreement.h"
#include "casedb/ratings/rating_rounds.h"
#include "casedb/ratings/simulated_answers.h"

namespace seldinger::app {

// Of the mean and of each item on a scale.
using Agreements = std::vector<std::pair<std::string, assessment::rating::Agreement>>;

std::string json_of_opened(const casedb::OpenedRatingRound& opened, std::size_t replays, std::size_t calibration);
std::string json_of_simulated(const casedb::SimulatedAnswers& made);
std::string json_of_agreements(const casedb::SentRatings& ratings, const Agreements& agreements);

}  // namespace seldinger::app
