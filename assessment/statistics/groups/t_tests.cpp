#include "assessment/statistics/groups/t_tests.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "assessment/statistics/distributions.h"
#include "assessment/statistics/groups/power.h"
#include "assessment/statistics/groups/samples.h"
#include "assessment/statistics/spread.h"

namespace seldinger::assessment::statistics {
namespace {

// An error of rounding only is none.
const char* why_no_error(const Spread& a, const Spread& b, double error) {
  if (!a.computable || !b.computable) return "no_finite_answer";
  if (!a.varies && !b.varies) return "no_variation_within";
  const double largest = std::max(std::abs(a.mean), std::abs(b.mean));
  return error > 10.0 * std::numeric_limits<double>::epsilon() * largest ? nullptr : "no_finite_answer";
}

void tell(Answer& answer, const MeanDifference& difference, std::string name) {
  answer.statistic = difference.t();
  answer.df = {difference.df};
  answer.p_value = difference.p_value();
  answer.estimate = difference.estimate;
  answer.estimate_name = std::move(name);
  answer.ci95 = difference.interval(0.95);
  answer.more.push_back({"standard_error", difference.error});
}

void tell_detectable(Answer& answer, const MeanDifference& difference) {
  say_detectable(answer, "detectable_difference", "a difference",
                 detectable_errors(difference.df, kPlannedPower, kAlpha) * difference.error,
                 std::numeric_limits<double>::max());
}

std::string first_minus_second(const char* what, const std::string& first, const std::string& second) {
  return std::string(what) + " (" + first + " − " + second + ")";
}

using Difference = MeanDifference (*)(std::span<const double>, std::span<const double>);

Answer of_two_groups(const DataTable& table, const ProcedureOptions& options, const char* test, const char* method,
                     Difference difference_of) {
  GroupsAsked asked = two_groups(table, options, 2);
  if (asked.reason != nullptr) return asked.refused(test);
  const Group &a = asked.groups.groups[0], &b = asked.groups.groups[1];
  const MeanDifference difference = difference_of(a.values, b.values);
  if (difference.reason != nullptr) {
    asked.reason = difference.reason;
    return asked.refused(test);
  }
  Answer answer = asked.answer(test, method);
  tell(answer, difference, first_minus_second("difference of means", a.name, b.name));
  for (const Group* group : {&a, &b}) {
    const Spread spread = spread_of(group->values);
    answer.rows.push_back({group->name, {{"mean", spread.mean}, {"sd", std::sqrt(spread.variance)}}});
  }
  tell_detectable(answer, difference);
  return settled(std::move(answer));
}

// Margins of equivalence: margin=m, or low= and high=; nothing: none were given that hold a 0 between them.
std::optional<Interval> margins(const ProcedureOptions& options) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  Interval margins{none, none};
  if (options.has("margin") && !options.has("low") && !options.has("high")) {
    const std::optional<double> margin = options.number("margin", none);
    if (margin) margins = {-*margin, *margin};
  } else if (options.has("low") && options.has("high") && !options.has("margin")) {
    margins = {options.number("low", none).value_or(none), options.number("high", none).value_or(none)};
  }
  return margins.low < 0.0 && margins.high > 0.0 ? std::optional(margins) : std::nullopt;
}

}  // namespace

double MeanDifference::p_value() const {
  return 2.0 * student_t_upper(std::abs(t()), df);
}

Interval MeanDifference::interval(double confidence) const {
  const double wide = student_t_quantile(0.5 + confidence / 2.0, df) * error;
  return {estimate - wide, estimate + wide};
}

MeanDifference welch_difference(std::span<const double> a, std::span<const double> b) {
  const Spread of_a = spread_of(a), of_b = spread_of(b);
  const double n1 = static_cast<double>(a.size()), n2 = static_cast<double>(b.size());
  const double share_a = of_a.variance / n1, share_b = of_b.variance / n2, sum = share_a + share_b;
  MeanDifference difference{of_a.mean - of_b.mean, std::sqrt(sum)};
  // By shares of the sum: squares of variances may be too large or too small for a number.
  const double part_a = share_a / sum, part_b = share_b / sum;
  difference.df = 1.0 / (part_a * part_a / (n1 - 1.0) + part_b * part_b / (n2 - 1.0));
  difference.reason = why_no_error(of_a, of_b, difference.error);
  return difference;
}

MeanDifference pooled_difference(std::span<const double> a, std::span<const double> b) {
  const Spread of_a = spread_of(a), of_b = spread_of(b);
  const double n1 = static_cast<double>(a.size()), n2 = static_cast<double>(b.size());
  const double pooled = ((n1 - 1.0) * of_a.variance + (n2 - 1.0) * of_b.variance) / (n1 + n2 - 2.0);
  MeanDifference difference{of_a.mean - of_b.mean, std::sqrt(pooled * (1.0 / n1 + 1.0 / n2)), n1 + n2 - 2.0};
  difference.reason = why_no_error(of_a, of_b, difference.error);
  return difference;
}

MeanDifference mean_of(std::span<const double> differences) {
  const Spread spread = spread_of(differences);
  const double n = static_cast<double>(differences.size());
  MeanDifference mean{spread.mean, std::sqrt(spread.variance / n), n - 1.0};
  mean.reason = why_no_error(spread, spread, mean.error);
  if (spread.computable && !spread.varies) mean.reason = "no_variation";
  return mean;
}

Answer welch(const DataTable& table, const ProcedureOptions& options) {
  return of_two_groups(table, options, "welch", "Welch's t-test, two-sided, unequal variances", welch_difference);
}

Answer student(const DataTable& table, const ProcedureOptions& options) {
  Answer answer =
      of_two_groups(table, options, "student", "Student's t-test, two-sided, equal variances", pooled_difference);
  if (answer.estimable()) answer.notes.emplace_back("It assumes equal variances; Welch's t-test does not.");
  return answer;
}

Answer paired(const DataTable& table, const ProcedureOptions& options) {
  Pairs pairs = complete_pairs(table, options, 2);
  if (pairs.blocks.reason != nullptr) return pairs.blocks.refused("paired");
  const MeanDifference difference = mean_of(pairs.differences);
  if (difference.reason != nullptr) {
    pairs.blocks.reason = difference.reason;
    return pairs.blocks.refused("paired");
  }
  Answer answer = pairs.blocks.answer("paired", "t-test of paired values, two-sided");
  const std::vector<std::string>& names = pairs.blocks.conditions;
  tell(answer, difference, first_minus_second("mean of differences", names[0], names[1]));
  const double sd = std::sqrt(spread_of(pairs.differences).variance);
  answer.more.push_back({"sd_of_differences", sd});
  answer.more.push_back({"d_z", difference.estimate / sd});
  tell_detectable(answer, difference);
  return settled(std::move(answer));
}

Answer tost(const DataTable& table, const ProcedureOptions& options) {
  const std::optional<Interval> allowed = margins(options);
  if (!allowed)
    return bad_option("tost",
                      "Give margin=m, a number above 0, or low= below 0 and high= above 0, in the value's unit.");
  GroupsAsked asked = two_groups(table, options, 2);
  if (asked.reason != nullptr) return asked.refused("tost");
  const Group &a = asked.groups.groups[0], &b = asked.groups.groups[1];
  const MeanDifference difference = welch_difference(a.values, b.values);
  if (difference.reason != nullptr) {
    asked.reason = difference.reason;
    return asked.refused("tost");
  }
  const double above_low = student_t_upper(difference.t(allowed->low), difference.df);
  const double below_high = student_t_cdf(difference.t(allowed->high), difference.df);
  Answer answer = asked.answer("tost", "equivalence by two one-sided tests, Welch; p is the larger of the two");
  answer.statistic = above_low > below_high ? difference.t(allowed->low) : difference.t(allowed->high);
  answer.df = {difference.df};
  answer.p_value = std::max(above_low, below_high);
  answer.estimate = difference.estimate;
  answer.estimate_name = first_minus_second("difference of means", a.name, b.name);
  answer.ci95 = difference.interval(0.95);
  const Interval ci90 = difference.interval(0.90);
  answer.more = {{"margin_low", allowed->low}, {"margin_high", allowed->high}, {"p_above_low", above_low},
                 {"p_below_high", below_high}, {"ci90_low", ci90.low},         {"ci90_high", ci90.high}};
  answer.notes.push_back(std::string("The 90 % interval lies ") +
                         (*answer.p_value < kAlpha ? "within" : "not within") + " the margins: equivalence is " +
                         (*answer.p_value < kAlpha ? "" : "not ") + "shown at α = .05.");
  return settled(std::move(answer));
}

}  // namespace seldinger::assessment::statistics
