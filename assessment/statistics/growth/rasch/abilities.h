// Where a person stands on the scale of the items, given their difficulties.
#pragma once

#include <vector>

namespace seldinger::assessment::statistics {

struct Ability {
  double logits = 0.0, se = 0.0;
};

// Of a cell, what its scores' probabilities are as at ability 0, in logs, from score 0: `ScoreModel::logs`.
using CellLogs = std::vector<std::vector<double>>;

// Mean, variance and third central moment of a cell's score at an ability.
struct ScoreMoments {
  double mean = 0.0, variance = 0.0, third = 0.0;
};
ScoreMoments score_moments(const std::vector<double>& logs, double ability);

// By maximum likelihood; where the score is the least or the greatest possible, which has none, by Warm's weighted
// likelihood (Psychometrika 54, 1989). `scores` of each cell, −1: none. NaN where there is no cell.
Ability ability_of(const CellLogs& logs, const std::vector<int>& scores);

}  // namespace seldinger::assessment::statistics
