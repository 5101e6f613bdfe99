#include "assessment/statistics/groups/multiplicity.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "assessment/statistics/deals.h"
#include "assessment/statistics/groups/power.h"
#include "assessment/statistics/groups/samples.h"
#include "assessment/statistics/spread.h"

namespace seldinger::assessment::statistics {
namespace {

std::vector<std::size_t> order_of(std::span<const double> values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return values[i] < values[j]; });
  return order;
}

using Adjust = std::vector<double> (*)(std::span<const double>);

Answer adjusted_answer(const DataTable& table, const char* test, const char* method, Adjust adjust) {
  std::vector<double> p_values;
  std::vector<std::string> names;
  Answer answer;
  answer.test = test;
  answer.method = method;
  for (std::size_t i = 0; i < table.rows; ++i) {
    const double p = table.values.front().values[i];
    if (std::isnan(p)) {
      ++answer.missing;
      continue;
    }
    if (!(p >= 0.0 && p <= 1.0)) return bad_option(test, "A p-value lies from 0 to 1.");
    p_values.push_back(p);
    names.push_back(table.group.empty() || table.group[i].empty() ? std::to_string(i + 1) : table.group[i]);
  }
  if (p_values.empty()) {
    Answer none = not_estimable(test, "no_data", 0);
    none.missing = answer.missing;
    return none;
  }
  const std::vector<double> adjusted = adjust(p_values);
  answer.n = p_values.size();
  for (std::size_t i = 0; i < p_values.size(); ++i)
    answer.rows.push_back({names[i], {{"p", p_values[i]}, {"p_adjusted", adjusted[i]}}});
  const auto significant = std::count_if(adjusted.begin(), adjusted.end(), [](double p) { return p <= kAlpha; });
  answer.more = {{"significant", static_cast<double>(significant)}};
  answer.notes.push_back("The family are these " + std::to_string(answer.n) +
                         " tests; `significant` counts adjusted values up to .05.");
  return settled(std::move(answer));
}

// Sums of both groups by which |t| is computed; values are centred and scaled before.
double size_of_t(std::span<const double> values, const std::vector<char>& is_first) {
  double n[2] = {}, sum[2] = {}, squares[2] = {};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t group = is_first[i] != 0 ? 0 : 1;
    n[group] += 1.0;
    sum[group] += values[i];
    squares[group] += values[i] * values[i];
  }
  double error = 0.0;
  for (const std::size_t group : {0, 1}) {
    const double off = squares[group] - sum[group] * sum[group] / n[group];
    // Sums of squares of values that are about 1: less than this is rounding.
    error += off > 1e-12 * n[group] ? off / (n[group] - 1.0) / n[group] : 0.0;
  }
  const double difference = std::abs(sum[0] / n[0] - sum[1] / n[1]);
  if (error > 0.0) return difference / std::sqrt(error);
  return difference > 1e-12 ? std::numeric_limits<double>::infinity() : 0.0;
}

double mean_difference(std::span<const double> values, const std::vector<char>& is_first) {
  double n[2] = {}, sum[2] = {};
  for (std::size_t i = 0; i < values.size(); ++i) {
    n[is_first[i] != 0 ? 0 : 1] += 1.0;
    sum[is_first[i] != 0 ? 0 : 1] += values[i];
  }
  return sum[0] / n[0] - sum[1] / n[1];
}

std::vector<std::vector<double>> standardised(std::span<const std::vector<double>> outcomes) {
  std::vector<std::vector<double>> scaled(outcomes.begin(), outcomes.end());
  for (std::vector<double>& outcome : scaled) {
    const Spread spread = spread_of(outcome);
    for (double& value : outcome) value = (value - spread.mean) / std::sqrt(spread.variance);
  }
  return scaled;
}

// Rows that have every outcome, and the outcomes that vary among them.
struct Outcomes {
  std::vector<std::string> names;
  std::vector<std::vector<double>> values;
  std::vector<char> is_first;
  std::vector<std::string> notes;
};

// A table with one column that is missing where any is.
DataTable complete_rows(const DataTable& table) {
  DataTable rows = table;
  rows.values.resize(1);
  for (const Column& column : table.values)
    for (std::size_t i = 0; i < table.rows; ++i)
      if (std::isnan(column.values[i])) rows.values.front().values[i] = column.values[i];
  return rows;
}

Outcomes outcomes_of(const DataTable& table, const GroupsAsked& asked) {
  Outcomes outcomes;
  const DataTable complete = complete_rows(table);
  std::vector<std::size_t> rows;
  const std::string &first = asked.groups.groups[0].name, &second = asked.groups.groups[1].name;
  for (std::size_t i = 0; i < table.rows; ++i) {
    if (std::isnan(complete.values.front().values[i]) || (!table.subject.empty() && table.subject[i].empty()))
      continue;
    if (table.group[i] != first && table.group[i] != second) continue;
    rows.push_back(i);
    outcomes.is_first.push_back(table.group[i] == first ? 1 : 0);
  }
  for (const Column& column : table.values) {
    std::vector<double> values;
    for (const std::size_t row : rows) values.push_back(column.values[row]);
    const Spread spread = spread_of(values);
    if (spread.computable && spread.varies) {
      outcomes.names.push_back(column.name);
      outcomes.values.push_back(std::move(values));
    } else {
      outcomes.notes.push_back(column.name + (spread.varies ? " is left out: its variance is not a finite number."
                                                            : " is left out: its values do not vary."));
    }
  }
  return outcomes;
}

}  // namespace

std::vector<double> holm_adjusted(std::span<const double> p_values) {
  std::vector<double> adjusted(p_values.size());
  double largest = 0.0, left = static_cast<double>(p_values.size());
  for (const std::size_t i : order_of(p_values)) {
    largest = std::max(largest, std::min(1.0, left * p_values[i]));
    adjusted[i] = largest;
    left -= 1.0;
  }
  return adjusted;
}

std::vector<double> bh_adjusted(std::span<const double> p_values) {
  std::vector<double> adjusted(p_values.size());
  const std::vector<std::size_t> order = order_of(p_values);
  const double n = static_cast<double>(p_values.size());
  double least = 1.0;
  for (std::size_t rank = order.size(); rank-- > 0;) {
    least = std::min(least, n / static_cast<double>(rank + 1) * p_values[order[rank]]);
    adjusted[order[rank]] = least;
  }
  return adjusted;
}

MaxT max_t_test(std::span<const std::vector<double>> outcomes, const std::vector<char>& is_first, std::size_t draws,
                std::uint64_t seed) {
  const std::vector<std::vector<double>> scaled = standardised(outcomes);
  const std::size_t k = scaled.size();
  MaxT test;
  for (const std::vector<double>& outcome : scaled) test.t.push_back(size_of_t(outcome, is_first));
  const std::vector<std::size_t> order = order_of(test.t);  // the least first
  std::vector<std::size_t> raw(k, 0), stepped(k, 0);
  const auto firsts = static_cast<std::size_t>(std::count(is_first.begin(), is_first.end(), char{1}));
  Exceedances deals({is_first.size(), firsts, draws, seed});
  deals.go([&](const std::vector<char>& dealt) {
    double largest = 0.0;
    for (const std::size_t i : order) {
      const double t = size_of_t(scaled[i], dealt), observed = test.t[i] * (1.0 - 1e-12);
      largest = std::max(largest, t);
      if (t >= observed) ++raw[i];
      if (largest >= observed) ++stepped[i];
    }
  });
  test.all = deals.all();
  test.raw.resize(k);
  test.adjusted.resize(k);
  double before = 0.0;
  for (std::size_t place = k; place-- > 0;) {
    const std::size_t i = order[place];
    test.raw[i] = deals.chance(raw[i]);
    before = test.adjusted[i] = std::max(before, deals.chance(stepped[i]));
  }
  return test;
}

Answer holm(const DataTable& table, const ProcedureOptions&) {
  return adjusted_answer(table, "holm", "Holm's step-down Bonferroni", holm_adjusted);
}

Answer bh(const DataTable& table, const ProcedureOptions&) {
  return adjusted_answer(table, "bh", "Benjamini–Hochberg, false discovery rate", bh_adjusted);
}

Answer max_t(const DataTable& table, const ProcedureOptions& options) {
  const auto draws = number_within(options, "draws", 10'000, 1'000, 1'000'000);
  const auto seed = number_within(options, "seed", 1, 0, 9e15);
  if (!draws || !seed) return bad_option("max_t", "draws lies from 1000 to 1000000, seed from 0 to 9e15.");
  GroupsAsked asked = two_groups(complete_rows(table), options, 2);
  if (asked.reason != nullptr) return asked.refused("max_t");
  const Outcomes outcomes = outcomes_of(table, asked);
  asked.notes.insert(asked.notes.end(), outcomes.notes.begin(), outcomes.notes.end());
  if (outcomes.values.empty()) {
    asked.reason = "no_variation";
    return asked.refused("max_t");
  }
  const MaxT test = max_t_test(outcomes.values, outcomes.is_first, static_cast<std::size_t>(*draws),
                               static_cast<std::uint64_t>(*seed));
  Answer answer = asked.answer(
      "max_t", std::string("Westfall–Young step-down max |T| of Welch's t, ") +
                   (test.all ? "all deals"
                             : std::to_string(static_cast<std::size_t>(*draws)) + " permutations drawn with seed " +
                                   std::to_string(static_cast<std::uint64_t>(*seed))));
  for (std::size_t i = 0; i < outcomes.names.size(); ++i) {
    Row row{outcomes.names[i], {}};
    const double difference = mean_difference(outcomes.values[i], outcomes.is_first);
    row.values = {{"difference", difference},
                  {"t", difference < 0.0 ? -test.t[i] : test.t[i]},
                  {"p_permutation", test.raw[i]},
                  {"p_adjusted", test.adjusted[i]}};
    answer.rows.push_back(std::move(row));
  }
  answer.notes.push_back("The family are these " + std::to_string(answer.rows.size()) +
                         " outcomes; persons without one of them are left out.");
  answer.notes.emplace_back("Permutation p-values come in steps.");
  return settled(std::move(answer));
}

}  // namespace seldinger::assessment::statistics
