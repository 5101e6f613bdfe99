#include "assessment/statistics/groups/brunner_munzel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "assessment/statistics/distributions.h"
#include "assessment/statistics/groups/power.h"
#include "assessment/statistics/groups/samples.h"
#include "assessment/statistics/roots.h"

namespace seldinger::assessment::statistics {
namespace {

constexpr std::size_t kSmallGroup = 15;

// Values of both groups in order, as lengths of runs of equal values; which group each place belongs to comes
// apart.
struct Pooled {
  std::vector<std::size_t> order;    // person at each place; the first group's come first
  std::vector<std::size_t> run_end;  // of each run, one past its last place
};

Pooled pooled(std::span<const double> a, std::span<const double> b) {
  const auto value = [&](std::size_t person) { return person < a.size() ? a[person] : b[person - a.size()]; };
  Pooled pool;
  for (std::size_t i = 0; i < a.size() + b.size(); ++i) pool.order.push_back(i);
  std::sort(pool.order.begin(), pool.order.end(),
            [&](std::size_t i, std::size_t j) { return value(i) < value(j); });
  for (std::size_t i = 1; i <= pool.order.size(); ++i)
    if (i == pool.order.size() || value(pool.order[i]) != value(pool.order[i - 1])) pool.run_end.push_back(i);
  return pool;
}

// How many of the other group lie below each value, ties as halves.
struct Placements {
  double n = 0.0, sum = 0.0, squares = 0.0;

  void add(double count, double placement) {
    n += count;
    sum += count * placement;
    squares += count * placement * placement;
  }
  double mean() const { return sum / n; }
  // Of whole numbers and halves: what is left of rounding is none.
  double variance() const {
    const double off = squares - sum * sum / n;
    return off > 1e-12 * squares ? off / (n - 1.0) : 0.0;
  }
};

// `is_first` tells of each person.
template <typename IsFirst>
Superiority superiority_of(const Pooled& pool, const IsFirst& is_first) {
  Placements first, second;
  double firsts_below = 0.0, seconds_below = 0.0;
  std::size_t place = 0;
  for (const std::size_t end : pool.run_end) {
    double firsts = 0.0;
    const double run = static_cast<double>(end - place);
    for (; place < end; ++place) firsts += is_first(pool.order[place]) ? 1.0 : 0.0;
    const double seconds = run - firsts;
    first.add(firsts, seconds_below + 0.5 * seconds);
    second.add(seconds, firsts_below + 0.5 * firsts);
    firsts_below += firsts;
    seconds_below += seconds;
  }
  const double n1 = first.n, n2 = second.n;
  const double part1 = first.variance() / (n1 * n2 * n2), part2 = second.variance() / (n2 * n1 * n1);
  Superiority result{first.mean() / n2, std::sqrt(part1 + part2), 0.0};
  result.df = (part1 + part2) * (part1 + part2) / (part1 * part1 / (n1 - 1.0) + part2 * part2 / (n2 - 1.0));
  return result;
}

// Size of the statistic; without an error it has no bound.
double extremeness(const Superiority& superiority) {
  const double off = std::abs(superiority.estimate - 0.5);
  if (superiority.error > 0.0) return off / superiority.error;
  return off > 0.0 ? std::numeric_limits<double>::infinity() : 0.0;
}

// Newcombe's limit for a probability that was observed as 1: where 1 − θ is 1.96 standard errors of θ.
double least_probability(double n1, double n2) {
  const double z = normal_quantile_of(0.975), n = 0.5 * (n1 + n2) - 1.0;
  return root_between(0.0, 1.0, [&](double theta) {
    const double within = 1.0 + n * ((1.0 - theta) / (2.0 - theta) + theta / (1.0 + theta));
    return (1.0 - theta) - z * z * theta * within / (n1 * n2);
  });
}

std::string method_of(const PermutationTest& test, std::size_t draws, double seed) {
  if (test.all) return "Brunner–Munzel, two-sided, studentised permutation, all deals";
  return "Brunner–Munzel, two-sided, studentised permutation, " + std::to_string(draws) + " drawn with seed " +
         std::to_string(static_cast<std::uint64_t>(seed));
}

}  // namespace

Superiority superiority(std::span<const double> a, std::span<const double> b) {
  return superiority_of(pooled(a, b), [&](std::size_t person) { return person < a.size(); });
}

Interval superiority_interval(const Superiority& superiority, double n1, double n2) {
  const double p = superiority.estimate;
  if (p == 1.0) return {least_probability(n1, n2), 1.0};
  if (p == 0.0) return {0.0, 1.0 - least_probability(n1, n2)};
  const double logit = std::log(p / (1.0 - p));
  const double wide = student_t_quantile(0.975, superiority.df) * superiority.error / (p * (1.0 - p));
  const auto back = [](double x) { return 1.0 / (1.0 + std::exp(-x)); };
  return {back(logit - wide), back(logit + wide)};
}

PermutationTest studentised_permutation(std::span<const double> a, std::span<const double> b, std::size_t draws,
                                        std::uint64_t seed) {
  const Pooled pool = pooled(a, b);
  const auto of_a = [&](std::size_t person) { return person < a.size(); };
  const double observed = extremeness(superiority_of(pool, of_a)) * (1.0 - 1e-12);
  std::size_t as_extreme = 0, most_extreme = 0;
  double most = 0.0;
  Exceedances deals({a.size() + b.size(), a.size(), draws, seed});
  deals.go([&](const std::vector<char>& is_first) {
    const double here =
        extremeness(superiority_of(pool, [&](std::size_t person) { return is_first[person] != 0; }));
    if (here >= observed) ++as_extreme;
    if (here > most * (1.0 + 1e-12)) most_extreme = 0;
    if (here >= most * (1.0 - 1e-12)) ++most_extreme;
    most = std::max(most, here);
  });
  return {deals.chance(as_extreme), deals.all(), deals.all() ? deals.chance(most_extreme) : deals.chance(0)};
}

Answer brunner_munzel(const DataTable& table, const ProcedureOptions& options) {
  const auto draws = number_within(options, "draws", 10'000, 1'000, 1'000'000);
  const auto seed = number_within(options, "seed", 1, 0, 9e15);
  if (!draws || !seed) return bad_option("brunner_munzel", "draws lies from 1000 to 1000000, seed from 0 to 9e15.");
  GroupsAsked asked = two_groups(table, options, 2);
  if (asked.reason != nullptr) return asked.refused("brunner_munzel");
  const Group &a = asked.groups.groups[0], &b = asked.groups.groups[1];
  if (pooled(a.values, b.values).run_end.size() == 1) {
    asked.reason = "all_tied";
    return asked.refused("brunner_munzel");
  }
  const Superiority found = superiority(a.values, b.values);
  const bool overlap = found.error > 0.0;
  const bool permute = std::min(a.values.size(), b.values.size()) < kSmallGroup || !overlap;
  PermutationTest test;
  const auto drawn = static_cast<std::size_t>(*draws);
  if (permute)
    test = studentised_permutation(a.values, b.values, drawn, static_cast<std::uint64_t>(*seed));
  else
    test.p_value = 2.0 * student_t_upper(std::abs(found.statistic()), found.df);
  Answer answer = asked.answer(
      "brunner_munzel", permute ? method_of(test, drawn, *seed) : "Brunner–Munzel, two-sided, t approximation");
  answer.p_value = test.p_value;
  answer.estimate = found.estimate;
  answer.estimate_name = "P(" + a.name + " > " + b.name + ") + ½ P(equal)";
  answer.more = {{"cliff_delta", 2.0 * found.estimate - 1.0}};
  const double n1 = static_cast<double>(a.values.size()), n2 = static_cast<double>(b.values.size());
  if (overlap) {
    answer.statistic = found.statistic();
    answer.df = {found.df};
    answer.more.push_back({"standard_error", found.error});
  } else {
    answer.notes.emplace_back(
        "The groups do not overlap: the statistic has no bound, and the interval is Newcombe's (method 5).");
  }
  if (permute) {
    answer.more.push_back({"smallest_p", test.smallest});
    answer.notes.push_back("Permutation p-values come in steps; here none is below " + in_words(test.smallest) +
                           ".");
  }
  answer.ci95 = superiority_interval(found, n1, n2);
  say_detectable(answer, "detectable_probability", "a probability that one group's value is the larger",
                 detectable_probability(std::sqrt((n1 + n2) / (12.0 * n1 * n2)), kPlannedPower, kAlpha), 1.0);
  return settled(std::move(answer));
}

}  // namespace seldinger::assessment::statistics
