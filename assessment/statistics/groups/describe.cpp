#include "assessment/statistics/groups/describe.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "assessment/statistics/distributions.h"
#include "assessment/statistics/groups/samples.h"
#include "assessment/statistics/spread.h"

namespace seldinger::assessment::statistics {
namespace {

std::vector<double> in_order(std::span<const double> values) {
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

// Without mean, SD and interval where they cannot be computed.
std::vector<Named> description(std::span<const double> values) {
  std::vector<Named> numbers;
  const Spread spread = spread_of(values);
  const double n = static_cast<double>(values.size());
  if (std::isfinite(spread.mean)) numbers.push_back({"mean", spread.mean});
  if (spread.computable && values.size() > 1) {
    const double sd = std::sqrt(spread.variance), wide = student_t_quantile(0.975, n - 1.0) * sd / std::sqrt(n);
    numbers.push_back({"sd", sd});
    if (spread.varies) {
      numbers.push_back({"mean_ci95_low", spread.mean - wide});
      numbers.push_back({"mean_ci95_high", spread.mean + wide});
    }
  }
  const std::vector<double> sorted = in_order(values);
  const double q1 = quantile_of(sorted, 0.25), q3 = quantile_of(sorted, 0.75);
  const std::vector<Named> others = {{"median", quantile_of(sorted, 0.5)},
                                     {"q1", q1},
                                     {"q3", q3},
                                     {"iqr", q3 - q1},
                                     {"mad", median_absolute_deviation(values)},
                                     {"min", sorted.front()},
                                     {"max", sorted.back()}};
  numbers.insert(numbers.end(), others.begin(), others.end());
  return numbers;
}

std::optional<double> named(const std::vector<Named>& numbers, const char* name) {
  for (const Named& number : numbers)
    if (number.name == name) return number.value;
  return std::nullopt;
}

void say_what_is_missing(Answer& answer, const std::string& whose, const Group& group) {
  const Spread spread = spread_of(group.values);
  if (group.values.size() == 1)
    answer.notes.push_back(whose + "One value has no SD and no interval.");
  else if (!spread.computable)
    answer.notes.push_back(whose + "SD and interval are not finite numbers.");
  else if (!spread.varies)
    answer.notes.push_back(whose + "The values do not vary: no interval.");
}

}  // namespace

double quantile_of(std::span<const double> sorted, double p) {
  const double place = p * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const double share = place - static_cast<double>(below);
  if (share == 0.0 || below + 1 >= sorted.size()) return sorted[below];
  return (1.0 - share) * sorted[below] + share * sorted[below + 1];
}

double median_absolute_deviation(std::span<const double> values) {
  const double median = quantile_of(in_order(values), 0.5);
  std::vector<double> off;
  for (const double value : values) off.push_back(std::abs(value - median));
  return 1.4826 * quantile_of(in_order(off), 0.5);
}

Answer describe(const DataTable& table, const ProcedureOptions& options) {
  // A person may stand in several groups here, since they are not compared, but not twice in one.
  DataTable by_group = table;
  for (std::size_t i = 0; i < by_group.subject.size() && !table.group.empty(); ++i)
    if (!by_group.subject[i].empty()) by_group.subject[i] += '\n' + table.group[i];
  GroupsAsked asked;
  asked.groups = independent_groups(by_group, options.list("order"));
  std::erase_if(asked.groups.groups, [](const Group& group) { return group.values.empty(); });
  asked.reason = asked.groups.n == 0 ? "no_data" : asked.groups.reason;
  if (asked.reason != nullptr) return asked.refused("describe");
  Answer answer = asked.answer("describe", "quartiles of type 7, MAD × 1.4826, t interval of the mean");
  if (table.group.empty()) {
    answer.groups.clear();
    answer.more = description(asked.groups.groups.front().values);
    answer.estimate = named(answer.more, "mean");
    answer.estimate_name = "mean";
    const auto low = named(answer.more, "mean_ci95_low"), high = named(answer.more, "mean_ci95_high");
    if (low && high) answer.ci95 = Interval{*low, *high};
    say_what_is_missing(answer, "", asked.groups.groups.front());
    return settled(std::move(answer));
  }
  for (const Group& group : asked.groups.groups) {
    Row row{group.name, {{"n", static_cast<double>(group.values.size())}}};
    const std::vector<Named> numbers = description(group.values);
    row.values.insert(row.values.end(), numbers.begin(), numbers.end());
    answer.rows.push_back(std::move(row));
    say_what_is_missing(answer, group.name + ": ", group);
  }
  return settled(std::move(answer));
}

}  // namespace seldinger::assessment::statistics
