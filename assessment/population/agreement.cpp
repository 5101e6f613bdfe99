#include "assessment/population/agreement.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "assessment/population/streams.h"
#include "assessment/statistics/distributions.h"
#include "assessment/statistics/ranks.h"

namespace seldinger::assessment::population {
namespace {

constexpr double kQuantileLimit = 0.1, kShareLimit = 3.0, kPairLimit = 0.1, kErrors = 3.0;
constexpr std::size_t kFewestCompared = 30;

struct Column {
  std::vector<double> values;  // sorted
  double null_share = 0.0, zero_share = 0.0;
};

Column column_of(std::span<const Values> rows, std::size_t m) {
  Column column;
  std::size_t nulls = 0, zeros = 0;
  for (const Values& row : rows) {
    if (!row[m]) {
      ++nulls;
      continue;
    }
    zeros += *row[m] == 0.0 ? 1U : 0U;
    column.values.push_back(*row[m]);
  }
  const auto n = static_cast<double>(rows.size());
  column.null_share = static_cast<double>(nulls) / n;
  column.zero_share = static_cast<double>(zeros) / n;
  std::sort(column.values.begin(), column.values.end());
  return column;
}

double quantile_at(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto low = static_cast<std::size_t>(place);
  const std::size_t high = std::min(low + 1, sorted.size() - 1);
  return sorted[low] + (sorted[high] - sorted[low]) * (place - static_cast<double>(low));
}

double sd_of(const std::vector<double>& x) {
  const auto n = static_cast<double>(x.size());
  const double mean = std::accumulate(x.begin(), x.end(), 0.0) / n;
  double square = 0.0;
  for (const double one : x) square += (one - mean) * (one - mean);
  return std::sqrt(square / (n - 1.0));
}

// √(p (1 − p)/n) over the density, of a normal distribution, in its standard deviations.
double quantile_error(double share, std::size_t n) {
  const double density = statistics::normal_pdf(statistics::normal_quantile_of(share));
  return std::sqrt(share * (1.0 - share) / static_cast<double>(n)) / density;
}

double share_error_points(double share, std::size_t n) {
  return 100.0 * std::sqrt(std::max(share * (1.0 - share), 1.0 / static_cast<double>(n)) / static_cast<double>(n));
}

MetricAgreement metric_agreement(std::span<const Values> full, std::span<const Values> drawn, std::size_t m,
                                 Agreement& sum) {
  MetricAgreement made;
  const Column a = column_of(full, m), b = column_of(drawn, m);
  made.values = a.values.size();
  made.null_points = 100.0 * (b.null_share - a.null_share);
  made.zero_points = 100.0 * (b.zero_share - a.zero_share);
  made.null_error_points = share_error_points(a.null_share, full.size());
  made.zero_error_points = share_error_points(a.zero_share, full.size());
  for (const auto& [points, error] :
       {std::pair(made.null_points, made.null_error_points), std::pair(made.zero_points, made.zero_error_points)}) {
    sum.shares_off += std::abs(points) > kShareLimit ? 1U : 0U;
    sum.shares_beyond_chance += std::abs(points) > kShareLimit + kErrors * error ? 1U : 0U;
  }
  const double sd = sd_of(a.values);
  if (!(sd > 0.0) || b.values.empty()) return made;
  bool off = false, beyond = false;
  for (const double share : {0.1, 0.5, 0.9}) {
    const double difference = (quantile_at(b.values, share) - quantile_at(a.values, share)) / sd;
    const double error = quantile_error(share, a.values.size());
    off = off || std::abs(difference) > kQuantileLimit;
    beyond = beyond || std::abs(difference) > kQuantileLimit + kErrors * error;
    if (std::abs(difference) > std::abs(made.quantile_sd)) {
      made.quantile_sd = difference;
      made.quantile_error_sd = error;
    }
  }
  sum.quantiles_off += off ? 1U : 0U;
  sum.quantiles_beyond_chance += beyond ? 1U : 0U;
  return made;
}

// Spearman's, of the rows in which both have a value.
std::optional<double> rank_correlation(std::span<const Values> rows, std::size_t m, std::size_t k) {
  std::vector<double> x, y;
  for (const Values& row : rows)
    if (row[m] && row[k]) {
      x.push_back(*row[m]);
      y.push_back(*row[k]);
    }
  if (x.size() < kFewestCompared) return std::nullopt;
  const auto a = statistics::midranks(x), b = statistics::midranks(y);
  const double middle = (static_cast<double>(x.size()) + 1.0) / 2.0;
  double xy = 0.0, xx = 0.0, yy = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    xy += (a[i] - middle) * (b[i] - middle);
    xx += (a[i] - middle) * (a[i] - middle);
    yy += (b[i] - middle) * (b[i] - middle);
  }
  if (!(xx > 0.0 && yy > 0.0)) return std::nullopt;
  return xy / std::sqrt(xx * yy);
}

void compare_pairs(const Surrogate& surrogate, std::span<const Values> full, std::span<const Values> drawn,
                   std::span<const std::size_t> compared, Agreement& sum) {
  sum.rank_correlation_error = 1.0 / std::sqrt(static_cast<double>(full.size()) - 1.0);
  for (std::size_t i = 0; i < compared.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const auto a = rank_correlation(full, compared[i], compared[j]);
      const auto b = rank_correlation(drawn, compared[i], compared[j]);
      if (!a || !b) continue;
      ++sum.pairs;
      const double off = std::abs(*a - *b);
      sum.pairs_off += off > kPairLimit ? 1U : 0U;
      sum.pairs_beyond_chance += off > kPairLimit + kErrors * sum.rank_correlation_error ? 1U : 0U;
      if (off > sum.worst_rank_correlation) {
        sum.worst_rank_correlation = off;
        sum.worst_pair =
            surrogate.mark().metrics[compared[i]].id + " and " + surrogate.mark().metrics[compared[j]].id;
      }
    }
}

}  // namespace

Agreement agreement_of(const Surrogate& surrogate, std::span<const SimulatedPoint> held_out, std::size_t draws_each,
                       std::uint64_t seed) {
  Agreement sum;
  std::vector<Values> full, drawn;
  for (std::size_t p = 0; p < held_out.size(); ++p) {
    full.push_back(held_out[p].values);
    for (std::size_t i = 0; i < draws_each; ++i)
      drawn.push_back(surrogate.draw(held_out[p].place, stream_of(seed, Drawn::surrogate, p, i)));
  }
  sum.attempts = full.size();
  sum.draws = drawn.size();
  std::vector<std::size_t> compared;
  for (std::size_t m = 0; m < surrogate.mark().metrics.size(); ++m) {
    const auto values =
        std::count_if(full.begin(), full.end(), [&](const Values& row) { return row[m].has_value(); });
    if (static_cast<std::size_t>(values) < kFewestCompared) continue;
    compared.push_back(m);
    sum.metrics.push_back(metric_agreement(full, drawn, m, sum));
    sum.metrics.back().metric = surrogate.mark().metrics[m].id;
  }
  compare_pairs(surrogate, full, drawn, compared, sum);
  return sum;
}

}  // namespace seldinger::assessment::population
