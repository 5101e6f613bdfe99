#include "assessment/statistics/growth/decay.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "assessment/statistics/distributions.h"
#include "assessment/statistics/growth/series.h"
#include "assessment/statistics/spread.h"

namespace seldinger::assessment::statistics {
namespace {

constexpr const char* kDecay = "decay";
constexpr std::size_t kLeastPersons = 3;

struct Pauses {
  std::vector<double> length, loss;
};

Pauses pauses_of(const Series& one, const DecayOptions& options) {
  Pauses found;
  for (std::size_t i = 1; i < one.values.size(); ++i) {
    const double length = one.x[i] - one.x[i - 1];
    if (!(length >= options.pause)) continue;
    const double change = one.values[i] - one.values[i - 1];
    found.length.push_back(length);
    found.loss.push_back(options.higher_is_better ? -change : change);
  }
  return found;
}

// Least squares through all pauses, each against the middle of its person's: who pauses longer may be another
// person.
std::optional<double> per_doubling(const std::vector<Pauses>& persons) {
  double products = 0.0, squares = 0.0;
  for (const Pauses& one : persons) {
    std::vector<double> logs;
    for (const double length : one.length) logs.push_back(std::log2(length));
    const double middle = spread_of(logs).mean, loss = spread_of(one.loss).mean;
    for (std::size_t i = 0; i < logs.size(); ++i) {
      products += (logs[i] - middle) * (one.loss[i] - loss);
      squares += (logs[i] - middle) * (logs[i] - middle);
    }
  }
  return squares > 1e-9 ? std::optional(products / squares) : std::nullopt;
}

Answer refused(const PersonsSeries& series, const char* reason, const char* why, std::size_t persons) {
  Answer answer = not_estimable(kDecay, reason, persons);
  answer.missing = series.missing;
  answer.notes.emplace_back(why);
  return answer;
}

}  // namespace

Answer decay(const DataTable& table, const DecayOptions& options) {
  const PersonsSeries series = persons_series(table);
  if (!(options.pause > 0.0) || !std::isfinite(options.pause))
    return refused(series, "bad_value", "pause is a number above 0.", 0);
  if (series.values == 0) return refused(series, "no_data", "There is no value.", 0);
  std::vector<Pauses> persons;
  std::vector<double> losses;
  Answer answer;
  for (const Series& one : series.persons) {
    Pauses pauses = pauses_of(one, options);
    if (pauses.loss.empty()) continue;
    losses.push_back(spread_of(pauses.loss).mean);
    answer.rows.push_back({one.person,
                           {{"pauses", static_cast<double>(pauses.loss.size())},
                            {"pause", spread_of(pauses.length).mean},
                            {"loss", losses.back()}}});
    persons.push_back(std::move(pauses));
  }
  if (losses.size() < kLeastPersons)
    return refused(series, "too_few", "Three persons or more have to come back after a pause.", losses.size());
  const Spread spread = spread_of(losses);
  if (!spread.computable) return refused(series, "no_finite_answer", "A value is too large.", losses.size());
  const double n = static_cast<double>(losses.size()), se = std::sqrt(spread.variance / n);
  answer.test = kDecay;
  answer.method = "mean over persons of the first value after a pause against the last before it; interval by t";
  answer.n = losses.size();
  answer.missing = series.missing;
  answer.df = {n - 1.0};
  answer.estimate = spread.mean;
  answer.estimate_name = "loss over a pause";
  if (se > 0.0) {
    const double reach = student_t_quantile(0.975, n - 1.0) * se;
    answer.ci95 = Interval{spread.mean - reach, spread.mean + reach};
    answer.statistic = spread.mean / se;
    answer.p_value = 2.0 * student_t_upper(std::abs(*answer.statistic), n - 1.0);
  }
  std::vector<double> lengths;
  for (const Row& row : answer.rows) lengths.push_back(row.values[1].value);
  answer.more = {{"pause", spread_of(lengths).mean}};
  if (const auto slope = per_doubling(persons)) answer.more.push_back({"loss_per_doubling", *slope});
  if (losses.size() < series.persons.size())
    answer.notes.push_back(std::to_string(series.persons.size() - losses.size()) +
                           " persons never paused, or did not come back, and contribute nothing.");
  answer.notes.emplace_back("Those who do not come back are not in it: their loss may be larger.");
  return settled(std::move(answer));
}

}  // namespace seldinger::assessment::statistics
