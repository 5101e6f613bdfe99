#include "assessment/statistics/growth/proficiency.h"

#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "assessment/statistics/distributions.h"
#include "assessment/statistics/growth/series.h"

namespace seldinger::assessment::statistics {
namespace {

constexpr const char* kProficiency = "proficiency";
constexpr double kJeffreys = 0.5;

struct Window {
  std::size_t passes = 0, attempts = 0;
};

// The last attempts up to the `end`th.
Window window_at(const std::vector<double>& values, std::size_t end, std::size_t last) {
  const std::size_t begin = end > last ? end - last : 0;
  const auto from = values.begin() + static_cast<std::ptrdiff_t>(begin);
  return {static_cast<std::size_t>(std::count(from, values.begin() + static_cast<std::ptrdiff_t>(end), 1.0)),
          end - begin};
}

std::vector<double> probabilities_of(const std::vector<double>& values, const ProficiencyRule& rule) {
  std::vector<double> course;
  for (std::size_t end = 1; end <= values.size(); ++end) {
    const Window window = window_at(values, end, rule.last);
    course.push_back(probability_of_share(window.passes, window.attempts, rule.share));
  }
  return course;
}

// Where it is first so sure, counted from 1; 0: nowhere.
std::size_t first_sure(const std::vector<double>& course, double sure) {
  const auto found = std::find_if(course.begin(), course.end(), [&](double one) { return one >= sure; });
  return found == course.end() ? 0 : static_cast<std::size_t>(found - course.begin()) + 1;
}

void say_of_one(Answer& answer, const Series& series, const ProficiencyRule& rule) {
  const std::vector<double> course = probabilities_of(series.values, rule);
  const Window window = window_at(series.values, series.values.size(), rule.last);
  const double a = static_cast<double>(window.passes) + kJeffreys,
               b = static_cast<double>(window.attempts - window.passes) + kJeffreys;
  answer.estimate = course.back();
  answer.more = {{"passes", static_cast<double>(window.passes)},
                 {"attempts", static_cast<double>(window.attempts)},
                 {"share_low", beta_quantile(0.025, a, b)},
                 {"share_high", beta_quantile(0.975, a, b)},
                 {"proficient", course.back() >= rule.sure ? 1.0 : 0.0},
                 {"reached_at", static_cast<double>(first_sure(course, rule.sure))},
                 {"two_running_by_half", two_running(0.5, series.values.size())}};
  for (std::size_t i = 0; i < course.size(); ++i)
    answer.rows.push_back({std::to_string(i + 1), {{"value", series.values[i]}, {"probability", course[i]}}});
}

void say_of_several(Answer& answer, const std::vector<Series>& persons, const ProficiencyRule& rule) {
  std::size_t proficient = 0;
  for (const Series& one : persons) {
    const std::vector<double> course = probabilities_of(one.values, rule);
    const Window window = window_at(one.values, one.values.size(), rule.last);
    proficient += course.back() >= rule.sure ? 1 : 0;
    answer.rows.push_back({one.person,
                           {{"attempts", static_cast<double>(window.attempts)},
                            {"passes", static_cast<double>(window.passes)},
                            {"probability", course.back()},
                            {"reached_at", static_cast<double>(first_sure(course, rule.sure))}}});
  }
  answer.more = {{"persons_proficient", static_cast<double>(proficient)}};
}

}  // namespace

bool sound(const ProficiencyRule& rule) {
  return rule.share > 0.0 && rule.share < 1.0 && rule.sure > 0.0 && rule.sure < 1.0 && rule.last >= 1 &&
         rule.last <= 1000;
}

double probability_of_share(std::size_t passes, std::size_t attempts, double share) {
  return 1.0 - beta_cdf(share, static_cast<double>(passes) + kJeffreys,
                        static_cast<double>(attempts - passes) + kJeffreys);
}

double two_running(double p, std::size_t attempts) {
  // Not yet two running: the last attempt failed (or there is none), or it passed.
  double failed = 1.0, passed = 0.0, done = 0.0;
  for (std::size_t i = 0; i < attempts; ++i) {
    const double fails = (1.0 - p) * (failed + passed), passes = p * failed;
    done += p * passed;
    failed = fails;
    passed = passes;
  }
  return done;
}

Answer proficiency(const DataTable& table, const ProficiencyRule& rule) {
  const PersonsSeries series = persons_series(table);
  const auto refuse = [&](const char* reason, const char* why) {
    Answer answer = not_estimable(kProficiency, reason, series.persons.size());
    answer.missing = series.missing;
    answer.notes.emplace_back(why);
    return answer;
  };
  if (!sound(rule)) return refuse("bad_value", "share and sure lie between 0 and 1, last is 1 to 1000.");
  if (series.values == 0) return refuse("no_data", "There is no attempt.");
  for (const Series& one : series.persons)
    for (const double value : one.values)
      if (value != 0.0 && value != 1.0) return refuse("bad_value", "A value is neither 0 nor 1 (passed).");
  Answer answer;
  answer.test = kProficiency;
  answer.n = series.persons.size();
  answer.missing = series.missing;
  char method[160];
  std::snprintf(
      method, sizeof method,
      "probability, by Bayes with Jeffreys' prior, that %.0f %% or more of attempts pass now; the last %zu count",
      100.0 * rule.share, rule.last);
  answer.method = method;
  answer.estimate_name = "probability that as many pass as is asked";
  if (series.persons.size() == 1)
    say_of_one(answer, series.persons.front(), rule);
  else
    say_of_several(answer, series.persons, rule);
  return settled(std::move(answer));
}

}  // namespace seldinger::assessment::statistics
