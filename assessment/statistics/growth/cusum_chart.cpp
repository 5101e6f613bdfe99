#include "assessment/statistics/growth/cusum_chart.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "assessment/statistics/growth/binary_cusum.h"
#include "assessment/statistics/growth/normal_cusum.h"
#include "assessment/statistics/growth/series.h"

namespace seldinger::assessment::statistics {
namespace {

constexpr std::size_t kMostAttempts = 2000;
constexpr double kLeastRunLength = 10.0, kMostRunLength = 1e5;

// Where a sum first reaches the limit, counted from 1; 0: nowhere in the first `attempts`.
std::size_t first_reached(const std::vector<double>& path, double limit, std::size_t attempts) {
  for (std::size_t i = 0; i < path.size() && i < attempts; ++i)
    if (path[i] >= limit - kSumSlack) return i + 1;
  return 0;
}

// One person: a row for each attempt. Several: one for each, with where its sum reached the limit (0: nowhere).
void draw(Answer& answer, const std::vector<Series>& persons, const std::vector<std::vector<double>>& paths,
          double limit, std::size_t attempts) {
  std::size_t reached = 0;
  for (std::size_t i = 0; i < persons.size(); ++i) {
    const std::size_t at = first_reached(paths[i], limit, attempts);
    reached += at > 0 ? 1 : 0;
    if (persons.size() == 1) {
      for (std::size_t k = 0; k < paths[i].size(); ++k)
        answer.rows.push_back({std::to_string(k + 1), {{"value", persons[i].values[k]}, {"sum", paths[i][k]}}});
      answer.more.push_back({"reached_at", static_cast<double>(at)});
      continue;
    }
    answer.rows.push_back({persons[i].person,
                           {{"attempts", static_cast<double>(paths[i].size())},
                            {"sum", paths[i].back()},
                            {"highest", *std::max_element(paths[i].begin(), paths[i].end())},
                            {"reached_at", static_cast<double>(at)}}});
  }
  if (persons.size() > 1) answer.more.push_back({"persons_reached", static_cast<double>(reached)});
  if (persons.size() == 1) answer.statistic = paths.front().back();
}

bool all_binary(const std::vector<Series>& persons) {
  return std::all_of(persons.begin(), persons.end(), [](const Series& one) {
    return std::all_of(one.values.begin(), one.values.end(), [](double v) { return v == 0.0 || v == 1.0; });
  });
}

Answer begun(const char* test, const PersonsSeries& series) {
  Answer answer;
  answer.test = test;
  answer.n = series.persons.size();
  answer.missing = series.missing;
  return answer;
}

Answer refused(const char* test, const char* reason, const PersonsSeries& series, const char* why) {
  Answer answer = not_estimable(test, reason, series.persons.size());
  answer.missing = series.missing;
  answer.notes.emplace_back(why);
  return answer;
}

std::optional<Answer> unfit(const char* test, const PersonsSeries& series) {
  if (series.values == 0) return refused(test, "no_data", series, "There is no attempt.");
  if (!all_binary(series.persons))
    return refused(test, "bad_value", series, "A value is neither 0 nor 1 (failure).");
  return std::nullopt;
}

std::vector<std::vector<double>> paths_of(const std::vector<Series>& persons, const CusumSteps& steps,
                                          bool failure_is_up) {
  std::vector<std::vector<double>> paths;
  for (const Series& one : persons) {
    std::vector<bool> ups;
    for (const double value : one.values) ups.push_back((value == 1.0) == failure_is_up);
    paths.push_back(cusum_path(steps, ups));
  }
  return paths;
}

void note_beyond(Answer& answer, const std::vector<Series>& persons, std::size_t attempts) {
  if (std::any_of(persons.begin(), persons.end(), [&](const Series& one) { return one.values.size() > attempts; }))
    answer.notes.push_back("What comes after attempt " + std::to_string(attempts) +
                           " declares nobody: the error is controlled over that many attempts.");
}

}  // namespace

bool sound(const CusumRule& rule) {
  return rule.adequate > 0.0 && rule.adequate < rule.inadequate && rule.inadequate < 1.0 && rule.attempts >= 1 &&
         rule.attempts <= kMostAttempts && rule.permitted > 0.0 && rule.permitted < 1.0;
}

Answer lc_cusum(const DataTable& table, const CusumRule& rule) {
  constexpr const char* kTest = "lc_cusum";
  const PersonsSeries series = persons_series(table);
  if (!sound(rule)) return refused(kTest, "bad_value", series, "Rates must be 0 < adequate < inadequate < 1.");
  if (const auto no = unfit(kTest, series)) return *no;
  const CusumSteps steps{std::log((1.0 - rule.adequate) / (1.0 - rule.inadequate)),
                         std::log(rule.inadequate / rule.adequate)};
  const auto limit = limit_for(steps, 1.0 - rule.inadequate, rule.permitted, rule.attempts);
  if (!limit) return refused(kTest, "no_solution", series, "So few attempts cannot tell the two rates apart.");
  Answer answer = begun(kTest, series);
  answer.method =
      "LC-CUSUM, limit from the exact distribution of the sum over " + std::to_string(rule.attempts) + " attempts";
  answer.estimate = *limit;
  answer.estimate_name = "limit h: who reaches it is declared competent";
  const double true_share = reached_within(steps, 1.0 - rule.adequate, *limit, rule.attempts);
  answer.more = {{"false_declaration", reached_within(steps, 1.0 - rule.inadequate, *limit, rule.attempts)},
                 {"true_declaration", true_share},
                 {"weight_success", steps.up},
                 {"weight_failure", -steps.down}};
  draw(answer, series.persons, paths_of(series.persons, steps, false), *limit, rule.attempts);
  note_beyond(answer, series.persons, rule.attempts);
  if (true_share < 0.8)
    answer.notes.emplace_back("More than one in five adequate learners would not be declared competent in time.");
  return settled(std::move(answer));
}

Answer cusum(const DataTable& table, const CusumRule& rule) {
  constexpr const char* kTest = "cusum";
  const PersonsSeries series = persons_series(table);
  if (!sound(rule)) return refused(kTest, "bad_value", series, "Rates must be 0 < adequate < inadequate < 1.");
  if (const auto no = unfit(kTest, series)) return *no;
  const CusumSteps steps{std::log(rule.inadequate / rule.adequate),
                         std::log((1.0 - rule.adequate) / (1.0 - rule.inadequate))};
  const auto limit = limit_for(steps, rule.adequate, rule.permitted, rule.attempts);
  if (!limit) return refused(kTest, "no_solution", series, "So few attempts cannot tell the two rates apart.");
  Answer answer = begun(kTest, series);
  answer.method = "CUSUM of failures, limit from the exact distribution of the sum over " +
                  std::to_string(rule.attempts) + " attempts";
  answer.estimate = *limit;
  answer.estimate_name = "limit h: who reaches it is looked at again";
  answer.more = {{"false_alarm", reached_within(steps, rule.adequate, *limit, rule.attempts)},
                 {"true_alarm", reached_within(steps, rule.inadequate, *limit, rule.attempts)},
                 {"run_length_adequate", run_length(steps, rule.adequate, *limit)},
                 {"run_length_inadequate", run_length(steps, rule.inadequate, *limit)},
                 {"weight_failure", steps.up},
                 {"weight_success", -steps.down}};
  // An alarm counts whenever it comes: unlike a declaration it is no licence.
  draw(answer, series.persons, paths_of(series.persons, steps, true), *limit, series.values);
  return settled(std::move(answer));
}

bool sound(const NormalCusumRule& rule) {
  return std::isfinite(rule.target) && rule.sd > 0.0 && rule.shift >= 0.1 && rule.shift <= 5.0 &&
         rule.run_length >= kLeastRunLength && rule.run_length <= kMostRunLength;
}

Answer cusum(const DataTable& table, const NormalCusumRule& rule) {
  constexpr const char* kTest = "cusum";
  const PersonsSeries series = persons_series(table);
  if (!sound(rule))
    return refused(kTest, "bad_value", series, "sd must be above 0, shift 0.1 to 5, run_length 10 to 100000.");
  if (series.values == 0) return refused(kTest, "no_data", series, "There is no attempt.");
  const double k = 0.5 * rule.shift, limit = normal_limit(k, rule.run_length);
  if (!std::isfinite(limit)) return refused(kTest, "no_solution", series, "No limit runs that long.");
  std::vector<std::vector<double>> paths;
  for (const Series& one : series.persons) {
    double sum = 0.0;
    paths.emplace_back();
    for (const double value : one.values) {
      const double z = (value - rule.target) / rule.sd;
      paths.back().push_back(sum = std::max(0.0, sum + (rule.lower_is_worse ? -z : z) - k));
    }
    if (!std::isfinite(sum)) return refused(kTest, "no_finite_answer", series, "A value is too large for this sd.");
  }
  Answer answer = begun(kTest, series);
  answer.method = "CUSUM of standardised values, one-sided, limit from the run length (normal, by quadrature)";
  answer.estimate = limit;
  answer.estimate_name = "limit h, in SDs";
  answer.more = {{"run_length_at_target", normal_run_length(k, limit, 0.0)},
                 {"run_length_shifted", normal_run_length(k, limit, rule.shift)},
                 {"reference_value", k}};
  draw(answer, series.persons, paths, limit, series.values);
  return settled(std::move(answer));
}

}  // namespace seldinger::assessment::statistics
