#include "assessment/statistics/standards/classification.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "assessment/statistics/distributions.h"
#include "assessment/statistics/roots.h"
#include "assessment/statistics/spread.h"
#include "assessment/statistics/standards/livingston_lewis.h"

namespace seldinger::assessment::statistics {
namespace {

constexpr std::size_t kLeastScores = 5;
constexpr int kSteps = 1024;  // of Simpson's rule; the integrand is smooth

double skewness_of(const std::vector<double>& scores, const Spread& spread) {
  double cubes = 0.0;
  for (const double score : scores) cubes += std::pow((score - spread.mean) / std::sqrt(spread.variance), 3.0);
  return cubes / static_cast<double>(scores.size());
}

// Of the cut's distance from the mean in standard deviations: the non-centralities between which t is as likely to
// be so small, or so large, as one in forty.
Interval standing_interval(double standing, double n) {
  const double t = std::sqrt(n) * standing, far = 10.0 * std::sqrt(1.0 + t * t / (2.0 * n));
  const auto where = [&](double share) {
    return root_between(t - far, t + far,
                        [&](double delta) { return noncentral_t_cdf(t, n - 1.0, delta) - share; }) /
           std::sqrt(n);
  };
  return {where(0.975), where(0.025)};
}

// Decisions are the less consistent the nearer the cut is to the mean.
Interval consistency_interval(const Interval& standing, double reliability) {
  const auto at = [&](double z) { return classification_of(0.0, 1.0, reliability, z).consistency; };
  const double one = std::abs(standing.low), other = std::abs(standing.high);
  const bool around_mean = standing.low < 0.0 && standing.high > 0.0;
  return {at(around_mean ? 0.0 : std::min(one, other)), at(std::max(one, other))};
}

Answer refused_cut(const CutScores& of, const char* reason, const char* note) {
  Answer answer = not_estimable("classification", reason, of.scores.size());
  answer.missing = of.missing;
  if (note != nullptr) answer.notes.emplace_back(note);
  return answer;
}

}  // namespace

// By its derivative in the correlation (Plackett, Biometrika 41, 1954), with the correlation as a sine.
double bivariate_normal_cdf(double h, double k, double rho) {
  const double end = std::asin(rho), step = end / kSteps;
  const auto density = [&](double angle) {
    const double sine = std::sin(angle), square = std::cos(angle) * std::cos(angle);
    return std::exp(-(h * h - 2.0 * h * k * sine + k * k) / (2.0 * square));
  };
  double sum = density(0.0) + density(end);
  for (int i = 1; i < kSteps; ++i) sum += (i % 2 == 1 ? 4.0 : 2.0) * density(step * i);
  return normal_cdf(h) * normal_cdf(k) + sum * step / 3.0 / (2.0 * std::numbers::pi);
}

Classification classification_of(double mean, double sd, double reliability, double cut) {
  const double observed = (cut - mean) / sd, truly = observed / std::sqrt(reliability);
  const double fail = normal_cdf(observed), truly_fail = normal_cdf(truly);
  const double both_fail = bivariate_normal_cdf(observed, observed, reliability);
  const double rightly_fail = bivariate_normal_cdf(observed, truly, std::sqrt(reliability));
  Classification found;
  found.pass = 1.0 - fail;
  found.consistency = 1.0 - 2.0 * (fail - both_fail);
  const double by_chance = fail * fail + found.pass * found.pass;
  found.kappa = (found.consistency - by_chance) / (1.0 - by_chance);
  found.false_pass = std::max(0.0, truly_fail - rightly_fail);
  found.false_fail = std::max(0.0, fail - rightly_fail);
  found.accuracy = 1.0 - found.false_pass - found.false_fail;
  return found;
}

Answer classification(const CutScores& of) {
  if (of.scores.size() < kLeastScores)
    return refused_cut(of, "too_few", "Judging a cut takes five persons or more.");
  const Spread spread = spread_of(of.scores);
  if (!spread.computable) return refused_cut(of, "no_finite_answer", nullptr);
  if (!spread.varies) return refused_cut(of, "no_variation", nullptr);
  if (!(of.reliability > 0.0 && of.reliability < 1.0))
    return refused_cut(of, "bad_value", "A reliability lies between 0 and 1.");
  const double side = of.higher_is_better ? 1.0 : -1.0;
  const double sd = std::sqrt(spread.variance), n = static_cast<double>(spread.n);
  Classification found;
  if (of.ends) {
    const bool higher = of.higher_is_better;
    const auto by_ends =
        livingston_lewis_of({side * spread.mean, sd, higher ? of.ends->low : -of.ends->high,
                             higher ? of.ends->high : -of.ends->low, of.reliability, side * of.cut});
    if (!by_ends)
      return refused_cut(of, "no_solution", "Between these ends no scores have this mean, spread and reliability.");
    found = *by_ends;
  } else {
    found = classification_of(side * spread.mean, sd, of.reliability, side * of.cut);
  }
  const auto passing =
      std::count_if(of.scores.begin(), of.scores.end(), [&](double one) { return side * one >= side * of.cut; });
  Answer answer;
  answer.test = "classification";
  answer.method =
      of.ends
          ? "Livingston and Lewis: true scores by a beta distribution of two parameters between the ends given, "
            "observed ones binomial about them"
          : "Peng and Subkoviak: two equivalent tests with normal scores and the reliability given; interval by "
            "the "
            "non-central t of the cut's distance from the mean";
  answer.n = spread.n;
  answer.missing = of.missing;
  answer.estimate = found.consistency;
  answer.estimate_name = "classification consistency";
  answer.more = {{"kappa", found.kappa},
                 {"accuracy", found.accuracy},
                 {"false_pass", found.false_pass},
                 {"false_fail", found.false_fail},
                 {"pass_share", found.pass},
                 {"pass_share_observed", static_cast<double>(passing) / static_cast<double>(spread.n)},
                 {"reliability", of.reliability},
                 {"cut", of.cut}};
  if (of.ends) return settled(std::move(answer));
  answer.ci95 = consistency_interval(standing_interval((of.cut - spread.mean) / sd, n), of.reliability);
  answer.notes.emplace_back("The interval takes the reliability as known.");
  if (std::abs(skewness_of(of.scores, spread)) > 1.0)
    answer.notes.emplace_back("The scores are skewed: shares by the normal distribution are doubtful.");
  return settled(std::move(answer));
}

}  // namespace seldinger::assessment::statistics
