#include "assessment/statistics/standards/contrasting_groups.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "assessment/statistics/distributions.h"
#include "assessment/statistics/percentile_bootstrap.h"
#include "assessment/statistics/roots.h"
#include "assessment/statistics/spread.h"
#include "assessment/statistics/standards/cut_notes.h"

namespace seldinger::assessment::statistics {
namespace {

constexpr std::size_t kLeastInGroup = 5;

std::optional<double> cut_between(const ContrastingGroups& groups, const NormalScores& without,
                                  const NormalScores& competent) {
  const bool as_expected = groups.higher_is_better ? without.mean < competent.mean : without.mean > competent.mean;
  if (!as_expected || !(without.sd > 0.0) || !(competent.sd > 0.0)) return std::nullopt;
  return normal_crossing(without, competent);
}

NormalScores scores_drawn(const std::vector<double>& scores, const std::vector<std::size_t>& indices) {
  std::vector<double> drawn;
  drawn.reserve(indices.size());
  for (const std::size_t index : indices) drawn.push_back(scores[index]);
  const Spread spread = spread_of(drawn);
  return {spread.mean, std::sqrt(spread.variance)};
}

bool passes(double score, double cut, bool higher_is_better) {
  return higher_is_better ? score >= cut : score <= cut;
}

WrongDecisions observed_decisions(const ContrastingGroups& groups, double cut) {
  const auto share_passing = [&](const std::vector<double>& scores) {
    const auto passing = std::count_if(scores.begin(), scores.end(),
                                       [&](double one) { return passes(one, cut, groups.higher_is_better); });
    return static_cast<double>(passing) / static_cast<double>(scores.size());
  };
  return {share_passing(groups.without), 1.0 - share_passing(groups.competent)};
}

Answer refused_groups(const ContrastingGroups& groups, const char* reason, const char* note) {
  Answer answer = not_estimable("contrasting_groups", reason, groups.without.size() + groups.competent.size(),
                                {groups.without_name, groups.competent_name});
  answer.missing = groups.missing;
  if (note != nullptr) answer.notes.emplace_back(note);
  return answer;
}

void draw_persons(Answer& answer, const ContrastingGroups& groups, std::size_t draws, std::uint64_t seed) {
  const std::array sizes = {groups.without.size(), groups.competent.size()};
  say_of_draws(answer, percentile_bootstrap(sizes, draws, seed, [&](const Draw& draw) {
                 const std::optional<double> cut = cut_between(groups, scores_drawn(groups.without, draw[0]),
                                                               scores_drawn(groups.competent, draw[1]));
                 return cut ? *cut : std::nan("");
               }));
}

}  // namespace

std::optional<double> normal_crossing(const NormalScores& a, const NormalScores& b) {
  // Between the means the logarithm of the ratio of densities only falls, or only rises.
  const auto ratio = [&](double x) {
    const double za = (x - a.mean) / a.sd, zb = (x - b.mean) / b.sd;
    return std::log(a.sd / b.sd) + 0.5 * (za * za - zb * zb);
  };
  if (a.sd == b.sd) return 0.5 * a.mean + 0.5 * b.mean;
  const double cut = root_between(std::min(a.mean, b.mean), std::max(a.mean, b.mean), ratio);
  if (!std::isfinite(cut)) return std::nullopt;
  return cut;
}

WrongDecisions wrong_decisions(const NormalScores& without, const NormalScores& competent, double cut,
                               bool higher_is_better) {
  const double side = higher_is_better ? 1.0 : -1.0;
  return {normal_upper(side * (cut - without.mean) / without.sd),
          normal_cdf(side * (cut - competent.mean) / competent.sd)};
}

Answer contrasting_groups(const ContrastingGroups& groups, std::size_t draws, std::uint64_t seed) {
  if (groups.without.size() < kLeastInGroup || groups.competent.size() < kLeastInGroup)
    return refused_groups(groups, "group_too_small", "A cut needs five persons in each group.");
  const Spread a = spread_of(groups.without), b = spread_of(groups.competent);
  if (!a.computable || !b.computable) return refused_groups(groups, "no_finite_answer", nullptr);
  if (!a.varies && !b.varies) return refused_groups(groups, "no_variation_within", nullptr);
  if (!a.varies || !b.varies) return refused_groups(groups, "no_variation", "The scores of one group do not vary.");
  const NormalScores without{a.mean, std::sqrt(a.variance)}, competent{b.mean, std::sqrt(b.variance)};
  const std::optional<double> cut = cut_between(groups, without, competent);
  if (!cut) {
    const bool turned = groups.higher_is_better ? a.mean >= b.mean : a.mean <= b.mean;
    return refused_groups(groups, "no_crossing",
                          turned
                              ? "The competent group does not score better than the other: no cut separates them."
                              : "The groups overlap so far that no cut lies between their means.");
  }
  Answer answer;
  answer.test = "contrasting_groups";
  answer.method = "Contrasting groups: crossing of two normal distributions between their means";
  answer.n = a.n + b.n;
  answer.missing = groups.missing;
  answer.groups = {groups.without_name, groups.competent_name};
  answer.estimate = *cut;
  answer.estimate_name = groups.higher_is_better ? "cut (that or more passes)" : "cut (that or less passes)";
  const WrongDecisions theory = wrong_decisions(without, competent, *cut, groups.higher_is_better);
  const WrongDecisions observed = observed_decisions(groups, *cut);
  answer.more = {{"false_pass_theoretical", theory.false_pass},
                 {"false_fail_theoretical", theory.false_fail},
                 {"false_pass_observed", observed.false_pass},
                 {"false_fail_observed", observed.false_fail}};
  for (const auto& [name, scores] : {std::pair(groups.without_name, a), std::pair(groups.competent_name, b)})
    answer.rows.push_back(
        {name.name,
         {{"n", static_cast<double>(scores.n)}, {"mean", scores.mean}, {"sd", std::sqrt(scores.variance)}}});
  draw_persons(answer, groups, draws, seed);
  return settled(std::move(answer));
}

}  // namespace seldinger::assessment::statistics
