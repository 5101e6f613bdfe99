#include "assessment/statistics/reliability/bland_altman.h"

#include <cmath>
#include <utility>
#include <vector>

#include "assessment/statistics/distributions.h"
#include "assessment/statistics/spread.h"

namespace seldinger::assessment::statistics {
namespace {

// The line of differences over means; a slope that is not 0 is a proportional bias.
void say_of_proportional_bias(Answer& answer, const std::vector<double>& differences,
                              const std::vector<double>& means) {
  const Spread of_means = spread_of(means), of_differences = spread_of(differences);
  if (means.size() < 3 || !of_means.computable || of_means.variance == 0.0) {
    answer.notes.emplace_back("It cannot be determined whether differences grow with what is measured.");
    return;
  }
  const double n = static_cast<double>(means.size()), spread = of_means.variance * (n - 1.0);
  double together = 0.0, rest = 0.0;
  for (std::size_t i = 0; i < means.size(); ++i)
    together += (means[i] - of_means.mean) * (differences[i] - of_differences.mean);
  const double slope = together / spread;
  for (std::size_t i = 0; i < means.size(); ++i) {
    const double off = differences[i] - of_differences.mean - slope * (means[i] - of_means.mean);
    rest += off * off;
  }
  const double se = std::sqrt(rest / (n - 2.0) / spread);
  const double p_value = 2.0 * student_t_upper(std::abs(slope) / se, n - 2.0);
  answer.more.push_back({"slope_over_mean", slope});
  answer.more.push_back({"slope_p_value", p_value});
  if (p_value < 0.05)
    answer.notes.emplace_back(
        "Differences change with what is measured (proportional bias): the limits are too wide at one end and too "
        "narrow at the other.");
}

}  // namespace

Answer bland_altman(const CompleteTable& table, double widths) {
  if (const char* reason = smaller_than(table, 2, 2)) return refused_table("bland_altman", reason, table);
  if (table.columns.size() > 2)
    return refused_table("bland_altman", "bad_value", table, "Two methods or two raters are compared, not more.");
  std::vector<double> differences, means;
  for (std::size_t i = 0; i < table.rows; ++i) {
    differences.push_back(table.at(i, 0) - table.at(i, 1));
    means.push_back(0.5 * (table.at(i, 0) + table.at(i, 1)));
  }
  const Spread spread = spread_of(differences);
  if (!spread.computable) return refused_table("bland_altman", "no_finite_answer", table);
  const double n = static_cast<double>(table.rows), sd = std::sqrt(spread.variance);
  const double low = spread.mean - widths * sd, high = spread.mean + widths * sd;
  Answer answer;
  answer.test = "bland_altman";
  answer.method =
      "Bland and Altman: mean difference (first less second) with its t interval; limits of agreement with "
      "intervals by √(3/n) SD";
  answer.n = table.rows;
  answer.missing = table.missing;
  answer.estimate = spread.mean;
  answer.estimate_name = "mean difference (" + table.columns[0] + " − " + table.columns[1] + ")";
  answer.more = {{"sd", sd}, {"limit_low", low}, {"limit_high", high}};
  if (sd > 0.0) {
    const double t = student_t_quantile(0.975, n - 1.0), se = sd / std::sqrt(n), se_limit = std::sqrt(3.0) * se;
    answer.ci95 = Interval{spread.mean - t * se, spread.mean + t * se};
    answer.statistic = spread.mean / se;
    answer.df = {n - 1.0};
    answer.p_value = 2.0 * student_t_upper(std::abs(*answer.statistic), n - 1.0);
    answer.more.push_back({"se_limit", se_limit});
    answer.more.push_back({"limit_low_ci95_low", low - t * se_limit});
    answer.more.push_back({"limit_low_ci95_high", low + t * se_limit});
    answer.more.push_back({"limit_high_ci95_low", high - t * se_limit});
    answer.more.push_back({"limit_high_ci95_high", high + t * se_limit});
    say_of_proportional_bias(answer, differences, means);
  } else {
    answer.notes.emplace_back("All differences are the same: there is no interval.");
  }
  if (table.missing > 0) answer.notes.emplace_back("Subjects that lack one of the two are left out.");
  return settled(std::move(answer));
}

}  // namespace seldinger::assessment::statistics
