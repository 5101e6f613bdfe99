#include "assessment/statistics/relations/bootstrap.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "assessment/statistics/distributions.h"
#include "assessment/statistics/relations/observations.h"
#include "sim/base/check.h"
#include "sim/base/rng.h"

namespace seldinger::assessment::statistics {
namespace {

constexpr std::size_t kLeastDraws = 200, kUsualDraws = 5000, kMostDraws = 100000;
constexpr std::size_t kMostSeed = 4294967295;
// Persons above which leaving out each in turn takes too long.
constexpr std::size_t kMostDrawn = 5000;
// Fewer persons than these make intervals too narrow, those of means where values are skewed.
constexpr std::size_t kFewMean = 50, kFewDifference = 150, kFewMedian = 20;
// A draw counts as equal to the estimate up to this share of the largest value.
constexpr double kEqualDraw = 1e-12;

double mean_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// Reorders what it is given.
double median_of(std::span<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * *std::max_element(values.begin(), middle) + 0.5 * *middle;
}

double centre_of(std::span<double> values, Centre centre) {
  return centre == Centre::kMean ? mean_of(values) : median_of(values);
}

double centre_of_copy(const std::vector<double>& values, Centre centre) {
  std::vector<double> copy = values;
  return centre_of(copy, centre);
}

// Sums of squares and cubes of what leaving out each person does, over the group's size.
struct Jackknife {
  double squares = 0.0, cubes = 0.0;

  void add(const std::vector<double>& values, Centre centre, double sign) {
    std::vector<double> without;
    for (std::size_t i = 0; i < values.size(); ++i) {
      std::vector<double> others = values;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
      without.push_back(centre_of(others, centre));
    }
    const double mean = mean_of(without), n = static_cast<double>(values.size());
    for (const double one : without) {
      const double influence = sign * (n - 1.0) * (mean - one) / n;
      squares += influence * influence;
      cubes += influence * influence * influence;
    }
  }
  double acceleration() const { return squares > 0.0 ? cubes / (6.0 * std::pow(squares, 1.5)) : 0.0; }
};

// The place `share` of sorted draws, between two of them on the normal scale (Davison, Hinkley, 1997, eq. 5.6).
double draw_at(const std::vector<double>& sorted, double share) {
  const double count = static_cast<double>(sorted.size()), rank = share * (count + 1.0);
  if (!(rank >= 1.0)) return sorted.front();
  if (rank >= count) return sorted.back();
  const double whole = std::floor(rank);
  const auto below = static_cast<std::size_t>(whole) - 1;
  if (rank == whole) return sorted[below];
  const double at = normal_quantile_of(share), from = normal_quantile_of(whole / (count + 1.0));
  const double to = normal_quantile_of((whole + 1.0) / (count + 1.0));
  return sorted[below] + (at - from) / (to - from) * (sorted[below + 1] - sorted[below]);
}

std::vector<double> draws_of(std::span<const std::vector<double>> groups, std::span<const Resamples> resamples,
                             Centre centre) {
  std::vector<double> draws(resamples.front().draws(), 0.0), drawn;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    drawn.resize(groups[g].size());
    for (std::size_t d = 0; d < draws.size(); ++d) {
      for (std::size_t i = 0; i < drawn.size(); ++i) drawn[i] = groups[g][resamples[g].at(d, i)];
      draws[d] += (g == 0 ? 1.0 : -1.0) * centre_of(drawn, centre);
    }
  }
  return draws;
}

}  // namespace

std::size_t Resamples::at(std::size_t draw, std::size_t place) const noexcept {
  const auto counter = static_cast<std::uint64_t>(draw * persons_ + place);
  return static_cast<std::size_t>(base::uniform_at(seed_, counter) * static_cast<double>(persons_));
}

std::optional<Bca> bca_of(std::span<const std::vector<double>> groups, std::span<const Resamples> resamples,
                          Centre centre) {
  CHECK(!groups.empty() && groups.size() <= 2 && resamples.size() == groups.size());
  Bca found;
  Jackknife jackknife;
  double largest = 0.0;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const double sign = g == 0 ? 1.0 : -1.0;
    found.estimate += sign * centre_of_copy(groups[g], centre);
    jackknife.add(groups[g], centre, sign);
    for (const double value : groups[g]) largest = std::max(largest, std::abs(value));
  }
  std::vector<double> draws = draws_of(groups, resamples, centre);
  if (std::any_of(draws.begin(), draws.end(), [](double one) { return !std::isfinite(one); })) return std::nullopt;
  std::sort(draws.begin(), draws.end());
  double below = 0.0;
  for (const double draw : draws) {
    if (std::abs(draw - found.estimate) <= kEqualDraw * largest) {
      below += 0.5;
    } else if (draw < found.estimate) {
      below += 1.0;
    }
  }
  const double share_below = below / static_cast<double>(draws.size());
  if (draws.front() == draws.back() || share_below <= 0.0 || share_below >= 1.0) return std::nullopt;
  found.bias = normal_quantile_of(share_below);
  found.acceleration = jackknife.acceleration();
  if (!std::isfinite(found.acceleration)) return std::nullopt;
  const auto limit = [&](double z) {
    const double shifted = found.bias + z;
    const double share = normal_cdf(found.bias + shifted / (1.0 - found.acceleration * shifted));
    const double rank = share * (static_cast<double>(draws.size()) + 1.0);
    if (rank < 1.0 || rank >= static_cast<double>(draws.size())) found.at_the_ends = true;
    return draw_at(draws, share);
  };
  const double z = normal_quantile_of(0.975);
  found.ci95 = {limit(-z), limit(z)};
  return found;
}

Answer bootstrap(const DataTable& table, const ProcedureOptions& options) {
  const Observations rows = observations(table, {.group = true}, options);
  const std::string asked = options.text("statistic", "mean");
  const std::optional<std::size_t> draws = options.whole("resamples", kUsualDraws, kLeastDraws, kMostDraws);
  const std::optional<std::size_t> seed = options.whole("seed", 1, 0, kMostSeed);
  if ((asked != "mean" && asked != "median") || !draws || !seed)
    return refused("bootstrap", "bad_value", rows,
                   "statistic is mean or median; resamples a whole number from 200 to 100000; seed one up to "
                   "4294967295.");
  const bool two = !table.group.empty() && rows.groups.size() != 1;
  if (rows.reason != nullptr) return refused("bootstrap", rows.reason, rows);
  if (rows.n == 0) return refused("bootstrap", "no_data", rows);
  if (two)
    if (const char* reason = not_two_groups(rows, 2)) return refused("bootstrap", reason, rows);
  if (rows.n < 2) return refused("bootstrap", "too_few", rows);
  if (rows.n > kMostDrawn) return refused("bootstrap", "too_many", rows);
  std::vector<std::vector<double>> groups;
  std::vector<Resamples> resamples;
  for (std::size_t g = 0; g < rows.groups.size(); ++g) {
    groups.push_back(rows.values_of(g));
    resamples.emplace_back(groups[g].size(), *draws, base::hash_combine(*seed, std::uint64_t{g}));
  }
  const Centre centre = asked == "mean" ? Centre::kMean : Centre::kMedian;
  Answer answer = begun("bootstrap", rows);
  answer.method = "bias-corrected and accelerated bootstrap over persons, " + std::to_string(*draws) +
                  " draws, seed " + std::to_string(*seed);
  answer.estimate_name =
      two ? "difference of " + asked + "s (" + rows.groups[0] + " − " + rows.groups[1] + ")" : asked;
  if (const std::optional<Bca> bca = bca_of(groups, resamples, centre)) {
    answer.estimate = bca->estimate;
    answer.ci95 = bca->ci95;
    answer.more = {{"bias_z0", bca->bias}, {"acceleration", bca->acceleration}};
    if (bca->at_the_ends)
      answer.notes.emplace_back("A limit is the most extreme of all draws: take more, or another interval.");
    warn_of_interval(answer, centre == Centre::kMedian ? kFewMedian : two ? kFewDifference : kFewMean);
    return settled(std::move(answer));
  }
  answer.estimate = centre_of_copy(groups[0], centre) - (two ? centre_of_copy(groups[1], centre) : 0.0);
  answer.notes.emplace_back("The draws do not vary, or lie on one side of the estimate: there is no interval.");
  return settled(std::move(answer));
}

}  // namespace seldinger::assessment::statistics
