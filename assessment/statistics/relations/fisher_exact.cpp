#include "assessment/statistics/relations/fisher_exact.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "assessment/statistics/distributions.h"
#include "assessment/statistics/relations/observations.h"
#include "assessment/statistics/relations/proportions.h"
#include "assessment/statistics/roots.h"

namespace seldinger::assessment::statistics {
namespace {

// Persons above which a table of all probabilities is no longer made.
constexpr std::size_t kMostPersons = 20000;
// R's: what is as probable up to rounding counts as as probable.
constexpr double kAsProbable = 1.0 + 1e-7;
// Logarithms of odds ratios are sought between minus and plus this.
constexpr double kWidestLogOdds = 600.0;

// The first group's count given all margins, when the odds ratio is exp(log_odds).
class Conditional {
 public:
  explicit Conditional(const FourFold& table)
      : first_(std::max<std::int64_t>(0, table.k1 + table.k2 - table.n2)), observed_(table.k1 - first_) {
    const std::int64_t marked = table.k1 + table.k2, total = table.n1 + table.n2;
    const std::int64_t last = std::min(marked, table.n1);
    for (std::int64_t k = first_; k <= last; ++k)
      log_central_.push_back(std::log(hypergeometric_pdf(k, marked, table.n1, total)));
  }

  std::size_t size() const { return log_central_.size(); }
  bool at_low_end() const { return observed_ == 0; }
  bool at_high_end() const { return observed_ + 1 == static_cast<std::int64_t>(size()); }

  std::vector<double> shares(double log_odds) const {
    std::vector<double> weights(size());
    double largest = -1e300;
    for (std::size_t i = 0; i < size(); ++i) {
      weights[i] = log_central_[i] + static_cast<double>(i) * log_odds;
      largest = std::max(largest, weights[i]);
    }
    double sum = 0.0;
    for (double& weight : weights) sum += weight = std::exp(weight - largest);
    for (double& weight : weights) weight /= sum;
    return weights;
  }

  double two_sided() const {
    const std::vector<double> central = shares(0.0);
    const double limit = central[observed()] * kAsProbable;
    double p = 0.0;
    for (const double share : central)
      if (share <= limit) p += share;
    return p;
  }

  double mean_above_observed(double log_odds) const {
    const std::vector<double> at = shares(log_odds);
    double mean = 0.0;
    for (std::size_t i = 0; i < at.size(); ++i)
      mean += at[i] * (static_cast<double>(i) - static_cast<double>(observed_));
    return mean;
  }
  double at_most(double log_odds) const { return part(log_odds, 0, observed() + 1); }
  double at_least(double log_odds) const { return part(log_odds, observed(), size()); }

 private:
  std::size_t observed() const { return static_cast<std::size_t>(observed_); }
  double part(double log_odds, std::size_t from, std::size_t to) const {
    const std::vector<double> at = shares(log_odds);
    double sum = 0.0;
    for (std::size_t i = from; i < to; ++i) sum += at[i];
    return sum;
  }

  std::int64_t first_, observed_;
  std::vector<double> log_central_;
};

template <typename Function>
double odds_where(const Function& function) {
  return std::exp(root_between(-kWidestLogOdds, kWidestLogOdds, function));
}

FourFold table_of(const Observations& rows) {
  FourFold table;
  for (std::size_t i = 0; i < rows.n; ++i) {
    const auto hit = static_cast<std::int64_t>(rows.values[0][i]);
    (rows.group[i] == 0 ? table.k1 : table.k2) += hit;
    ++(rows.group[i] == 0 ? table.n1 : table.n2);
  }
  return table;
}

}  // namespace

FisherExact fisher_exact_of(const FourFold& table) {
  const Conditional conditional(table);
  FisherExact found;
  if (conditional.size() < 2) return found;  // the margins leave one table: p is 1, the odds ratio anything
  found.p_value = conditional.two_sided();
  if (conditional.at_low_end()) {
    found.odds_ratio = found.odds_low = 0.0;
  } else {
    found.odds_low = odds_where([&](double odds) { return conditional.at_least(odds) - 0.025; });
  }
  if (!conditional.at_high_end()) {
    found.odds_high = odds_where([&](double odds) { return conditional.at_most(odds) - 0.025; });
    if (!conditional.at_low_end())
      found.odds_ratio = odds_where([&](double odds) { return conditional.mean_above_observed(odds); });
  }
  return found;
}

Answer fisher_exact(const DataTable& table, const ProcedureOptions& options) {
  const Observations rows = observations(table, {.group = true}, options);
  if (const char* reason = not_two_groups(rows, 1)) return refused("fisher", reason, rows);
  if (!all_zero_or_one(rows.values[0]))
    return refused("fisher", "bad_value", rows, "A share is made of 0 (failed) and 1 (passed).");
  if (rows.n > kMostPersons) return refused("fisher", "too_many", rows);
  const FourFold counts = table_of(rows);
  const FisherExact exact = fisher_exact_of(counts);
  Answer answer = begun("fisher", rows);
  answer.method =
      "Fisher's exact test, two-sided: tables no more probable than this one; odds ratio by conditional maximum "
      "likelihood with exact interval; difference of shares with Newcombe's hybrid score interval (his method 10)";
  answer.p_value = exact.p_value;
  answer.estimate_name = "odds ratio (" + rows.groups[0] + " / " + rows.groups[1] + ")";
  answer.estimate = exact.odds_ratio;
  if (exact.odds_low && exact.odds_high) answer.ci95 = Interval{*exact.odds_low, *exact.odds_high};
  const auto share = [](std::int64_t k, std::int64_t n) { return static_cast<double>(k) / static_cast<double>(n); };
  const double first = share(counts.k1, counts.n1), second = share(counts.k2, counts.n2);
  const Interval difference = newcombe_interval(counts.k1, counts.n1, counts.k2, counts.n2);
  answer.more = {{"share_first", first},
                 {"share_second", second},
                 {"risk_difference", first - second},
                 {"risk_difference_low", difference.low},
                 {"risk_difference_high", difference.high}};
  if (exact.odds_low && !exact.odds_high) {
    answer.more.push_back({"odds_ratio_low", *exact.odds_low});
    answer.notes.emplace_back(
        "The odds ratio has no upper bound here: `odds_ratio_low` is its lower one (97.5 %, one-sided).");
  }
  if (!exact.odds_low)
    answer.notes.emplace_back("All had the same outcome: these data say nothing about the odds ratio.");
  return settled(std::move(answer));
}

}  // namespace seldinger::assessment::statistics
