#include "assessment/statistics/relations/discrimination.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "assessment/statistics/distributions.h"
#include "assessment/statistics/ranks.h"
#include "assessment/statistics/relations/observations.h"
#include "assessment/statistics/roots.h"

namespace seldinger::assessment::statistics {
namespace {

// Smaller, a variance of areas is one of rounding errors.
constexpr double kLeastVariance = 1e-15;

double sample_covariance(std::span<const double> a, std::span<const double> b) {
  const auto n = static_cast<double>(a.size());
  const double mean_a = std::accumulate(a.begin(), a.end(), 0.0) / n;
  const double mean_b = std::accumulate(b.begin(), b.end(), 0.0) / n;
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - mean_a) * (b[i] - mean_b);
  return sum / (n - 1.0);
}

// Hanley and McNeil's, for equal numbers of exponential values, as Newcombe takes it.
double exponential_variance(double area, double positive, double negative) {
  const double each = 0.5 * (positive + negative) - 1.0;
  return area * (1.0 - area) * (1.0 + each * ((1.0 - area) / (2.0 - area) + area / (1.0 + area))) /
         (positive * negative);
}

// Which groups are negative and positive, and why they cannot be told.
struct Sides {
  Observations rows;
  std::size_t positive = 0;
  const char* reason = nullptr;
  const char* note = nullptr;

  std::size_t negative() const { return 1 - positive; }
};

Sides sides_of(const DataTable& table, const ProcedureOptions& options, std::size_t columns) {
  Sides sides{.rows = observations(table, {.columns = columns, .group = true}, options)};
  sides.reason = not_two_groups(sides.rows, 2);
  if (sides.reason != nullptr) return sides;
  const std::vector<std::string>& groups = sides.rows.groups;
  sides.positive = groups[1] > groups[0];
  if (!options.has("positive")) return sides;
  const auto named = std::find(groups.begin(), groups.end(), options.text("positive"));
  if (named == groups.end()) {
    sides.reason = "bad_value";
    sides.note = "The option positive names none of the groups.";
  } else {
    sides.positive = static_cast<std::size_t>(named - groups.begin());
  }
  return sides;
}

RocArea area_of(const Sides& sides, std::size_t column = 0) {
  return roc_area(sides.rows.values_of(sides.positive, column), sides.rows.values_of(sides.negative(), column));
}

// The cut with the largest sum of sensitivity and specificity, half-way between two values; the lowest of several.
void add_youden(Answer& answer, std::vector<double> positive, std::vector<double> negative) {
  std::vector<double> all(positive);
  all.insert(all.end(), negative.begin(), negative.end());
  std::sort(all.begin(), all.end());
  std::sort(positive.begin(), positive.end());
  std::sort(negative.begin(), negative.end());
  const auto share_below = [](const std::vector<double>& sorted, double value) {
    return static_cast<double>(std::upper_bound(sorted.begin(), sorted.end(), value) - sorted.begin()) /
           static_cast<double>(sorted.size());
  };
  double best = -1.0, cut = 0.0, sensitivity = 0.0, specificity = 0.0;
  for (std::size_t i = 0; i + 1 < all.size(); ++i) {
    if (all[i] == all[i + 1]) continue;
    const double sens = 1.0 - share_below(positive, all[i]), spec = share_below(negative, all[i]);
    if (sens + spec <= best + 1e-12) continue;
    best = sens + spec;
    cut = 0.5 * all[i] + 0.5 * all[i + 1];
    sensitivity = sens;
    specificity = spec;
  }
  if (best < 0.0) return;
  answer.more.push_back({"youden_cut", cut});
  answer.more.push_back({"youden_sensitivity", sensitivity});
  answer.more.push_back({"youden_specificity", specificity});
}

}  // namespace

double RocArea::variance() const {
  return roc_covariance(*this, *this);
}

RocArea roc_area(std::span<const double> positive, std::span<const double> negative) {
  std::vector<double> all(positive.begin(), positive.end());
  all.insert(all.end(), negative.begin(), negative.end());
  const std::vector<double> among_all = midranks(all), among_own = midranks(positive);
  const std::vector<double> among_negative = midranks(negative);
  const auto m = static_cast<double>(positive.size()), n = static_cast<double>(negative.size());
  RocArea found;
  for (std::size_t i = 0; i < positive.size(); ++i) found.of_positive.push_back((among_all[i] - among_own[i]) / n);
  for (std::size_t i = 0; i < negative.size(); ++i)
    found.of_negative.push_back(1.0 - (among_all[positive.size() + i] - among_negative[i]) / m);
  found.area = std::accumulate(found.of_positive.begin(), found.of_positive.end(), 0.0) / m;
  return found;
}

double roc_covariance(const RocArea& a, const RocArea& b) {
  return sample_covariance(a.of_positive, b.of_positive) / static_cast<double>(a.of_positive.size()) +
         sample_covariance(a.of_negative, b.of_negative) / static_cast<double>(a.of_negative.size());
}

Interval newcombe_area_interval(double area, std::size_t positive, std::size_t negative) {
  const double z = normal_quantile_of(0.975);
  const auto distance = [&](double other) {
    const double variance =
        exponential_variance(other, static_cast<double>(positive), static_cast<double>(negative));
    return std::abs(area - other) - z * std::sqrt(std::max(0.0, variance));
  };
  // Below the area the distance falls from its whole to minus the half-width, above it rises again.
  return {area <= 0.0 ? 0.0 : root_between(0.0, std::nextafter(area, 0.5), distance),
          area >= 1.0 ? 1.0 : root_between(std::max(area, 1e-200), 1.0, distance)};
}

Interval roc_interval(const RocArea& roc) {
  const double variance = roc.variance(), area = roc.area;
  if (!(variance > kLeastVariance) || !(area > 0.0 && area < 1.0))
    return newcombe_area_interval(area, roc.of_positive.size(), roc.of_negative.size());
  const double middle = std::log(area / (1.0 - area));
  const double half = normal_quantile_of(0.975) * std::sqrt(variance) / (area * (1.0 - area));
  return {1.0 / (1.0 + std::exp(half - middle)), 1.0 / (1.0 + std::exp(-half - middle))};
}

Answer auc(const DataTable& table, const ProcedureOptions& options) {
  const Sides sides = sides_of(table, options, 1);
  if (sides.reason != nullptr) return refused("auc", sides.reason, sides.rows, sides.note);
  const RocArea roc = area_of(sides);
  const Observations& rows = sides.rows;
  Answer answer = begun("auc", rows);
  answer.method = "area under the empirical ROC curve, interval by the logit of DeLong's variance";
  answer.estimate_name =
      "P(" + rows.groups[sides.positive] + " > " + rows.groups[sides.negative()] + ") + ½ P(equal)";
  answer.estimate = roc.area;
  answer.ci95 = roc_interval(roc);
  const double error = std::sqrt(std::max(0.0, roc.variance())), z = normal_quantile_of(0.975);
  if (roc.variance() > kLeastVariance) {
    answer.more = {{"delong_se", error},
                   {"delong_low", std::max(0.0, roc.area - z * error)},
                   {"delong_high", std::min(1.0, roc.area + z * error)}};
  }
  if (!(roc.area > 0.0 && roc.area < 1.0)) {
    answer.method = "area under the empirical ROC curve, Newcombe's score interval (his method 5)";
    answer.notes.emplace_back(
        "The two groups do not overlap: DeLong's interval would have no width; Newcombe's is given.");
  } else if (!(roc.variance() > kLeastVariance)) {
    answer.method = "area under the empirical ROC curve, Newcombe's score interval (his method 5)";
    answer.notes.emplace_back("DeLong's variance is zero here; Newcombe's interval is given.");
  }
  if (roc.area < 0.5) answer.notes.emplace_back("Below one half: the group named first has the lower values.");
  add_youden(answer, rows.values_of(sides.positive), rows.values_of(sides.negative()));
  return settled(std::move(answer));
}

Answer delong(const DataTable& table, const ProcedureOptions& options) {
  const Sides sides = sides_of(table, options, 2);
  if (sides.reason != nullptr) return refused("delong", sides.reason, sides.rows, sides.note);
  const RocArea first = area_of(sides, 0), second = area_of(sides, 1);
  const double difference = first.area - second.area;
  const double variance = first.variance() + second.variance() - 2.0 * roc_covariance(first, second);
  Answer answer = begun("delong", sides.rows);
  answer.method = "DeLong's test of two areas under ROC curves of the same persons, normal interval";
  answer.estimate_name = "area of " + table.values[0].name + " − area of " + table.values[1].name;
  answer.estimate = difference;
  answer.more = {{"area_first", first.area}, {"area_second", second.area}};
  if (variance > kLeastVariance) {
    const double error = std::sqrt(variance), half = normal_quantile_of(0.975) * error;
    answer.statistic = difference / error;
    answer.p_value = 2.0 * normal_upper(std::abs(*answer.statistic));
    answer.ci95 = Interval{std::max(-1.0, difference - half), std::min(1.0, difference + half)};
  } else {
    answer.notes.emplace_back("Both values order every pair of persons alike: there is nothing to test.");
  }
  warn_of_interval(answer, 20);
  return settled(std::move(answer));
}

}  // namespace seldinger::assessment::statistics
