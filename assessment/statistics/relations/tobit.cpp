#include "assessment/statistics/relations/tobit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "assessment/statistics/distributions.h"
#include "assessment/statistics/relations/observations.h"
#include "assessment/statistics/square_matrix.h"

namespace seldinger::assessment::statistics {
namespace {

// What a step would still add to the likelihood, twice.
constexpr double kNearSummit = 1e-12;
constexpr int kMostSteps = 200, kMostHalvings = 60;
// 1/σ, in units of the values' range, above which σ is none.
constexpr double kSteepest = 1e7;

// φ(z)/(1 − Φ(z)), by its expansion where both are too small.
double mills(double z) {
  return z > 30.0 ? z + 1.0 / z - 2.0 / (z * z * z) : normal_pdf(z) / normal_upper(z);
}
double log_upper(double z) {
  return z > 30.0 ? -0.5 * z * z - std::log(mills(z)) - 0.5 * std::log(2.0 * std::numbers::pi)
                  : std::log(normal_upper(z));
}

// Olsen's parameters, in which the likelihood has one summit: both means and 1, all over σ.
using Olsen = std::array<double, 3>;

struct Censored {
  std::array<std::vector<double>, 2> exact;
  std::array<double, 2> beyond{};  // how many
  double limit = 0.0;

  double log_likelihood(const Olsen& at) const {
    if (!(at[2] > 0.0)) return -INFINITY;
    double sum = 0.0;
    for (std::size_t g = 0; g < 2; ++g) {
      for (const double value : exact[g]) {
        const double z = at[2] * value - at[g];
        sum += std::log(at[2]) - 0.5 * z * z;
      }
      if (beyond[g] > 0.0) sum += beyond[g] * log_upper(at[2] * limit - at[g]);
    }
    return sum;
  }

  // Gradient, and minus the second derivatives, which are positive definite.
  Olsen slope(const Olsen& at, SquareMatrix& curvature) const {
    Olsen gradient{};
    std::fill(curvature.values.begin(), curvature.values.end(), 0.0);
    const auto add = [&](std::size_t g, double value, double first, double second, double count) {
      gradient[g] -= count * first;
      gradient[2] += count * first * value;
      curvature.at(g, g) += count * second;
      curvature.at(2, 2) += count * second * value * value;
      curvature.at(g, 2) -= count * second * value;
      curvature.at(2, g) -= count * second * value;
    };
    for (std::size_t g = 0; g < 2; ++g) {
      for (const double value : exact[g]) {
        add(g, value, at[g] - at[2] * value, 1.0, 1.0);
        gradient[2] += 1.0 / at[2];
        curvature.at(2, 2) += 1.0 / (at[2] * at[2]);
      }
      const double z = at[2] * limit - at[g], ratio = mills(z);
      if (beyond[g] > 0.0) add(g, limit, -ratio, ratio * (ratio - z), beyond[g]);
    }
    return gradient;
  }
};

struct Summit {
  Olsen at;
  SquareMatrix covariance;
};

std::optional<Summit> summit_of(const Censored& data, Olsen at) {
  SquareMatrix curvature(3);
  double now = data.log_likelihood(at);
  for (int step = 0; step < kMostSteps; ++step) {
    const Olsen gradient = data.slope(at, curvature);
    const std::optional<SquareMatrix> inverse = inverse_of(curvature);
    if (!inverse || !(at[2] < kSteepest)) return std::nullopt;
    Olsen move{};
    double rise = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) move[i] += inverse->at(i, j) * gradient[j];
      rise += move[i] * gradient[i];
    }
    if (rise < kNearSummit) {  // one step more doubles the digits; the likelihood no longer tells its worth
      for (std::size_t i = 0; i < 3; ++i) at[i] += move[i];
      data.slope(at, curvature);
      const std::optional<SquareMatrix> covariance = inverse_of(curvature);
      if (!covariance) return std::nullopt;
      return Summit{at, *covariance};
    }
    double share = 1.0;
    int halvings = 0;
    for (; halvings < kMostHalvings; ++halvings, share *= 0.5) {
      Olsen next = at;
      for (std::size_t i = 0; i < 3; ++i) next[i] += share * move[i];
      const double there = data.log_likelihood(next);
      if (!(there >= now)) continue;
      at = next;
      now = there;
      break;
    }
    if (halvings == kMostHalvings) return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Tobit> tobit_of(const std::vector<double>& first, const std::vector<double>& second, double limit) {
  // In units of the exact values' largest distance from their middle, so that squares hold.
  double low = INFINITY, high = -INFINITY;
  for (const std::vector<double>* group : {&first, &second})
    for (const double value : *group)
      if (value < limit) {
        low = std::min(low, value);
        high = std::max(high, value);
      }
  const double middle = 0.5 * low + 0.5 * high, unit = std::max(high - middle, limit - middle);
  if (!(unit > 0.0) || !std::isfinite(unit)) return std::nullopt;
  Censored data;
  data.limit = (limit - middle) / unit;
  for (std::size_t g = 0; g < 2; ++g)
    for (const double value : g == 0 ? first : second) {
      if (value < limit) {
        data.exact[g].push_back((value - middle) / unit);
      } else {
        data.beyond[g] += 1.0;
      }
    }
  const std::optional<Summit> summit = summit_of(data, {0.0, 0.0, 1.0});
  if (!summit) return std::nullopt;
  const Olsen& at = summit->at;
  Tobit found;
  found.sigma = unit / at[2];
  found.mean_first = middle + unit * at[0] / at[2];
  found.mean_second = middle + unit * at[1] / at[2];
  const double difference = (at[0] - at[1]) / at[2];
  const Olsen by{1.0 / at[2], -1.0 / at[2], -difference / at[2]};
  double variance = 0.0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) variance += by[i] * summit->covariance.at(i, j) * by[j];
  found.standard_error = unit * std::sqrt(variance);
  return found;
}

Answer tobit(const DataTable& table, const ProcedureOptions& options) {
  const Observations rows = observations(table, {.group = true}, options);
  if (const char* reason = not_two_groups(rows, 2)) return refused("tobit", reason, rows);
  const std::optional<double> limit = options.number("limit", 0.0);
  const std::string side = options.text("side", "upper");
  if (!options.has("limit") || !limit || (side != "upper" && side != "lower"))
    return refused("tobit", "bad_value", rows,
                   "limit is a number, the value at which counting ended; side is upper or lower.");
  const double sign = side == "upper" ? 1.0 : -1.0;
  std::vector<double> groups[2];
  double censored = 0.0;
  std::size_t exact[2] = {0, 0};
  for (std::size_t i = 0; i < rows.n; ++i) {
    const double value = sign * rows.values[0][i];
    groups[rows.group[i]].push_back(value);
    censored += value >= sign * *limit;
    exact[rows.group[i]] += value < sign * *limit;
  }
  if (exact[0] == 0 || exact[1] == 0)
    return refused("tobit", "perfect_separation", rows, "All values of a group are at the limit or beyond.");
  const std::optional<Tobit> fit = tobit_of(groups[0], groups[1], sign * *limit);
  if (!fit) return refused("tobit", "no_convergence", rows);
  Answer answer = begun("tobit", rows);
  answer.method = "difference of means of normal values censored at the limit, maximum likelihood, Wald";
  answer.estimate_name = "difference of means (" + rows.groups[0] + " − " + rows.groups[1] + ")";
  answer.estimate = sign * (fit->mean_first - fit->mean_second);
  const double half = normal_quantile_of(0.975) * fit->standard_error;
  answer.ci95 = Interval{*answer.estimate - half, *answer.estimate + half};
  answer.statistic = *answer.estimate / fit->standard_error;
  answer.p_value = 2.0 * normal_upper(std::abs(*answer.statistic));
  answer.more = {{"mean_first", sign * fit->mean_first},
                 {"mean_second", sign * fit->mean_second},
                 {"sigma", fit->sigma},
                 {"standard_error", fit->standard_error},
                 {"censored", censored}};
  answer.notes.emplace_back(
      "It rests on normal values with one spread: simulated with one group's three times the other's, it rejected "
      "more than 6 of 100 true equalities, up to 20. log_rank rests on neither.");
  warn_of_interval(answer, 30);
  warn_of_test(answer, 60);
  return settled(std::move(answer));
}

}  // namespace seldinger::assessment::statistics
