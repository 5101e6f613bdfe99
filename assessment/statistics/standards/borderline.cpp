#include "assessment/statistics/standards/borderline.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "assessment/statistics/percentile_bootstrap.h"
#include "assessment/statistics/spread.h"
#include "assessment/statistics/standards/cut_notes.h"

namespace seldinger::assessment::statistics {
namespace {

constexpr std::size_t kLeastPersons = 5;

struct Line {
  double cut = 0.0, slope = 0.0, r = 0.0, residual_sd = 0.0;
};

// Nothing: all have the same rating.
std::optional<Line> line_at(const std::vector<double>& score, const std::vector<double>& rating,
                            double borderline) {
  const Spread y = spread_of(score), x = spread_of(rating);
  if (!(x.variance > 0.0)) return std::nullopt;
  const double n = static_cast<double>(score.size());
  double together = 0.0;
  for (std::size_t i = 0; i < score.size(); ++i) together += (score[i] - y.mean) * (rating[i] - x.mean);
  Line line;
  line.slope = together / ((n - 1.0) * x.variance);
  line.cut = y.mean + line.slope * (borderline - x.mean);
  line.r = y.variance > 0.0 ? together / (n - 1.0) / std::sqrt(x.variance) / std::sqrt(y.variance) : 0.0;
  line.residual_sd = std::sqrt(std::max(0.0, (1.0 - line.r * line.r) * y.variance * (n - 1.0) / (n - 2.0)));
  return line;
}

std::vector<double> borderline_scores(const std::vector<double>& score, const std::vector<double>& rating,
                                      double borderline) {
  std::vector<double> found;
  for (std::size_t i = 0; i < score.size(); ++i)
    if (rating[i] == borderline) found.push_back(score[i]);
  return found;
}

// NaN where the method has no cut.
double cut_of(const std::vector<double>& score, const std::vector<double>& rating, double borderline,
              BorderlineMethod method) {
  if (method == BorderlineMethod::kRegression) {
    const std::optional<Line> line = line_at(score, rating, borderline);
    return line ? line->cut : std::nan("");
  }
  const std::vector<double> group = borderline_scores(score, rating, borderline);
  return group.empty() ? std::nan("") : spread_of(group).mean;
}

Bootstrapped drawn_cuts(const RatedScores& rated, BorderlineMethod method, std::size_t draws, std::uint64_t seed) {
  const std::size_t persons = rated.score.size();
  return percentile_bootstrap({&persons, 1}, draws, seed, [&](const Draw& draw) {
    std::vector<double> score, rating;
    for (const std::size_t person : draw.front()) {
      score.push_back(rated.score[person]);
      rating.push_back(rated.rating[person]);
    }
    return cut_of(score, rating, rated.borderline, method);
  });
}

Answer refused_ratings(const RatedScores& rated, const char* reason, const char* note) {
  Answer answer = not_estimable("borderline", reason, rated.score.size());
  answer.missing = rated.missing;
  if (note != nullptr) answer.notes.emplace_back(note);
  return answer;
}

void note_ratings(Answer& answer, const RatedScores& rated, const Line& line) {
  const auto [lowest, highest] = std::minmax_element(rated.rating.begin(), rated.rating.end());
  if (rated.borderline < *lowest || rated.borderline > *highest)
    answer.notes.emplace_back(
        "Nobody's rating is as low or high as the borderline: the line goes beyond what was seen.");
  if (line.r * line.r < 0.25)
    answer.notes.emplace_back(
        "Ratings explain less than a quarter of the scores' variance: the cut is poorly founded.");
}

}  // namespace

Answer borderline(const RatedScores& rated, BorderlineMethod method, std::size_t draws, std::uint64_t seed) {
  if (rated.score.size() < kLeastPersons) return refused_ratings(rated, "too_few", "A cut needs five persons.");
  const Spread score = spread_of(rated.score), rating = spread_of(rated.rating);
  if (!score.computable || !rating.computable || !std::isfinite(rated.borderline))
    return refused_ratings(rated, "no_finite_answer", nullptr);
  const bool by_group = method == BorderlineMethod::kGroup;
  const std::size_t in_group = borderline_scores(rated.score, rated.rating, rated.borderline).size();
  const std::optional<Line> line = line_at(rated.score, rated.rating, rated.borderline);
  if (by_group && in_group < kLeastPersons)
    return refused_ratings(rated, "group_too_small", "A cut needs five persons with the borderline rating.");
  if (!by_group && !line) return refused_ratings(rated, "no_variation", "All persons have the same rating.");
  Answer answer;
  answer.test = "borderline";
  answer.method = by_group
                      ? "Borderline group: mean score of the persons with the borderline rating"
                      : "Borderline regression: score on the line through all persons at the borderline rating";
  answer.n = rated.score.size();
  answer.missing = rated.missing;
  answer.estimate = cut_of(rated.score, rated.rating, rated.borderline, method);
  answer.estimate_name = "cut";
  answer.more = {{"borderline", rated.borderline}, {"in_borderline_group", static_cast<double>(in_group)}};
  if (line) {
    answer.more.push_back({"slope", line->slope});
    answer.more.push_back({"r_squared", line->r * line->r});
    answer.more.push_back({"residual_sd", line->residual_sd});
    if (!by_group) note_ratings(answer, rated, *line);
  }
  for (const auto& [name, one, enough] :
       {std::tuple("regression", BorderlineMethod::kRegression, line.has_value()),
        std::tuple("group", BorderlineMethod::kGroup, in_group >= kLeastPersons)}) {
    if (!enough) continue;
    const Bootstrapped drawn = drawn_cuts(rated, one, draws, seed);
    Row row{name, {{"cut", cut_of(rated.score, rated.rating, rated.borderline, one)}}};
    if (drawn.ci95) {
      row.values.push_back({"ci95_low", drawn.ci95->low});
      row.values.push_back({"ci95_high", drawn.ci95->high});
    }
    answer.rows.push_back(std::move(row));
    if (one == method) say_of_draws(answer, drawn);
  }
  return settled(std::move(answer));
}

}  // namespace seldinger::assessment::statistics
