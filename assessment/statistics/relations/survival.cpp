#include "assessment/statistics/relations/survival.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "assessment/statistics/distributions.h"
#include "assessment/statistics/relations/observations.h"
#include "assessment/statistics/relations/proportions.h"
#include "assessment/statistics/square_matrix.h"

namespace seldinger::assessment::statistics {
namespace {

// A survival counts as one half up to rounding.
constexpr double kHalf = 1e-9;

void sort_by_time(std::vector<Followed>& persons) {
  std::sort(persons.begin(), persons.end(), [](const Followed& a, const Followed& b) { return a.time < b.time; });
}

// The first time where `curve` of a step is at most one half; the middle of the times where it is just that.
template <typename Curve>
std::optional<double> time_at_half(std::span<const SurvivalStep> steps, double last_followed, const Curve& curve) {
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (curve(steps[i]) > 0.5 + kHalf) continue;
    if (curve(steps[i]) < 0.5 - kHalf) return steps[i].time;
    std::size_t next = i + 1;
    while (next < steps.size() && curve(steps[next]) >= 0.5 - kHalf) ++next;
    return 0.5 * steps[i].time + 0.5 * (next < steps.size() ? steps[next].time : last_followed);
  }
  return std::nullopt;
}

double last_of(std::span<const Followed> persons) {
  double last = 0.0;
  for (const Followed& person : persons) last = std::max(last, person.time);
  return last;
}

// Groups of persons, and why nothing can be made of them.
struct FollowedGroups {
  Observations rows;
  std::vector<std::vector<Followed>> groups;
  const char* reason = nullptr;
  const char* note = nullptr;
};

FollowedGroups followed_groups(const DataTable& table, const ProcedureOptions& options) {
  FollowedGroups found{.rows = observations(table, {.x = true, .group = true}, options), .groups = {}};
  const Observations& rows = found.rows;
  const std::vector<double>& times = rows.values[0];
  if (rows.reason != nullptr) {
    found.reason = rows.reason;
  } else if (rows.n == 0 || rows.x.empty()) {
    found.reason = "no_data";
  } else if (std::any_of(times.begin(), times.end(), [](double one) { return one < 0.0; }) ||
             !all_zero_or_one(rows.x)) {
    found.reason = "bad_value";
    found.note =
        "A time is 0 or more; x is 1 where the event happened then, 0 where the person was not followed any "
        "longer.";
  } else if (std::find(rows.x.begin(), rows.x.end(), 1.0) == rows.x.end()) {
    found.reason = "no_event";
  }
  if (found.reason != nullptr) return found;
  found.groups.resize(rows.groups.size());
  for (std::size_t i = 0; i < rows.n; ++i) found.groups[rows.group[i]].push_back({times[i], rows.x[i] == 1.0});
  for (const std::vector<Followed>& group : found.groups)
    if (group.empty()) found.reason = "group_too_small";
  return found;
}

// What log_rank and a two-group rmst ask beyond that.
const char* not_comparable(const FollowedGroups& followed) {
  if (followed.reason != nullptr) return followed.reason;
  return followed.groups.size() < 2 ? "one_group" : nullptr;
}

void add_median(Answer& answer, const std::string& name, const MedianTime& median) {
  if (median.time) answer.more.push_back({"median " + name, *median.time});
  if (median.low) answer.more.push_back({"median_low " + name, *median.low});
  if (median.high) answer.more.push_back({"median_high " + name, *median.high});
  if (!median.time)
    answer.notes.push_back("Less than half of " + name + " had the event: there is no median time.");
  else if (!median.low || !median.high)
    answer.notes.push_back("The median time of " + name + " has no bound on one side in these data.");
}

// Hazard ratio of the first group, by one step from equality.
void add_hazard_ratio(Answer& answer, const LogRank& found) {
  const double log_ratio = (found.observed[0] - found.expected[0]) / found.variance;
  const double half = normal_quantile_of(0.975) / std::sqrt(found.variance);
  answer.estimate = std::exp(log_ratio);
  answer.ci95 = Interval{std::exp(log_ratio - half), std::exp(log_ratio + half)};
  answer.estimate_name = "hazard ratio (" + answer.groups[0].name + " / " + answer.groups[1].name + "), Peto";
  const double far = std::abs(log_ratio);
  if (far > std::log(3.0))
    answer.notes.emplace_back("Peto's hazard ratio is drawn towards 1 when it is this far from it.");
}

// (O − E)ᵀ V⁻¹ (O − E) over all but one of the groups that were at risk at an event.
void solve(LogRank& found, const SquareMatrix& variance) {
  std::vector<std::size_t> at_risk;
  for (std::size_t g = 0; g < found.expected.size(); ++g)
    if (found.expected[g] > 0.0) at_risk.push_back(g);
  if (at_risk.size() < 2) return;
  at_risk.pop_back();
  SquareMatrix part(at_risk.size());
  for (std::size_t i = 0; i < part.n; ++i)
    for (std::size_t j = 0; j < part.n; ++j) part.at(i, j) = variance.at(at_risk[i], at_risk[j]);
  const std::optional<SquareMatrix> inverse = inverse_of(part);
  if (!inverse) return;
  const auto excess_of = [&](std::size_t i) { return found.observed[at_risk[i]] - found.expected[at_risk[i]]; };
  found.df = part.n;
  for (std::size_t i = 0; i < part.n; ++i)
    for (std::size_t j = 0; j < part.n; ++j) found.chi_squared += excess_of(i) * inverse->at(i, j) * excess_of(j);
}

// Whether the group's curve is known up to tau.
bool reaches(std::span<const Followed> group, double tau) {
  const double last = last_of(group);
  // Where everybody who was followed longest had the event, the curve is 0 from there.
  return tau <= last || std::none_of(group.begin(), group.end(), [last](const Followed& person) {
           return person.time == last && !person.event;
         });
}

}  // namespace

std::vector<SurvivalStep> kaplan_meier_of(std::vector<Followed> persons) {
  sort_by_time(persons);
  const double z = normal_quantile_of(0.975);
  std::vector<SurvivalStep> steps;
  double survival = 1.0, greenwood = 0.0, last_high = 1.0;
  for (std::size_t from = 0, to = 0; from < persons.size(); from = to) {
    std::size_t events = 0;
    for (; to < persons.size() && persons[to].time == persons[from].time; ++to) events += persons[to].event;
    if (events == 0) continue;
    const auto at_risk = static_cast<double>(persons.size() - from), died = static_cast<double>(events);
    survival *= (at_risk - died) / at_risk;
    SurvivalStep step;
    step.time = persons[from].time;
    step.at_risk = persons.size() - from;
    step.events = events;
    step.survival = survival;
    if (survival > 0.0) {
      greenwood += died / (at_risk * (at_risk - died));
      step.standard_error = survival * std::sqrt(greenwood);
      const double spread = z * std::sqrt(greenwood) / std::log(survival);  // below 0
      step.ci95 = {std::pow(survival, std::exp(-spread)), std::pow(survival, std::exp(spread))};
      last_high = step.ci95.high;
    } else {
      const auto n = static_cast<std::int64_t>(step.at_risk);
      step.ci95 = {0.0, std::min(last_high, clopper_pearson_interval(0, n).high)};
    }
    steps.push_back(step);
  }
  return steps;
}

MedianTime median_time(std::span<const SurvivalStep> steps, double last_followed) {
  // Where nobody is left there is no interval of the survival, and none of the median from it.
  const auto at_half = [&](const auto& limit) {
    return time_at_half(steps, last_followed,
                        [&](const SurvivalStep& step) { return step.survival > 0.0 ? limit(step) : 1.0; });
  };
  return {time_at_half(steps, last_followed, [](const SurvivalStep& step) { return step.survival; }),
          at_half([](const SurvivalStep& step) { return step.ci95.low; }),
          at_half([](const SurvivalStep& step) { return step.ci95.high; })};
}

RestrictedMean restricted_mean(std::span<const SurvivalStep> steps, double tau) {
  RestrictedMean found;
  double variance = 0.0, until = tau;
  // Backwards: the area from each event to tau is what the event's uncertainty weighs.
  for (std::size_t i = steps.size(); i-- > 0;) {
    if (steps[i].time > tau) continue;
    found.mean += steps[i].survival * (until - steps[i].time);
    until = steps[i].time;
    const auto at_risk = static_cast<double>(steps[i].at_risk), events = static_cast<double>(steps[i].events);
    if (at_risk > events) variance += found.mean * found.mean * events / (at_risk * (at_risk - events));
  }
  found.mean += until;
  found.standard_error = std::sqrt(variance);
  return found;
}

LogRank log_rank_of(std::span<const std::vector<Followed>> groups) {
  struct Placed {
    double time;
    bool event;
    std::size_t group;
  };
  std::vector<Placed> all;
  std::vector<double> at_risk, died(groups.size());
  for (std::size_t g = 0; g < groups.size(); ++g) {
    at_risk.push_back(static_cast<double>(groups[g].size()));
    for (const Followed& person : groups[g]) all.push_back({person.time, person.event, g});
  }
  std::sort(all.begin(), all.end(), [](const Placed& a, const Placed& b) { return a.time < b.time; });
  LogRank found;
  found.observed.assign(groups.size(), 0.0);
  found.expected.assign(groups.size(), 0.0);
  SquareMatrix variance(groups.size());
  double left = static_cast<double>(all.size());
  for (std::size_t from = 0, to = 0; from < all.size(); from = to) {
    std::fill(died.begin(), died.end(), 0.0);
    for (to = from; to < all.size() && all[to].time == all[from].time; ++to) died[all[to].group] += all[to].event;
    double events = 0.0;
    for (const double one : died) events += one;
    const double factor = left > 1.0 ? events * (left - events) / (left - 1.0) : 0.0;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      found.observed[g] += died[g];
      found.expected[g] += events * at_risk[g] / left;
      for (std::size_t h = 0; h < groups.size(); ++h)
        variance.at(g, h) += factor * at_risk[g] / left * ((g == h ? 1.0 : 0.0) - at_risk[h] / left);
    }
    for (std::size_t i = from; i < to; ++i) at_risk[all[i].group] -= 1.0;
    left -= static_cast<double>(to - from);
  }
  found.variance = variance.at(0, 0);
  solve(found, variance);
  return found;
}

Answer kaplan_meier(const DataTable& table, const ProcedureOptions& options) {
  const FollowedGroups followed = followed_groups(table, options);
  if (followed.reason != nullptr) return refused("kaplan_meier", followed.reason, followed.rows, followed.note);
  Answer answer = begun("kaplan_meier", followed.rows);
  answer.method = "Kaplan–Meier, Greenwood's standard error, log(−log) intervals; without the event: censored";
  for (std::size_t g = 0; g < followed.groups.size(); ++g) {
    const std::vector<SurvivalStep> steps = kaplan_meier_of(followed.groups[g]);
    for (const SurvivalStep& step : steps)
      answer.rows.push_back({answer.groups[g].name,
                             {{"time", step.time},
                              {"at_risk", static_cast<double>(step.at_risk)},
                              {"events", static_cast<double>(step.events)},
                              {"survival", step.survival},
                              {"se", step.standard_error},
                              {"low", step.ci95.low},
                              {"high", step.ci95.high}}});
    const MedianTime median = median_time(steps, last_of(followed.groups[g]));
    if (followed.groups.size() > 1) {
      add_median(answer, answer.groups[g].name, median);
      continue;
    }
    answer.estimate_name = "median time";
    answer.estimate = median.time;
    if (median.low && median.high) answer.ci95 = Interval{*median.low, *median.high};
    if (median.low && !median.high) answer.more.push_back({"median_low", *median.low});
    if (!median.time) answer.notes.emplace_back("Less than half had the event: there is no median time.");
    if (median.time && !answer.ci95)
      answer.notes.emplace_back("The median time has no bound on one side in these data.");
  }
  return settled(std::move(answer));
}

Answer log_rank(const DataTable& table, const ProcedureOptions& options) {
  const FollowedGroups followed = followed_groups(table, options);
  if (const char* reason = not_comparable(followed))
    return refused("log_rank", reason, followed.rows, followed.note);
  const LogRank found = log_rank_of(followed.groups);
  if (found.df == 0)
    return refused("log_rank", "no_difference", followed.rows,
                   "At no time of an event are two groups still at risk.");
  Answer answer = begun("log_rank", followed.rows);
  answer.method = "log-rank test, asymptotic; without the event: censored";
  answer.statistic = found.chi_squared;
  answer.df = {static_cast<double>(found.df)};
  if (found.df + 1 < followed.groups.size())
    answer.notes.emplace_back("A group that was not at risk at any event is left out of the test.");
  answer.p_value = chi_squared_upper(found.chi_squared, answer.df[0]);
  for (std::size_t g = 0; g < followed.groups.size(); ++g)
    answer.rows.push_back(
        {answer.groups[g].name, {{"observed", found.observed[g]}, {"expected", found.expected[g]}}});
  if (followed.groups.size() == 2) add_hazard_ratio(answer, found);
  warn_of_test(answer, 24);
  return settled(std::move(answer));
}

Answer rmst(const DataTable& table, const ProcedureOptions& options) {
  const FollowedGroups followed = followed_groups(table, options);
  if (followed.reason != nullptr) return refused("rmst", followed.reason, followed.rows, followed.note);
  if (followed.groups.size() > 2) return refused("rmst", "not_two_groups", followed.rows);
  double tau = INFINITY;
  for (const std::vector<Followed>& group : followed.groups) tau = std::min(tau, last_of(group));
  const std::optional<double> asked = options.number("tau", tau);
  if (!asked || !(*asked > 0.0)) return refused("rmst", "bad_value", followed.rows, "tau is a time above 0.");
  tau = *asked;
  Answer answer = begun("rmst", followed.rows);
  answer.method = "area under the Kaplan–Meier curve up to tau, normal interval; without the event: censored";
  answer.more = {{"tau", tau}};
  std::vector<RestrictedMean> means;
  for (std::size_t g = 0; g < followed.groups.size(); ++g) {
    if (!reaches(followed.groups[g], tau))
      return refused("rmst", "bad_value", followed.rows, "tau is later than anybody in a group was followed.");
    means.push_back(restricted_mean(kaplan_meier_of(followed.groups[g]), tau));
    answer.rows.push_back({answer.groups[g].name, {{"mean", means[g].mean}, {"se", means[g].standard_error}}});
  }
  const bool two = means.size() == 2;
  answer.estimate_name =
      two ? "difference of mean times up to tau (" + answer.groups[0].name + " − " + answer.groups[1].name + ")"
          : "mean time up to tau";
  answer.estimate = two ? means[0].mean - means[1].mean : means[0].mean;
  const double error = two ? std::hypot(means[0].standard_error, means[1].standard_error) : means[0].standard_error;
  if (!(error > 0.0)) {
    answer.notes.emplace_back("No event before tau leaves any uncertainty: there is no interval.");
    return settled(std::move(answer));
  }
  const double half = normal_quantile_of(0.975) * error;
  answer.ci95 = Interval{*answer.estimate - half, *answer.estimate + half};
  if (two) {
    answer.statistic = *answer.estimate / error;
    answer.p_value = 2.0 * normal_upper(std::abs(*answer.statistic));
  }
  warn_of_interval(answer, 50);
  warn_of_test(answer, 24);
  return settled(std::move(answer));
}

}  // namespace seldinger::assessment::statistics
