#include "assessment/statistics/reliability/icc.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "assessment/statistics/distributions.h"
#include "assessment/statistics/reliability/pivotal_interval.h"
#include "sim/base/check.h"

namespace seldinger::assessment::statistics {
namespace {

constexpr double kUpper = 0.975;

// F over and under what it is at the ends of its interval.
Interval around_f(double f, double df1, double df2) {
  return {f / f_quantile(kUpper, df1, df2), f * f_quantile(kUpper, df2, df1)};
}

// Of ICC(2,1), whose F has no whole degrees of freedom: Satterthwaite's.
Interval agreement_interval(const TwoWay& s, double value) {
  const double raters = s.ms_raters / s.ms_error;
  const double a = s.k * value * raters, b = s.n * (1.0 + (s.k - 1.0) * value) - s.k * value;
  const double df = (s.k - 1.0) * (s.n - 1.0) * (a + b) * (a + b) / ((s.n - 1.0) * a * a + b * b);
  const double over = f_quantile(kUpper, s.n - 1.0, df), under = f_quantile(kUpper, df, s.n - 1.0);
  const double rest = s.k * s.ms_raters + (s.k * s.n - s.k - s.n) * s.ms_error;
  return {s.n * (s.ms_subjects - over * s.ms_error) / (over * rest + s.n * s.ms_subjects),
          s.n * (under * s.ms_subjects - s.ms_error) / (rest + s.n * under * s.ms_subjects)};
}

// Reliability of a mean of k from that of one (Spearman and Brown).
double of_mean(double one, double k) {
  if (one * (k - 1.0) <= -1.0) return -std::numeric_limits<double>::infinity();
  return one * k / (1.0 + one * (k - 1.0));
}

}  // namespace

std::array<Icc, 6> iccs(const TwoWay& s) {
  std::array<Icc, 6> found;
  const double f_within = s.ms_subjects / s.ms_within, f_error = s.ms_subjects / s.ms_error;
  const double df_within = s.n * (s.k - 1.0), df_error = (s.n - 1.0) * (s.k - 1.0);
  for (const std::size_t i : {0u, 3u}) found[i].f = f_within, found[i].df2 = df_within;
  for (const std::size_t i : {1u, 2u, 4u, 5u}) found[i].f = f_error, found[i].df2 = df_error;
  for (Icc& one : found) {
    one.df1 = s.n - 1.0;
    one.p_value = f_upper(one.f, one.df1, one.df2);
  }
  const double shift = (s.ms_raters - s.ms_error) / s.n;
  found[0].value = (s.ms_subjects - s.ms_within) / (s.ms_subjects + (s.k - 1.0) * s.ms_within);
  found[1].value = (s.ms_subjects - s.ms_error) / (s.ms_subjects + (s.k - 1.0) * s.ms_error + s.k * shift);
  found[2].value = (s.ms_subjects - s.ms_error) / (s.ms_subjects + (s.k - 1.0) * s.ms_error);
  found[3].value = (s.ms_subjects - s.ms_within) / s.ms_subjects;
  found[4].value = (s.ms_subjects - s.ms_error) / (s.ms_subjects + shift);
  found[5].value = (s.ms_subjects - s.ms_error) / s.ms_subjects;
  const Interval within = around_f(f_within, s.n - 1.0, df_within);
  const Interval error = around_f(f_error, s.n - 1.0, df_error);
  const auto of_one = [&](double f) { return (f - 1.0) / (f + s.k - 1.0); };
  const auto of_all = [](double f) { return 1.0 - 1.0 / f; };
  found[0].ci95 = {of_one(within.low), of_one(within.high)};
  found[1].ci95 = agreement_interval(s, found[1].value);
  found[2].ci95 = {of_one(error.low), of_one(error.high)};
  found[3].ci95 = {of_all(within.low), of_all(within.high)};
  found[4].ci95 = {of_mean(found[1].ci95.low, s.k), of_mean(found[1].ci95.high, s.k)};
  found[5].ci95 = {of_all(error.low), of_all(error.high)};
  // Within rounding of each other the ends may change places.
  for (Icc& one : found)
    if (one.ci95.low > one.ci95.high && one.ci95.low - one.ci95.high < 1e-9) std::swap(one.ci95.low, one.ci95.high);
  return found;
}

Interval pivotal_agreement_interval(const TwoWay& s, bool of_mean) {
  const std::array<MeanSquare, 3> squares = {
      {{s.ms_subjects, s.n - 1.0}, {s.ms_raters, s.k - 1.0}, {s.ms_error, (s.n - 1.0) * (s.k - 1.0)}}};
  return pivotal_interval(squares, kPivotalDraws, 1, [&](std::span<const double> ms) {
    const double subjects = std::max(0.0, ms[0] - ms[2]) / s.k, raters = std::max(0.0, ms[1] - ms[2]) / s.n;
    return subjects / (subjects + (raters + ms[2]) / (of_mean ? s.k : 1.0));
  });
}

MeasurementError measurement_error(double sd, double reliability) {
  const double sem = sd * std::sqrt(1.0 - reliability);
  return {sem, 1.96 * std::numbers::sqrt2 * sem};
}

Answer icc(const CompleteTable& table, std::size_t form) {
  CHECK(form < kIccForms.size());
  if (const char* reason = smaller_than(table, 2, 2)) return refused_table("icc", reason, table);
  const TwoWay scores = two_way(table);
  if (scores.sd == 0.0) return refused_table("icc", "no_variation", table);
  const std::array<Icc, 6> all = iccs(scores);
  const Icc& asked = all[form];
  Answer answer;
  answer.test = "icc";
  answer.method =
      std::string(kIccForms[form].words) + "; 95 % interval by F; SEM = SD √(1 − ICC), MDC95 = 1.96 √2 SEM";
  answer.n = table.rows;
  answer.missing = table.missing;
  answer.statistic = asked.f;
  answer.df = {asked.df1, asked.df2};
  answer.p_value = asked.p_value;
  answer.estimate = asked.value;
  answer.estimate_name = kIccForms[form].words;
  answer.ci95 = asked.ci95;
  const bool mean = form >= 3;
  const MeasurementError wrong = measurement_error(mean ? scores.sd_of_means : scores.sd, asked.value);
  answer.more = {{"raters", scores.k},
                 {"ms_subjects", scores.ms_subjects},
                 {"ms_raters", scores.ms_raters},
                 {"ms_error", scores.ms_error},
                 {"ms_within", scores.ms_within},
                 {"sd", mean ? scores.sd_of_means : scores.sd},
                 {"sem", wrong.sem},
                 {"mdc95", wrong.mdc95}};
  for (std::size_t i = 0; i < all.size(); ++i)
    answer.rows.push_back(
        {kIccForms[i].name,
         {{"icc", all[i].value}, {"ci95_low", all[i].ci95.low}, {"ci95_high", all[i].ci95.high}}});
  if ((form == 1 || form == 4) && scores.k < kEnoughRaters && scores.ms_error > 0.0) {
    const Interval wider = pivotal_agreement_interval(scores, mean);
    answer.more.push_back({"pivotal_ci95_low", wider.low});
    answer.more.push_back({"pivotal_ci95_high", wider.high});
    answer.notes.emplace_back(
        "With fewer than twenty raters the F interval of agreement is too narrow where raters differ: the pivotal "
        "one "
        "covers.");
  }
  if (asked.value < 0.0)
    answer.notes.emplace_back("A subject's scores differ more than subjects do: a negative ICC is shown as it is.");
  if (scores.ms_error == 0.0)
    answer.notes.emplace_back("Raters differ by a constant or not at all: an interval by F is not defined.");
  if (table.missing > 0) answer.notes.emplace_back("Subjects that some rater did not score are left out.");
  return settled(std::move(answer));
}

}  // namespace seldinger::assessment::statistics
