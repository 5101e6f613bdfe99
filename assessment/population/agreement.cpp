#include "assessment/population/agreement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>

#include "assessment/population/streams.h"
#include "assessment/statistics/relations/correlation.h"
#include "assessment/statistics/relations/discrimination.h"

namespace seldinger::assessment::population {
namespace {

constexpr double kQuantileLimit = 0.1, kShareLimit = 3.0, kPairLimit = 0.1, kErrors = 3.0;
constexpr std::size_t kFewestCompared = 30;

// Of differences, each with its standard error: what is left when chance is taken away, root mean square. What
// chance blurs beyond the limit counts the less for it: a square's own error goes with the variance.
struct OwnError {
  double limit = 0.1, squares = 0.0, weights = 0.0;
  void add(double difference, double error) {
    const double variance = error * error + limit * limit, weight = 1.0 / (variance * variance);
    squares += weight * (difference * difference - error * error);
    weights += weight;
  }
  double rms() const { return weights > 0.0 ? std::sqrt(std::max(0.0, squares / weights)) : 0.0; }
};

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

// Where the distribution passes a share: the i-th of n values at (i − ½)/n, between two in a line. A whole number
// is spread over its unit, as grouped data are, so that nothing jumps where a share passes the mark.
double quantile_at(const std::vector<double>& sorted, double share, bool whole) {
  const double place = share * static_cast<double>(sorted.size()) - 0.5;
  const auto low = static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(sorted.size() - 1)));
  if (whole) {
    const auto [first, past] = std::equal_range(sorted.begin(), sorted.end(), sorted[low]);
    const double within = share * static_cast<double>(sorted.size()) - static_cast<double>(first - sorted.begin());
    return sorted[low] - 0.5 + within / static_cast<double>(past - first);
  }
  const std::size_t high = std::min(low + 1, sorted.size() - 1);
  return sorted[low] + (sorted[high] - sorted[low]) * std::clamp(place - static_cast<double>(low), 0.0, 1.0);
}

// The share of values below another one, half of those that are equal to it; of whole numbers spread over their
// unit.
double share_below(const std::vector<double>& sorted, double value, bool whole) {
  const double number = whole ? std::round(value) : value;
  const auto [first, past] = std::equal_range(sorted.begin(), sorted.end(), number);
  const double part = whole ? value - (number - 0.5) : 0.5;
  return (static_cast<double>(first - sorted.begin()) + part * static_cast<double>(past - first)) /
         static_cast<double>(sorted.size());
}

double mean_of(const std::vector<double>& x) {
  return std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
}

double sd_of(const std::vector<double>& x) {
  const auto n = static_cast<double>(x.size());
  const double mean = mean_of(x);
  double square = 0.0;
  for (const double one : x) square += (one - mean) * (one - mean);
  return std::sqrt(square / (n - 1.0));
}

constexpr std::array kShares = {0.1, 0.5, 0.9};

// Of the quantile at a share, by those one standard error of the share to either side (Woodruff, J. Am. Stat.
// Assoc. 47, 1952, 635).
double quantile_error(const std::vector<double>& sorted, double share, bool whole) {
  const double error = std::sqrt(share * (1.0 - share) / static_cast<double>(sorted.size()));
  return 0.5 * (quantile_at(sorted, share + error, whole) - quantile_at(sorted, share - error, whole));
}

// Of n attempts a share lay below; how many standard errors that is from the share that was to. The arc sine makes
// the errors of all shares alike.
double errors_of_share(double found, double expected, std::size_t n) {
  return 2.0 * std::sqrt(static_cast<double>(n)) *
         std::abs(std::asin(std::sqrt(found)) - std::asin(std::sqrt(expected)));
}

double share_error_points(double share, std::size_t n) {
  return 100.0 * std::sqrt(std::max(share * (1.0 - share), 1.0 / static_cast<double>(n)) / static_cast<double>(n));
}

void count_errors(double errors_beyond, Agreement& sum) {
  ++sum.comparisons;
  sum.furthest_errors = std::max(sum.furthest_errors, errors_beyond);
}

void count_comparison(double off, double limit, double error, Agreement& sum) {
  count_errors(std::max(off - limit, 0.0) / error, sum);
}

MetricAgreement metric_agreement(std::span<const Values> full, const Column& b, std::size_t m, bool whole,
                                 OwnError& own, Agreement& sum) {
  MetricAgreement made;
  const Column a = column_of(full, m);
  made.values = a.values.size();
  made.null_points = 100.0 * (b.null_share - a.null_share);
  made.zero_points = 100.0 * (b.zero_share - a.zero_share);
  made.null_error_points = share_error_points(a.null_share, full.size());
  made.zero_error_points = share_error_points(a.zero_share, full.size());
  for (const auto& [points, error] :
       {std::pair(made.null_points, made.null_error_points), std::pair(made.zero_points, made.zero_error_points)}) {
    count_comparison(std::abs(points), kShareLimit, error, sum);
    sum.off.shares += std::abs(points) > kShareLimit ? 1U : 0U;
    sum.beyond_chance.shares += std::abs(points) > kShareLimit + kErrors * error ? 1U : 0U;
  }
  if (a.values.size() < kFewestCompared || b.values.empty()) return made;
  const double sd = sd_of(a.values);
  if (!(sd > 0.0)) return made;
  bool off = false, beyond = false;
  for (const double share : kShares) {
    const double here = quantile_at(a.values, share, whole), there = quantile_at(b.values, share, whole);
    const double difference = (there - here) / sd, error = quantile_error(a.values, share, whole) / sd;
    // Were the surrogate right but for a move by the limit, so large a share of attempts would lie below their
    // quantile: the sign test, which asks nothing of how densely they lie there.
    const double moved = here + std::copysign(kQuantileLimit * sd, difference);
    const double errors = std::abs(difference) > kQuantileLimit
                              ? errors_of_share(share, share_below(b.values, moved, whole), a.values.size())
                              : 0.0;
    count_errors(errors, sum);
    off = off || std::abs(difference) > kQuantileLimit;
    beyond = beyond || errors > kErrors;
    own.add(difference, error);
    if (std::abs(difference) > std::abs(made.quantile_sd)) {
      made.quantile_sd = difference;
      made.quantile_error_sd = error;
    }
    made.quantile_errors = std::max(made.quantile_errors, errors);
  }
  sum.off.quantiles += off ? 1U : 0U;
  sum.beyond_chance.quantiles += beyond ? 1U : 0U;
  return made;
}

struct RankCorrelation {
  double rho = 0.0;
  std::size_t n = 0;  // rows in which both have a value
};

// Spearman's of one metric in rows and another in others, of those in which both have a value.
std::optional<RankCorrelation> rank_correlation(std::span<const Values> rows, std::size_t m,
                                                std::span<const Values> others, std::size_t k) {
  std::vector<double> x, y;
  for (std::size_t i = 0; i < std::min(rows.size(), others.size()); ++i)
    if (rows[i][m] && others[i][k]) {
      x.push_back(*rows[i][m]);
      y.push_back(*others[i][k]);
    }
  if (x.size() < kFewestCompared) return std::nullopt;
  const double rho = statistics::rank_correlation(x, y);
  if (std::isnan(rho)) return std::nullopt;
  return RankCorrelation{rho, x.size()};
}

// Bonett and Wright's (Psychometrika 65, 2000) of Fisher's z, back on the correlation.
double error_of(const RankCorrelation& one) {
  const double square = one.rho * one.rho;
  return (1.0 - square) * std::sqrt((1.0 + 0.5 * square) / (static_cast<double>(one.n) - 3.0));
}

std::vector<Values> whole(std::span<const SimulatedPoint> points) {
  std::vector<Values> rows;
  for (const SimulatedPoint& one : points) drop_rounding(rows.emplace_back(one.values));
  return rows;
}

std::vector<Values> drawn_for(const Surrogate& surrogate, std::span<const SimulatedPoint> points, std::size_t each,
                              std::uint64_t seed) {
  std::vector<Values> rows;
  for (std::size_t p = 0; p < points.size(); ++p)
    for (std::size_t i = 0; i < each; ++i)
      rows.push_back(surrogate.draw(points[p].place, stream_of(seed, Drawn::surrogate, p, i)));
  return rows;
}

double difference_of(const std::vector<double>& less, const std::vector<double>& more) {
  const auto n1 = static_cast<double>(less.size()), n2 = static_cast<double>(more.size());
  const double sd1 = sd_of(less), sd2 = sd_of(more);
  const double pooled = std::sqrt(((n1 - 1.0) * sd1 * sd1 + (n2 - 1.0) * sd2 * sd2) / (n1 + n2 - 2.0));
  return pooled > 0.0 ? (mean_of(more) - mean_of(less)) / pooled : 0.0;
}

// What the surrogate draws, once for all that is held against it.
struct DrawnSide {
  struct Metric {
    std::size_t m;
    bool whole;
    Column column;
  };
  struct Pair {
    std::size_t m, k;
    double rho;
  };
  std::vector<Metric> metrics;  // those that enough held-out attempts have
  std::vector<Pair> pairs;
};

DrawnSide drawn_side(const Surrogate& surrogate, std::span<const Values> full, std::span<const Values> drawn) {
  DrawnSide side;
  for (std::size_t m = 0; m < surrogate.mark().metrics.size(); ++m) {
    const auto values =
        std::count_if(full.begin(), full.end(), [&](const Values& row) { return row[m].has_value(); });
    if (static_cast<std::size_t>(values) >= kFewestCompared)
      side.metrics.push_back({m, is_whole(surrogate.mark().metrics[m].id), column_of(drawn, m)});
  }
  for (std::size_t i = 0; i < side.metrics.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const std::size_t m = side.metrics[i].m, k = side.metrics[j].m;
      if (const auto both = rank_correlation(drawn, m, drawn, k)) side.pairs.push_back({m, k, both->rho});
    }
  return side;
}

void compare_metrics(std::span<const Values> full, const DrawnSide& side, const SurrogateMark& mark,
                     Agreement& sum) {
  OwnError own{.limit = kQuantileLimit};
  for (const DrawnSide::Metric& one : side.metrics) {
    sum.metrics.push_back(metric_agreement(full, one.column, one.m, one.whole, own, sum));
    sum.metrics.back().metric = mark.metrics[one.m].id;
  }
  sum.quantile_own_sd = own.rms();
}

void compare_pairs(std::span<const Values> full, const DrawnSide& side, const SurrogateMark& mark, Agreement& sum) {
  OwnError own{.limit = kPairLimit};
  for (const DrawnSide::Pair& pair : side.pairs) {
    const auto found = rank_correlation(full, pair.m, full, pair.k);
    if (!found) continue;
    ++sum.pairs;
    const double off = std::abs(found->rho - pair.rho);
    sum.off.pairs += off > kPairLimit ? 1U : 0U;
    // Of the attempts, were the surrogate right: in a few of them two metrics may go together without exception.
    const double error = error_of({pair.rho, found->n});
    own.add(off, error);
    count_comparison(off, kPairLimit, error, sum);
    sum.beyond_chance.pairs += off > kPairLimit + kErrors * error ? 1U : 0U;
    if (off > sum.worst_rank_correlation) {
      sum.worst_rank_correlation = off;
      sum.rank_correlation_error = error;
      sum.worst_pair = mark.metrics[pair.m].id + " and " + mark.metrics[pair.k].id;
    }
  }
  sum.rank_correlation_own = own.rms();
}

}  // namespace

Agreement agreement_of(const Surrogate& surrogate, std::span<const SimulatedPoint> held_out, std::size_t draws_each,
                       std::uint64_t seed) {
  const std::vector<Values> full = whole(held_out), drawn = drawn_for(surrogate, held_out, draws_each, seed);
  const DrawnSide side = drawn_side(surrogate, full, drawn);
  const auto compared = [&](std::span<const Values> rows) {
    Agreement sum;
    compare_metrics(rows, side, surrogate.mark(), sum);
    compare_pairs(rows, side, surrogate.mark(), sum);
    return sum;
  };
  Agreement sum = compared(full);
  sum.attempts = full.size();
  sum.draws = drawn.size();
  std::array<std::vector<std::size_t>, 3> counts;
  for (std::size_t i = 0; i < Agreement::kFaultless; ++i) {
    const std::uint64_t own = base::hash_combine(seed, std::uint64_t{i});
    const Off off = compared(drawn_for(surrogate, held_out, 1, own)).off;
    counts[0].push_back(off.quantiles);
    counts[1].push_back(off.shares);
    counts[2].push_back(off.pairs);
  }
  for (auto& one : counts) std::sort(one.begin(), one.end());
  constexpr std::size_t kMiddle = Agreement::kFaultless / 2, kMost = Agreement::kFaultless - 1;
  sum.off_without_fault = {counts[0][kMiddle], counts[1][kMiddle], counts[2][kMiddle]};
  sum.most_off_without_fault = {counts[0][kMost], counts[1][kMost], counts[2][kMost]};
  return sum;
}

// Two attempts of one place would be of the same person on the same occasion.
bool was_fitted_to(const Surrogate& surrogate, std::span<const SimulatedPoint> attempts) {
  std::set<Place> known;
  for (const SimulatedPoint& one : surrogate.attempts()) known.insert(one.place);
  return std::any_of(attempts.begin(), attempts.end(),
                     [&](const SimulatedPoint& one) { return known.contains(one.place); });
}

std::vector<EffectAgreement> effects_of(const Surrogate& surrogate, std::span<const SimulatedPoint> less,
                                        std::span<const SimulatedPoint> more, std::size_t draws_each,
                                        std::uint64_t seed) {
  std::vector<EffectAgreement> effects;
  const std::vector<Values> full[] = {whole(less), whole(more)};
  const std::vector<Values> drawn[] = {drawn_for(surrogate, less, draws_each, seed),
                                       drawn_for(surrogate, more, draws_each, base::mix64(seed))};
  for (std::size_t m = 0; m < surrogate.mark().metrics.size(); ++m) {
    const auto a = values_of(full[0], m), b = values_of(full[1], m);
    const auto x = values_of(drawn[0], m), y = values_of(drawn[1], m);
    if (std::min({a.size(), b.size(), x.size(), y.size()}) < kFewestCompared) continue;
    const auto roc = statistics::roc_area(b, a);
    if (!(roc.variance() > 0.0)) continue;  // the same in all
    EffectAgreement& made = effects.emplace_back();
    made.metric = surrogate.mark().metrics[m].id;
    made.area = roc.area;
    made.area_error = std::sqrt(roc.variance());
    made.area_drawn = statistics::roc_area(y, x).area;
    made.d = difference_of(a, b);
    made.d_drawn = difference_of(x, y);
    const auto n1 = static_cast<double>(a.size()), n2 = static_cast<double>(b.size());
    made.d_error = std::sqrt((n1 + n2) / (n1 * n2) + made.d * made.d / (2.0 * (n1 + n2)));
    made.pairs = rank_correlation(full[0], m, full[1], m).value_or(RankCorrelation{}).rho;
  }
  return effects;
}

}  // namespace seldinger::assessment::population
