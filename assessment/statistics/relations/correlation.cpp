#include "assessment/statistics/relations/correlation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "assessment/statistics/distributions.h"
#include "assessment/statistics/ranks.h"
#include "assessment/statistics/relations/concordance.h"
#include "assessment/statistics/relations/observations.h"

namespace seldinger::assessment::statistics {
namespace {

// Closer to ±1 than this, rounding decides.
constexpr double kPerfect = 1e-13;
// Fewer persons than this make Kendall's interval too narrow at a strong relation.
constexpr std::size_t kFewKendall = 20;
// Persons up to which Kendall's exact distribution is taken, and above which pairs are too many to count.
constexpr std::size_t kMostExactKendall = 50, kMostKendall = 20000;

// Without its mean and scaled to lengths that squares hold.
std::vector<double> centred(std::span<const double> values) {
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  std::vector<double> scaled(values.begin(), values.end());
  if (largest == 0.0) return scaled;
  for (int pass = 0; pass < 2; ++pass) {  // the second takes the first's rounding off
    if (pass == 0)
      for (double& value : scaled) value /= largest;
    const double mean = std::accumulate(scaled.begin(), scaled.end(), 0.0) / static_cast<double>(scaled.size());
    for (double& value : scaled) value -= mean;
  }
  return scaled;
}

bool varies(std::span<const double> values) {
  return std::any_of(values.begin(), values.end(), [&](double one) { return one != values.front(); });
}

// Rows and options as all three take them.
struct Relation {
  Observations rows;
  double reliability = 1.0;  // product of both measurements'
  bool corrects = false;
  const char* reason = nullptr;
  const char* note = nullptr;

  std::span<const double> value() const { return rows.values[0]; }
  std::span<const double> x() const { return rows.x; }
};

Relation relation_of(const DataTable& table, const ProcedureOptions& options) {
  Relation relation{.rows = observations(table, {.x = true})};
  const Observations& rows = relation.rows;
  for (const char* name : {"reliability_x", "reliability_y"}) {
    const std::optional<double> given = options.number(name, 1.0);
    if (!given || !(*given > 0.0 && *given <= 1.0)) {
      relation.reason = "bad_value";
      relation.note = "reliability_x and reliability_y are numbers above 0 and up to 1.";
      return relation;
    }
    relation.reliability *= *given;
    relation.corrects = relation.corrects || options.has(name);
  }
  if (rows.reason != nullptr) {
    relation.reason = rows.reason;
  } else if (rows.n == 0 || rows.x.empty()) {
    relation.reason = "no_data";
  } else if (rows.n < 3) {
    relation.reason = "too_few";
  } else if (!varies(relation.value()) || !varies(relation.x())) {
    relation.reason = "no_variation";
  }
  return relation;
}

void add_corrected(Answer& answer, const Relation& relation) {
  if (!relation.corrects) return;
  const double root = std::sqrt(relation.reliability);
  answer.more.push_back({"corrected_for_attenuation", *answer.estimate / root});
  if (answer.ci95) {
    answer.more.push_back({"corrected_low", answer.ci95->low / root});
    answer.more.push_back({"corrected_high", answer.ci95->high / root});
  }
  answer.notes.emplace_back("The corrected correlation takes the reliabilities given as known exactly.");
  if (std::abs(*answer.estimate / root) > 1.0)
    answer.notes.emplace_back("Corrected, it is beyond 1: by chance, or because a reliability given is too low.");
}

void add_interval(Answer& answer, double r, double standard_error, std::size_t least) {
  answer.ci95 = fisher_z_interval(r, standard_error);
  if (answer.ci95) return;
  answer.notes.push_back(answer.n < least ? "There is no interval for so few persons."
                                          : "All lie on one line: the interval would have no width.");
}

// t with n − 2 degrees of freedom.
void add_t_test(Answer& answer, double r) {
  const double df = static_cast<double>(answer.n) - 2.0;
  if (1.0 - std::abs(r) < kPerfect) return;
  answer.statistic = r * std::sqrt(df / (1.0 - r * r));
  answer.df = {df};
  answer.p_value = 2.0 * student_t_upper(std::abs(*answer.statistic), df);
}

}  // namespace

double correlation_coefficient(std::span<const double> a, std::span<const double> b) {
  if (a.empty() || !varies(a) || !varies(b)) return std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> u = centred(a), v = centred(b);
  const double uu = std::inner_product(u.begin(), u.end(), u.begin(), 0.0);
  const double vv = std::inner_product(v.begin(), v.end(), v.begin(), 0.0);
  const double uv = std::inner_product(u.begin(), u.end(), v.begin(), 0.0);
  return std::clamp(uv / std::sqrt(uu) / std::sqrt(vv), -1.0, 1.0);
}

double rank_correlation(std::span<const double> a, std::span<const double> b) {
  return correlation_coefficient(midranks(a), midranks(b));
}

std::optional<Interval> fisher_z_interval(double r, double standard_error) {
  if (!std::isfinite(standard_error) || !(1.0 - std::abs(r) >= kPerfect)) return std::nullopt;
  const double half = normal_quantile_of(0.975) * standard_error;
  return Interval{std::tanh(std::atanh(r) - half), std::tanh(std::atanh(r) + half)};
}

Answer pearson(const DataTable& table, const ProcedureOptions& options) {
  const Relation relation = relation_of(table, options);
  if (relation.reason != nullptr) return refused("pearson", relation.reason, relation.rows, relation.note);
  const double r = correlation_coefficient(relation.value(), relation.x());
  Answer answer = begun("pearson", relation.rows);
  answer.method = "Pearson's correlation, t-test, interval by Fisher's z";
  answer.estimate_name = "r";
  if (std::isnan(r)) return refused("pearson", "no_finite_answer", relation.rows);
  answer.estimate = r;
  const auto n = static_cast<double>(answer.n);
  add_interval(answer, r, n > 3.0 ? 1.0 / std::sqrt(n - 3.0) : INFINITY, 4);
  add_t_test(answer, r);
  add_corrected(answer, relation);
  return settled(std::move(answer));
}

Answer spearman(const DataTable& table, const ProcedureOptions& options) {
  const Relation relation = relation_of(table, options);
  if (relation.reason != nullptr) return refused("spearman", relation.reason, relation.rows, relation.note);
  const std::vector<double> a = midranks(relation.value()), b = midranks(relation.x());
  const double rho = correlation_coefficient(a, b);
  Answer answer = begun("spearman", relation.rows);
  answer.estimate_name = "rho";
  answer.estimate = rho;
  const auto n = static_cast<double>(answer.n);
  add_interval(answer, rho, n > 3.0 ? std::sqrt((1.0 + 0.5 * rho * rho) / (n - 3.0)) : INFINITY, 4);
  if (answer.n <= kMostPermuted) {
    const double middle = 0.25 * n * (n + 1.0) * (n + 1.0);
    answer.p_value = permutation_p(a, b, [middle](std::span<const double> p, std::span<const double> q) {
      return std::inner_product(p.begin(), p.end(), q.begin(), 0.0) - middle;
    });
    answer.method = "Spearman's rank correlation, mid-ranks, exact over all orders, interval by Bonett and Wright";
  } else {
    add_t_test(answer, rho);
    answer.method = "Spearman's rank correlation, mid-ranks, t approximation, interval by Bonett and Wright";
  }
  add_corrected(answer, relation);
  return settled(std::move(answer));
}

Answer kendall(const DataTable& table, const ProcedureOptions& options) {
  const Relation relation = relation_of(table, options);
  if (relation.reason != nullptr) return refused("kendall", relation.reason, relation.rows, relation.note);
  if (relation.rows.n > kMostKendall) return refused("kendall", "too_many", relation.rows);
  const Concordance found = concordance_of(relation.value(), relation.x());
  Answer answer = begun("kendall", relation.rows);
  answer.estimate_name = "tau-b";
  answer.estimate = std::clamp(found.tau_b, -1.0, 1.0);
  const auto n = static_cast<double>(answer.n);
  add_interval(answer, *answer.estimate, n > 4.0 ? std::sqrt(0.437 / (n - 4.0)) : INFINITY, 5);
  answer.method = "Kendall's tau-b, interval by Fieller's standard error of z, test ";
  if (!found.tied && answer.n < kMostExactKendall) {
    answer.p_value = untied_concordance_p(answer.n, found.score);
    answer.method += "exact";
  } else if (answer.n <= kMostPermuted) {
    answer.p_value = permutation_p(
        relation.value(), relation.x(),
        [](std::span<const double> a, std::span<const double> b) { return concordance_of(a, b).score; });
    answer.method += "exact over all orders, ties kept";
  } else {
    answer.statistic = found.score / std::sqrt(found.variance);
    answer.p_value = 2.0 * normal_upper(std::abs(*answer.statistic));
    answer.method += "asymptotic, variance corrected for ties, no continuity correction";
  }
  warn_of_interval(answer, kFewKendall);
  add_corrected(answer, relation);
  return settled(std::move(answer));
}

}  // namespace seldinger::assessment::statistics
