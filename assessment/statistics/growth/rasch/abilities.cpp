#include "assessment/statistics/growth/rasch/abilities.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "assessment/statistics/roots.h"

namespace seldinger::assessment::statistics {
namespace {

constexpr double kFarthest = 60.0;  // logits

ScoreMoments sums_at(const CellLogs& logs, const std::vector<int>& scores, double ability) {
  ScoreMoments sums;
  for (std::size_t c = 0; c < scores.size(); ++c) {
    if (scores[c] < 0) continue;
    const ScoreMoments one = score_moments(logs[c], ability);
    sums.mean += one.mean;
    sums.variance += one.variance;
    sums.third += one.third;
  }
  return sums;
}

}  // namespace

ScoreMoments score_moments(const std::vector<double>& logs, double ability) {
  double most = 0.0, all = 0.0;
  for (std::size_t h = 0; h < logs.size(); ++h) most = std::max(most, logs[h] + static_cast<double>(h) * ability);
  ScoreMoments moments;
  std::vector<double> shares;
  for (std::size_t h = 0; h < logs.size(); ++h) {
    shares.push_back(std::exp(logs[h] + static_cast<double>(h) * ability - most));
    all += shares.back();
  }
  for (std::size_t h = 0; h < shares.size(); ++h) moments.mean += static_cast<double>(h) * shares[h] / all;
  for (std::size_t h = 0; h < shares.size(); ++h) {
    const double off = static_cast<double>(h) - moments.mean;
    moments.variance += off * off * shares[h] / all;
    moments.third += off * off * off * shares[h] / all;
  }
  return moments;
}

Ability ability_of(const CellLogs& logs, const std::vector<int>& scores) {
  int got = 0, could = 0;
  for (std::size_t c = 0; c < scores.size(); ++c) {
    if (scores[c] < 0) continue;
    got += scores[c];
    could += static_cast<int>(logs[c].size()) - 1;
  }
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  if (could == 0) return {kNan, kNan};
  const bool extreme = got == 0 || got == could;
  const double logits = root_between(-kFarthest, kFarthest, [&](double ability) {
    const ScoreMoments sums = sums_at(logs, scores, ability);
    // Far out, where the variance vanishes, the last term's limit is half the sign of the side.
    const double warm = sums.variance > 1e-250 ? 0.5 * sums.third / sums.variance : (ability < 0.0 ? 0.5 : -0.5);
    return got - sums.mean + (extreme ? warm : 0.0);
  });
  return {logits, 1.0 / std::sqrt(sums_at(logs, scores, logits).variance)};
}

}  // namespace seldinger::assessment::statistics
