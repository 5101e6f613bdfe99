#include "assessment/population/studies/dose_response.h"

#include <algorithm>
#include <cmath>

#include "assessment/population/streams.h"
#include "assessment/statistics/groups/effect_sizes.h"
#include "assessment/statistics/relations/correlation.h"
#include "assessment/statistics/relations/discrimination.h"
#include "sim/base/exact_math.h"

namespace seldinger::assessment::population {
namespace {

constexpr std::size_t kCrowd = 20'000;  // areas of so many are found at once, and their mean is the truth
constexpr std::size_t kFewest = 2;      // with a value, in either group
constexpr double kMostSkewness = 0.5, kMostKurtosis = 1.0;
constexpr std::uint64_t kTruthStudy = 0;  // the number of the study that tells the truth: none of those drawn

using Rows = std::vector<Values>;

// The people of a study from one number to another, at one attempt each.
Rows drawn_people(const Surrogate& surrogate, const Group& group, std::uint64_t seed, std::uint64_t study,
                  std::size_t first, std::size_t past) {
  const std::uint64_t key = base::hash_combine(base::hash_combine(0x646f7365ULL, seed), study);
  Rows rows;
  for (std::size_t number = first; number < past; ++number)
    rows.push_back(surrogate.draw(drawn_person(group, key, number), {1, 0, 0.0}));
  return rows;
}

// Whom the shifted are held against: the same abilities as those of shift 0, and other people.
Group others() {
  Group group = shifted_group(0.0);
  group.name = "others";
  return group;
}

double paired_correlation(const Rows& a, const Rows& b, std::size_t m) {
  std::vector<double> x, y;
  for (std::size_t i = 0; i < std::min({a.size(), b.size(), kPairs}); ++i)
    if (a[i][m] && b[i][m]) {
      x.push_back(*a[i][m]);
      y.push_back(*b[i][m]);
    }
  const double rho = statistics::rank_correlation(x, y);
  return std::isnan(rho) ? 0.0 : rho;
}

// Sums of a crowd's values, whole parts at a time.
struct Moments {
  double n = 0.0, mean = 0.0, second = 0.0, third = 0.0, fourth = 0.0;  // about the mean
  void add(double x) {                                                  // Pébay, Sandia report SAND2008-6212
    const double before = n++, delta = x - mean, part = delta / n, square = part * part,
                 term = delta * part * before;
    mean += part;
    fourth += term * square * (n * n - 3.0 * n + 3.0) + 6.0 * square * second - 4.0 * part * third;
    third += term * part * (n - 2.0) - 3.0 * part * second;
    second += term;
  }
  bool is_normal_enough() const {
    if (!(second > 0.0)) return false;
    const double skewness = std::sqrt(n) * third / std::pow(second, 1.5);
    return std::abs(skewness) <= kMostSkewness && std::abs(n * fourth / (second * second) - 3.0) <= kMostKurtosis;
  }
};

// Of a crowd's values, and of their logarithms where each has one.
struct Scales {
  Moments plain, logarithm;
  bool positive = true;
  void add(double x) {
    plain.add(x);
    positive = positive && x > 0.0;
    if (positive) logarithm.add(base::exact_log(x));
  }
};

std::optional<double> difference_of(const Moments& less, const Moments& more) {
  if (!less.is_normal_enough() || !more.is_normal_enough()) return std::nullopt;
  return (more.mean - less.mean) / std::sqrt((less.second + more.second) / (less.n + more.n - 2.0));
}

void add_difference(const Scales& less, const Scales& more, MetricResponse& one) {
  one.d = difference_of(less.plain, more.plain);
  one.of_logarithms = !one.d && less.positive && more.positive;
  if (one.of_logarithms) one.d = difference_of(less.logarithm, more.logarithm);
}

std::vector<double> logarithms_of(std::vector<double> x) {
  for (double& one : x) one = base::exact_log(one);
  return x;
}

// By metric and shift.
using Responses = std::vector<std::vector<MetricResponse>>;

// What of each metric is true, and the pairs; answers which metrics are not the same in all.
std::vector<bool> add_truth(const Surrogate& surrogate, std::span<const Group> groups, const DoseOptions& options,
                            Responses& responses) {
  const std::size_t metrics = responses.size();
  std::vector<bool> varies(metrics, false);
  std::vector<std::vector<double>> sums(metrics, std::vector<double>(groups.size())), weights = sums;
  std::vector<Scales> of_others(metrics);
  std::vector<std::vector<Scales>> of_shifted(metrics, std::vector<Scales>(groups.size()));
  for (std::size_t first = 1; first <= options.truth_people; first += kCrowd) {
    const std::size_t past = std::min(first + kCrowd, options.truth_people + 1);
    const Rows base = drawn_people(surrogate, others(), options.seed, kTruthStudy, first, past);
    for (std::size_t m = 0; m < metrics; ++m)
      for (const double one : values_of(base, m)) of_others[m].add(one);
    for (std::size_t s = 0; s < groups.size(); ++s) {
      const Rows rows = drawn_people(surrogate, groups[s], options.seed, kTruthStudy, first, past);
      for (std::size_t m = 0; m < metrics; ++m) {
        const auto less = values_of(base, m), more = values_of(rows, m);
        for (const double one : more) of_shifted[m][s].add(one);
        if (std::min(less.size(), more.size()) < kFewest) continue;
        const auto roc = statistics::roc_area(more, less);
        varies[m] = varies[m] || roc.variance() > 0.0;
        const double pairs = static_cast<double>(less.size()) * static_cast<double>(more.size());
        sums[m][s] += pairs * roc.area;
        weights[m][s] += pairs;
        if (first == 1) responses[m][s].paired = paired_correlation(base, rows, m);
      }
    }
  }
  for (std::size_t m = 0; m < metrics; ++m)
    for (std::size_t s = 0; s < groups.size(); ++s)
      if (weights[m][s] > 0.0) {
        responses[m][s].area = sums[m][s] / weights[m][s];
        add_difference(of_others[m], of_shifted[m][s], responses[m][s]);
      }
  return varies;
}

void add_study(const Rows& base, const Rows& rows, std::size_t m, MetricResponse& one) {
  const auto less = values_of(base, m), more = values_of(rows, m);
  if (std::min(less.size(), more.size()) < kFewest) return;
  const auto interval = statistics::roc_interval(statistics::roc_area(more, less));
  ++one.intervals;
  one.mean_width += (interval.high - interval.low - one.mean_width) / static_cast<double>(one.intervals);
  one.covered += interval.low <= one.area && one.area <= interval.high ? 1U : 0U;
  if (!one.d) return;
  const auto d = one.of_logarithms ? statistics::cohen_d(logarithms_of(more), logarithms_of(less))
                                   : statistics::cohen_d(more, less);
  if (!d.ci95) return;
  ++one.d_intervals;
  one.d_covered += d.ci95->low <= *one.d && *one.d <= d.ci95->high ? 1U : 0U;
}

}  // namespace

std::vector<MetricDose> dose_response(const Surrogate& surrogate, std::span<const double> shifts,
                                      const DoseOptions& options) {
  std::vector<Group> groups;
  for (const double shift : shifts) groups.push_back(shifted_group(shift));
  Responses responses(surrogate.mark().metrics.size(), std::vector<MetricResponse>(shifts.size()));
  const std::vector<bool> varies = add_truth(surrogate, groups, options, responses);
  for (std::size_t study = 1; study <= options.studies; ++study) {
    const Rows base = drawn_people(surrogate, others(), options.seed, study, 1, options.per_group + 1);
    for (std::size_t s = 0; s < groups.size(); ++s) {
      const Rows rows = drawn_people(surrogate, groups[s], options.seed, study, 1, options.per_group + 1);
      for (std::size_t m = 0; m < responses.size(); ++m)
        if (varies[m]) add_study(base, rows, m, responses[m][s]);
    }
  }
  std::vector<MetricDose> doses;
  for (std::size_t m = 0; m < responses.size(); ++m)
    if (varies[m]) doses.push_back({surrogate.mark().metrics[m].id, std::move(responses[m])});
  return doses;
}

}  // namespace seldinger::assessment::population
