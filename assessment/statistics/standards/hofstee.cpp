#include "assessment/statistics/standards/hofstee.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "assessment/statistics/percentile_bootstrap.h"
#include "assessment/statistics/spread.h"
#include "assessment/statistics/standards/cut_notes.h"

namespace seldinger::assessment::statistics {
namespace {

constexpr std::size_t kFewestPersons = 5;

std::size_t judges_of(const HofsteeLimits& limits) {
  return std::max({limits.cut_low.size(), limits.cut_high.size(), limits.fail_low.size(), limits.fail_high.size()});
}

double mean_over(const std::vector<double>& of_judges, const std::vector<std::size_t>& judges) {
  if (of_judges.size() == 1) return of_judges.front();
  double sum = 0.0;
  for (const std::size_t judge : judges) sum += of_judges[judge];
  return sum / static_cast<double>(judges.size());
}

HofsteeCorners corners_of(const HofsteeLimits& limits, const std::vector<std::size_t>& judges) {
  return {mean_over(limits.cut_low, judges), mean_over(limits.cut_high, judges), mean_over(limits.fail_low, judges),
          mean_over(limits.fail_high, judges)};
}

bool is_box(const HofsteeCorners& corners) {
  return corners.cut_low < corners.cut_high && 0.0 <= corners.fail_low && corners.fail_low < corners.fail_high &&
         corners.fail_high <= 1.0;
}

bool are_limits(const HofsteeLimits& limits) {
  const std::size_t judges = judges_of(limits);
  for (const auto* one : {&limits.cut_low, &limits.cut_high, &limits.fail_low, &limits.fail_high})
    if (one->empty() || (one->size() != 1 && one->size() != judges)) return false;
  return true;
}

// Where low scores are the better ones, everything stands on its head.
void turn_over(std::vector<double>& scores, HofsteeLimits& limits) {
  for (auto* numbers : {&scores, &limits.cut_low, &limits.cut_high})
    for (double& number : *numbers) number = -number;
  std::swap(limits.cut_low, limits.cut_high);
}

Answer refused_scores(const std::vector<double>& scores, std::size_t missing, const char* reason,
                      const char* note) {
  Answer answer = not_estimable("hofstee", reason, scores.size());
  answer.missing = missing;
  if (note != nullptr) answer.notes.emplace_back(note);
  return answer;
}

Bootstrapped drawn_again(const std::vector<double>& scores, const HofsteeLimits& limits, double sign,
                         std::size_t draws, std::uint64_t seed) {
  const std::array sizes = {scores.size(), judges_of(limits)};
  return percentile_bootstrap(sizes, draws, seed, [&](const Draw& draw) {
    std::vector<double> drawn;
    for (const std::size_t person : draw[0]) drawn.push_back(scores[person]);
    std::sort(drawn.begin(), drawn.end());
    const HofsteeCorners corners = corners_of(limits, draw[1]);
    const std::optional<double> cut = is_box(corners) ? hofstee_cut(drawn, corners) : std::nullopt;
    return cut ? sign * *cut : std::nan("");
  });
}

}  // namespace

std::optional<double> hofstee_cut(const std::vector<double>& scores, const HofsteeCorners& corners) {
  const double width = corners.cut_high - corners.cut_low, height = corners.fail_high - corners.fail_low;
  const auto line = [&](double cut) { return corners.fail_high - (cut - corners.cut_low) / width * height; };
  const auto cut_at = [&](double fail) { return corners.cut_low + (corners.fail_high - fail) / height * width; };
  const auto inside = [&](double cut) {
    return corners.cut_low <= cut && cut <= corners.cut_high ? std::optional(cut) : std::nullopt;
  };
  const double n = static_cast<double>(scores.size());
  // The share that fails is flat up to a score, and jumps just above it.
  double below = 0.0;
  for (std::size_t i = 0; i < scores.size();) {
    const double score = scores[i];
    if (const double cut = cut_at(below); cut <= score) return inside(cut);
    while (i < scores.size() && scores[i] == score) ++i;
    below = static_cast<double>(i) / n;
    if (line(score) <= below) return inside(score);
  }
  return inside(cut_at(1.0));
}

Answer hofstee(std::vector<double> scores, std::size_t missing, const HofsteeLimits& asked, bool higher_is_better,
               std::size_t draws, std::uint64_t seed) {
  if (scores.size() < kFewestPersons)
    return refused_scores(scores, missing, "too_few", "A cut needs five persons.");
  if (!spread_of(scores).computable) return refused_scores(scores, missing, "no_finite_answer", nullptr);
  if (!are_limits(asked))
    return refused_scores(scores, missing, "bad_value", "Each limit is one number, or one for each judge.");
  HofsteeLimits limits = asked;
  if (!higher_is_better) turn_over(scores, limits);
  const double sign = higher_is_better ? 1.0 : -1.0;
  std::vector<std::size_t> judges(judges_of(limits));
  for (std::size_t i = 0; i < judges.size(); ++i) judges[i] = i;
  const HofsteeCorners corners = corners_of(limits, judges);
  if (!is_box(corners))
    return refused_scores(scores, missing, "bad_value",
                          "The lower limits have to be below the upper ones, and shares lie from 0 to 1.");
  std::sort(scores.begin(), scores.end());
  const std::optional<double> cut = hofstee_cut(scores, corners);
  if (!cut)
    return refused_scores(
        scores, missing, "no_solution",
        "At no accepted cut does an accepted share of the persons fail: the judges have to look again.");
  const auto failing = std::lower_bound(scores.begin(), scores.end(), *cut) - scores.begin();
  Answer answer;
  answer.test = "hofstee";
  answer.method = "Hofstee: where the judges' line meets the share of persons that fail";
  answer.n = scores.size();
  answer.missing = missing;
  answer.estimate = sign * *cut;
  answer.estimate_name = higher_is_better ? "cut (that or more passes)" : "cut (that or less passes)";
  answer.more = {{"fail_share", static_cast<double>(failing) / static_cast<double>(scores.size())},
                 {"judges", static_cast<double>(judges.size())},
                 {"cut_low", higher_is_better ? corners.cut_low : -corners.cut_high},
                 {"cut_high", higher_is_better ? corners.cut_high : -corners.cut_low},
                 {"fail_low", corners.fail_low},
                 {"fail_high", corners.fail_high}};
  say_of_draws(answer, drawn_again(scores, limits, sign, draws, seed));
  if (draws > 0 && judges.size() > 1) answer.method += " and judges";
  return settled(std::move(answer));
}

}  // namespace seldinger::assessment::statistics
