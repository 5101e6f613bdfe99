#include "assessment/statistics/relations/proportions.h"

#include <algorithm>
#include <cmath>

#include "assessment/statistics/distributions.h"
#include "assessment/statistics/relations/observations.h"

namespace seldinger::assessment::statistics {
namespace {

// Above, what is enumerated costs more than it tells.
constexpr std::int64_t kMostEnumerated = 2000;

struct Passed {
  std::int64_t k = 0, n = 0;
  double share() const { return static_cast<double>(k) / static_cast<double>(n); }
};

Passed passed_of(const std::vector<double>& values) {
  return {std::count(values.begin(), values.end(), 1.0), static_cast<std::int64_t>(values.size())};
}

Row row_of(const GroupCount& group, const Passed& passed) {
  const Interval wilson = wilson_interval(passed.k, passed.n);
  const Interval exact = clopper_pearson_interval(passed.k, passed.n);
  return {group.name,
          {{"passed", static_cast<double>(passed.k)},
           {"n", static_cast<double>(passed.n)},
           {"share", passed.share()},
           {"low", wilson.low},
           {"high", wilson.high},
           {"clopper_pearson_low", exact.low},
           {"clopper_pearson_high", exact.high}}};
}

}  // namespace

Interval wilson_interval(std::int64_t k, std::int64_t n) {
  const double z = normal_quantile_of(0.975), z2 = z * z;
  const auto size = static_cast<double>(n), hits = static_cast<double>(k);
  const double middle = (hits + 0.5 * z2) / (size + z2);
  const double half = z / (size + z2) * std::sqrt(hits * (size - hits) / size + 0.25 * z2);
  return {k == 0 ? 0.0 : std::max(0.0, middle - half), k == n ? 1.0 : std::min(1.0, middle + half)};
}

Interval clopper_pearson_interval(std::int64_t k, std::int64_t n) {
  const auto size = static_cast<double>(n), hits = static_cast<double>(k);
  return {k == 0 ? 0.0 : beta_quantile(0.025, hits, size - hits + 1.0),
          k == n ? 1.0 : beta_quantile(0.975, hits + 1.0, size - hits)};
}

double wilson_coverage(std::int64_t n, double p) {
  double covered = 0.0;
  for (std::int64_t k = 0; k <= n; ++k) {
    const Interval interval = wilson_interval(k, n);
    if (interval.low <= p && p <= interval.high) covered += binomial_pdf(k, n, p);
  }
  return covered;
}

Interval newcombe_interval(std::int64_t k1, std::int64_t n1, std::int64_t k2, std::int64_t n2) {
  const Passed first{k1, n1}, second{k2, n2};
  const Interval a = wilson_interval(k1, n1), b = wilson_interval(k2, n2);
  const double difference = first.share() - second.share();
  return {difference - std::hypot(first.share() - a.low, b.high - second.share()),
          difference + std::hypot(a.high - first.share(), second.share() - b.low)};
}

Answer one_proportion(const DataTable& table, const ProcedureOptions& options) {
  const Observations rows = observations(table, {.group = true}, options);
  if (rows.reason != nullptr) return refused("wilson", rows.reason, rows);
  if (rows.n == 0) return refused("wilson", "no_data", rows);
  if (!all_zero_or_one(rows.values[0]))
    return refused("wilson", "bad_value", rows, "A share is made of 0 (failed) and 1 (passed).");
  const Passed all = passed_of(rows.values[0]);
  Answer answer = begun("wilson", rows);
  answer.method =
      "share with Wilson's score interval, without continuity correction; Clopper and Pearson's exact one beside "
      "it";
  answer.estimate_name = "share of ones";
  answer.estimate = all.share();
  answer.ci95 = wilson_interval(all.k, all.n);
  const Interval exact = clopper_pearson_interval(all.k, all.n);
  answer.more = {{"passed", static_cast<double>(all.k)},
                 {"clopper_pearson_low", exact.low},
                 {"clopper_pearson_high", exact.high}};
  if (all.n <= kMostEnumerated) {
    const double coverage = wilson_coverage(all.n, all.share());
    answer.more.push_back({"wilson_coverage_at_estimate", coverage});
    if (coverage < 0.93)
      answer.notes.emplace_back(
          "At this n, Wilson's interval holds a share like this one in fewer than 93 of 100 samples: quote Clopper "
          "and Pearson's.");
  }
  if (!table.group.empty())
    for (std::size_t g = 0; g < rows.groups.size(); ++g)
      if (const Passed passed = passed_of(rows.values_of(g)); passed.n > 0)
        answer.rows.push_back(row_of(answer.groups[g], passed));
  return settled(std::move(answer));
}

}  // namespace seldinger::assessment::statistics
