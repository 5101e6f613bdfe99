#include "assessment/statistics/relations/imputation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "assessment/statistics/distributions.h"
#include "assessment/statistics/relations/observations.h"
#include "assessment/statistics/spread.h"
#include "sim/base/rng.h"

namespace seldinger::assessment::statistics {
namespace {

constexpr std::size_t kLeastSeen = 5;  // values of a group, or pairs of value and x

// A group's values on a line over x about its mean; without x a line of slope 0.
struct Line {
  double mean = 0.0, x_mean = 0.0, slope = 0.0;
  double rss = 0.0, sxx = 0.0;
  std::size_t n = 0;
  bool sloped = false;

  double df() const { return static_cast<double>(n - (sloped ? 2 : 1)); }

  // One that the values leave possible: flat prior on mean, slope and log σ.
  struct Drawn {
    double at_mean, slope, sigma;
  };
  Drawn drawn(base::Rng& rng) const {
    double chi_squared = 0.0;
    for (double left = df(); left > 0.5; left -= 1.0) {
      const double z = rng.normal();
      chi_squared += z * z;
    }
    const double sigma = std::sqrt(rss / chi_squared);
    const double at_mean = mean + sigma * rng.normal() / std::sqrt(static_cast<double>(n));
    return {at_mean, sloped ? slope + sigma * rng.normal() / std::sqrt(sxx) : 0.0, sigma};
  }
};

Line level_of(const std::vector<double>& y) {
  const Spread spread = spread_of(y);
  Line line{spread.mean, 0.0, 0.0, 0.0, 0.0, y.size(), false};
  for (const double one : y) line.rss += (one - spread.mean) * (one - spread.mean);
  return line;
}

// Nothing: too few pairs, or x does not vary.
std::optional<Line> line_of(const std::vector<double>& x, const std::vector<double>& y) {
  if (y.size() < kLeastSeen) return std::nullopt;
  const Spread of_x = spread_of(x), of_y = spread_of(y);
  if (!of_x.computable || !of_y.computable || !of_x.varies) return std::nullopt;
  Line line{of_y.mean, of_x.mean, 0.0, 0.0, 0.0, y.size(), true};
  double sxy = 0.0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    line.sxx += (x[i] - of_x.mean) * (x[i] - of_x.mean);
    sxy += (x[i] - of_x.mean) * (y[i] - of_y.mean);
  }
  line.slope = sxy / line.sxx;
  for (std::size_t i = 0; i < y.size(); ++i) {
    const double off = y[i] - of_y.mean - line.slope * (x[i] - of_x.mean);
    line.rss += off * off;
  }
  return line;
}

// A group: what is seen of it, and which rows lack a value.
struct HalfSeen {
  std::vector<double> seen;
  std::vector<double> pair_x, pair_y;
  std::vector<std::size_t> lacking;
};

bool known(const DataTable& table, std::size_t row) {
  return !table.x.empty() && std::isfinite(table.x[row]);
}

// As observations() has it: who is not named where others are stands in no group.
bool is_in(const DataTable& table, std::size_t row, const std::string& group) {
  return table.group[row] == group && (table.subject.empty() || !table.subject[row].empty());
}

HalfSeen half_seen(const DataTable& table, const std::string& group) {
  HalfSeen of;
  const std::vector<double>& y = table.values.front().values;
  for (std::size_t row = 0; row < table.rows; ++row) {
    if (!is_in(table, row, group)) continue;
    if (std::isnan(y[row])) {
      of.lacking.push_back(row);
      continue;
    }
    of.seen.push_back(y[row]);
    if (!known(table, row)) continue;
    of.pair_x.push_back(table.x[row]);
    of.pair_y.push_back(y[row]);
  }
  return of;
}

// Values for those who lack one: by the line where their x is known, else by the group's level.
void draw_lacking(const DataTable& table, const HalfSeen& group, base::Rng& rng, std::vector<double>& values) {
  const std::optional<Line> line = line_of(group.pair_x, group.pair_y);
  const Line level = level_of(group.seen);
  const Line::Drawn by_level = level.drawn(rng), by_line = line ? line->drawn(rng) : by_level;
  for (const std::size_t row : group.lacking) {
    const bool on_line = line && known(table, row);
    const Line::Drawn& from = on_line ? by_line : by_level;
    values[row] =
        from.at_mean + (on_line ? from.slope * (table.x[row] - line->x_mean) : 0.0) + from.sigma * rng.normal();
  }
}

struct Welch {
  double difference = 0.0, variance = 0.0, df = 0.0;
};
Welch welch_of(const DataTable& table, const std::vector<double>& values, const std::vector<std::string>& groups) {
  std::array<Spread, 2> of;
  for (std::size_t g = 0; g < 2; ++g) {
    std::vector<double> own;
    for (std::size_t row = 0; row < table.rows; ++row)
      if (is_in(table, row, groups[g])) own.push_back(values[row]);
    of[g] = spread_of(own);
  }
  const auto part = [&](std::size_t g) { return of[g].variance / static_cast<double>(of[g].n); };
  const auto freedom = [&](std::size_t g) { return part(g) * part(g) / static_cast<double>(of[g].n - 1); };
  const double variance = part(0) + part(1);
  return {of[0].mean - of[1].mean, variance, variance * variance / (freedom(0) + freedom(1))};
}

// All who have a group, whether they have a value or not.
Observations everybody(const DataTable& table, const ProcedureOptions& options) {
  DataTable filled = table;
  for (double& one : filled.values.front().values)
    if (std::isnan(one)) one = 0.0;
  filled.x.clear();
  return observations(filled, {.group = true}, options);
}

void tell_model(Answer& answer, const DataTable& table, std::size_t lacking, std::size_t on_line) {
  if (lacking == 0) {
    answer.notes.emplace_back("Nobody lacks a value: nothing is drawn.");
    return;
  }
  if (!table.x.empty() && on_line < lacking)
    answer.notes.push_back(std::to_string(lacking - on_line) +
                           " of those without a value are drawn from their group's level: their x is not known, or "
                           "too few show how the value depends on it.");
  answer.notes.emplace_back(
      on_line > 0
          ? "It holds where, in a group and given x, those who lack a value would have had values like the others'."
          : "It holds where, in a group, those who lack a value would have had values like the others'.");
}

}  // namespace

Pooled pooled(std::span<const double> estimates, std::span<const double> variances, double complete_df) {
  const Spread spread = spread_of(estimates);
  Pooled all;
  all.estimate = spread.mean;
  all.between = spread.variance;
  const auto m = static_cast<double>(estimates.size());
  for (const double one : variances) all.within += one / m;
  all.total = all.within + (1.0 + 1.0 / m) * all.between;
  const double lost = (all.total - all.within) / all.total;
  if (!(lost > 0.0)) {
    all.df = complete_df;
    return all;
  }
  const double many = (m - 1.0) / (lost * lost);
  const double seen = (complete_df + 1.0) / (complete_df + 3.0) * complete_df * (1.0 - lost);
  all.df = 1.0 / (1.0 / many + 1.0 / seen);
  return all;
}

ImputedComparison imputed_comparison(const DataTable& table, const ProcedureOptions& options) {
  ImputedComparison made;
  const Observations rows = everybody(table, options);
  if (const char* reason = not_two_groups(rows, kLeastSeen)) {
    made.answer = refused("imputed", reason, rows);
    return made;
  }
  const std::optional<std::size_t> draws =
      options.whole("draws", kUsualImputations, kLeastImputations, kMostImputations);
  const std::optional<std::size_t> seed = options.whole("seed", 1, 0, std::size_t{1} << 52);
  if (!draws || !seed) {
    made.answer =
        refused("imputed", "bad_value", rows, "draws is a whole number from 10 to 500, seed a whole number.");
    return made;
  }
  std::array<HalfSeen, 2> groups;
  std::size_t on_line = 0;
  for (std::size_t g = 0; g < 2; ++g) {
    groups[g] = half_seen(table, rows.groups[g]);
    const Spread spread = spread_of(groups[g].seen);
    const char* reason = groups[g].seen.size() < kLeastSeen ? "group_too_small"
                         : !spread.computable               ? "no_finite_answer"
                         : !spread.varies                   ? "no_variation_within"
                                                            : nullptr;
    if (reason != nullptr) {
      made.answer = refused("imputed", reason, rows, "Each group needs five values, not all the same.");
      return made;
    }
    if (line_of(groups[g].pair_x, groups[g].pair_y))
      for (const std::size_t row : groups[g].lacking) on_line += known(table, row) ? 1 : 0;
    made.rows.insert(made.rows.end(), groups[g].lacking.begin(), groups[g].lacking.end());
  }
  base::Rng rng(*seed);
  std::vector<double> values = table.values.front().values, estimates, variances;
  double complete_df = 0.0;
  for (std::size_t i = 0; i < *draws; ++i) {
    for (const HalfSeen& group : groups) draw_lacking(table, group, rng, values);
    std::vector<double>& drawn = made.draws.emplace_back();
    for (const std::size_t row : made.rows) drawn.push_back(values[row]);
    const Welch one = welch_of(table, values, rows.groups);
    estimates.push_back(one.difference);
    variances.push_back(one.variance);
    complete_df += one.df / static_cast<double>(*draws);
  }
  const Pooled all = pooled(estimates, variances, complete_df);
  Answer& answer = made.answer = begun("imputed", rows);
  answer.method = "Welch's comparison of " + std::to_string(*draws) +
                  " tables in which values that are missing were drawn, pooled by Rubin's rules";
  answer.estimate = all.estimate;
  answer.estimate_name = "difference of means (" + rows.groups[0] + " − " + rows.groups[1] + ")";
  const double error = std::sqrt(all.total), half = student_t_quantile(0.975, all.df) * error;
  answer.ci95 = Interval{all.estimate - half, all.estimate + half};
  answer.statistic = all.estimate / error;
  answer.df = {all.df};
  answer.p_value = 2.0 * student_t_upper(std::abs(*answer.statistic), all.df);
  answer.more = {{"imputed", static_cast<double>(made.rows.size())},
                 {"standard_error", error},
                 {"variance_within", all.within},
                 {"variance_between", all.between}};
  tell_model(answer, table, made.rows.size(), on_line);
  for (std::size_t g = 0; g < 2; ++g)
    if (groups[g].lacking.size() > groups[g].seen.size())
      answer.notes.push_back("More than half of " + rows.groups[g] + " is drawn: the answer rests on the model.");
  answer = settled(std::move(answer));
  return made;
}

Answer imputed(const DataTable& table, const ProcedureOptions& options) {
  return imputed_comparison(table, options).answer;
}

}  // namespace seldinger::assessment::statistics
