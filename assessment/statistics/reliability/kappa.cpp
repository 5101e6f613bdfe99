#include "assessment/statistics/reliability/kappa.h"

#include <algorithm>
#include <cmath>

#include "assessment/statistics/distributions.h"

namespace seldinger::assessment::statistics {
namespace {

constexpr std::size_t kMostCategories = 100;
constexpr std::size_t kLargeSample = 100;  // with 30 the interval covers .92: reliability_long_test.cpp
constexpr double kTwoSided95 = 1.959963984540054;

double weight(double a, double b, double range, KappaWeights weights) {
  if (a == b) return 1.0;
  const double distance = std::abs(a - b) / range;
  switch (weights) {
    case KappaWeights::kNone:
      return 0.0;
    case KappaWeights::kLinear:
      return 1.0 - distance;
    case KappaWeights::kQuadratic:
      return 1.0 - distance * distance;
  }
  return 0.0;
}

const char* method_of(KappaWeights weights) {
  switch (weights) {
    case KappaWeights::kNone:
      return "Cohen's kappa, unweighted; large-sample interval; test of no agreement beyond chance, by z";
    case KappaWeights::kLinear:
      return "Cohen's kappa, linear weights; large-sample interval; test of no agreement beyond chance, by z";
    case KappaWeights::kQuadratic:
      return "Cohen's kappa, quadratic weights; large-sample interval; test of no agreement beyond chance, by z";
  }
  return "";
}

std::vector<double> categories_of(const CompleteTable& table) {
  std::vector<double> found = table.values;
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

std::vector<Row> pairs_of_raters(const CompleteTable& table, std::span<const double> categories,
                                 KappaWeights weights) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < table.columns.size(); ++i)
    for (std::size_t j = i + 1; j < table.columns.size(); ++j) {
      const Kappa one = kappa_of(table.column(i), table.column(j), categories, weights);
      rows.push_back({table.columns[i] + " – " + table.columns[j],
                      {{"kappa", one.value}, {"observed", one.observed}, {"expected", one.expected}}});
    }
  return rows;
}

// Light's kappa without the subject at `without`; all stand where that is none of them.
double light_kappa(const CompleteTable& table, std::span<const double> categories, KappaWeights weights,
                   std::size_t without) {
  std::vector<std::vector<double>> columns;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    columns.push_back(table.column(i));
    if (without < table.rows) columns.back().erase(columns.back().begin() + static_cast<std::ptrdiff_t>(without));
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < columns.size(); ++i)
    for (std::size_t j = i + 1; j < columns.size(); ++j)
      sum += kappa_of(columns[i], columns[j], categories, weights).value;
  return 2.0 * sum / static_cast<double>(columns.size() * (columns.size() - 1));
}

// By leaving out one subject after the other (Efron, Tibshirani, An Introduction to the Bootstrap, 1993, ch. 11);
// NaN where without one of them nothing is left to agree on.
double jackknife_error(const CompleteTable& table, std::span<const double> categories, KappaWeights weights) {
  std::vector<double> without;
  double mean = 0.0;
  const double n = static_cast<double>(table.rows);
  for (std::size_t i = 0; i < table.rows; ++i) {
    without.push_back(light_kappa(table, categories, weights, i));
    mean += without.back() / n;
  }
  double squares = 0.0;
  for (const double one : without) squares += (one - mean) * (one - mean);
  return std::sqrt((n - 1.0) / n * squares);
}

void say_of_several_raters(Answer& answer, const CompleteTable& table, std::span<const double> categories,
                           KappaWeights weights) {
  answer.method += "; Light's mean over all pairs of raters, interval by the jackknife over subjects";
  answer.rows = pairs_of_raters(table, categories, weights);
  answer.estimate = light_kappa(table, categories, weights, table.rows);
  const double se = jackknife_error(table, categories, weights);
  if (std::isfinite(se) && se > 0.0 && table.rows > 2) {
    const double reach = student_t_quantile(0.975, static_cast<double>(table.rows) - 1.0) * se;
    answer.more.push_back({"se", se});
    answer.ci95 = Interval{std::max(-1.0, *answer.estimate - reach), std::min(1.0, *answer.estimate + reach)};
    if (answer.n < kLargeSample) answer.notes.emplace_back("Under 100 subjects the interval may be too narrow.");
  } else {
    answer.notes.emplace_back("Too few subjects differ for an interval.");
  }
}

void say_of_two_raters(Answer& answer, const Kappa& found) {
  answer.estimate = found.value;
  answer.more = {{"observed_agreement", found.observed}, {"expected_agreement", found.expected}, {"se", found.se}};
  answer.statistic = found.value / found.se_of_none;
  answer.p_value = 2.0 * normal_upper(std::abs(*answer.statistic));
  if (found.se > 0.0 && answer.n < kLargeSample)
    answer.notes.emplace_back("Under 100 subjects the large-sample interval may be too narrow.");
  if (found.se > 0.0)
    answer.ci95 = Interval{std::max(-1.0, found.value - kTwoSided95 * found.se),
                           std::min(1.0, found.value + kTwoSided95 * found.se)};
  else
    answer.notes.emplace_back("The standard error is 0 here: an interval would say nothing.");
}

}  // namespace

Kappa kappa_of(std::span<const double> a, std::span<const double> b, std::span<const double> categories,
               KappaWeights weights) {
  const std::size_t k = categories.size();
  const double n = static_cast<double>(a.size()), range = categories.back() - categories.front();
  std::vector<double> share(k * k), of_a(k), of_b(k), toward_a(k), toward_b(k);
  const auto index = [&](double value) {
    return static_cast<std::size_t>(std::lower_bound(categories.begin(), categories.end(), value) -
                                    categories.begin());
  };
  for (std::size_t i = 0; i < a.size(); ++i) {
    share[index(a[i]) * k + index(b[i])] += 1.0 / n;
    of_a[index(a[i])] += 1.0 / n;
    of_b[index(b[i])] += 1.0 / n;
  }
  Kappa found;
  const auto w = [&](std::size_t i, std::size_t j) { return weight(categories[i], categories[j], range, weights); };
  for (std::size_t i = 0; i < k; ++i)
    for (std::size_t j = 0; j < k; ++j) {
      found.observed += w(i, j) * share[i * k + j];
      found.expected += w(i, j) * of_a[i] * of_b[j];
      toward_a[i] += w(i, j) * of_b[j];
      toward_b[j] += w(i, j) * of_a[i];
    }
  const double miss = 1.0 - found.expected;
  found.value = (found.observed - found.expected) / miss;
  double about = 0.0, none = 0.0;
  for (std::size_t i = 0; i < k; ++i)
    for (std::size_t j = 0; j < k; ++j) {
      const double mean = toward_a[i] + toward_b[j];
      about += share[i * k + j] * std::pow(w(i, j) * miss - mean * (1.0 - found.observed), 2.0);
      none += of_a[i] * of_b[j] * std::pow(w(i, j) - mean, 2.0);
    }
  about -= std::pow(found.observed * found.expected - 2.0 * found.expected + found.observed, 2.0);
  none -= found.expected * found.expected;
  // Less than rounding is none.
  found.se = about > 1e-15 ? std::sqrt(about / n) / (miss * miss) : 0.0;
  found.se_of_none = none > 1e-15 ? std::sqrt(none / n) / miss : 0.0;
  return found;
}

Answer kappa(const CompleteTable& table, KappaWeights weights) {
  if (const char* reason = smaller_than(table, 2, 2)) return refused_table("kappa", reason, table);
  const bool whole = std::all_of(table.values.begin(), table.values.end(),
                                 [](double one) { return std::floor(one) == one && std::abs(one) <= 1e9; });
  if (!whole) return refused_table("kappa", "bad_value", table, "Categories are whole numbers.");
  const std::vector<double> categories = categories_of(table);
  if (categories.size() < 2) return refused_table("kappa", "no_variation", table);
  if (categories.size() > kMostCategories)
    return refused_table("kappa", "too_many", table, "At most 100 categories: are these measurements, for an ICC?");
  Answer answer;
  answer.test = "kappa";
  answer.method = method_of(weights);
  answer.n = table.rows;
  answer.missing = table.missing;
  answer.estimate_name = "kappa";
  if (table.columns.size() == 2) {
    say_of_two_raters(answer, kappa_of(table.column(0), table.column(1), categories, weights));
  } else {
    say_of_several_raters(answer, table, categories, weights);
  }
  answer.more.push_back({"categories", static_cast<double>(categories.size())});
  if (table.missing > 0) answer.notes.emplace_back("Subjects that some rater did not score are left out.");
  return settled(std::move(answer));
}

}  // namespace seldinger::assessment::statistics
