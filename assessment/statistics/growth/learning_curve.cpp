#include "assessment/statistics/growth/learning_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "assessment/statistics/distributions.h"
#include "assessment/statistics/growth/series.h"

namespace seldinger::assessment::statistics {
namespace {

constexpr double kFarAway = 1e6;  // attempts: nobody plans for more

const char* name_of(CurveKind kind) {
  return kind == CurveKind::power ? "power" : "exponential";
}

bool learned(const LearningCurve& curve, bool higher_is_better) {
  return curve.b > 0.0 && (higher_is_better ? curve.a < 0.0 : curve.a > 0.0);
}

// When so much of the way from `first` to the plateau is gone.
double arrival(const LearningCurve& curve, double first, double closed) {
  const double left = -std::log1p(-closed) / curve.b;
  return curve.kind == CurveKind::power ? first * std::exp(left) : first + left;
}

bool too_sudden(const LearningCurve& curve, const std::vector<double>& x, double closed) {
  return arrival(curve, x.front(), closed) < *std::upper_bound(x.begin(), x.end(), x.front());
}

struct BothCurves {
  std::optional<LearningCurve> power, exponential;

  // Both have as many parameters: where AICc is, the smaller one is the smaller sum of squares.
  const LearningCurve* better() const {
    if (!power) return exponential ? &*exponential : nullptr;
    return exponential && exponential->rss < power->rss ? &*exponential : &*power;
  }
};

BothCurves both(const Series& series) {
  return {fit_curve(CurveKind::power, series.x, series.values),
          fit_curve(CurveKind::exponential, series.x, series.values)};
}

std::vector<Named> numbers(const LearningCurve& curve) {
  std::vector<Named> values{{"a", curve.a}, {"b", curve.b}, {"c", curve.c}, {"rss", curve.rss}};
  if (curve.aicc) values.push_back({"aicc", *curve.aicc});
  return values;
}

void add_ways(Answer& answer, const LearningCurve& curve, double first, double closed) {
  const double half = arrival(curve, first, 0.5), arrived = arrival(curve, first, closed);
  if (half < kFarAway) answer.more.push_back({"half_way_at", half});
  if (arrived < kFarAway) {
    answer.more.push_back({"plateau_reached_at", arrived});
  } else {
    answer.notes.emplace_back("The plateau is further away than a million attempts: these values do not show it.");
  }
}

void tell_one(Answer& answer, const Series& series, const BothCurves& curves, const LearningCurveOptions& options) {
  for (const auto& curve : {curves.power, curves.exponential})
    if (curve) answer.rows.push_back({name_of(curve->kind), numbers(*curve)});
  const LearningCurve& best = *curves.better();
  answer.method = std::string("least squares over all three parameters, the ") + name_of(best.kind) +
                  (best.kind == CurveKind::power ? " curve y = a·t^−b + c" : " curve y = a·exp(−b·t) + c") +
                  (best.aicc ? " by AICc" : " by its smaller sum of squares");
  answer.estimate = best.b;
  answer.estimate_name = "learning rate b";
  const auto df = static_cast<double>(series.values.size() - 3);
  answer.df = {df};
  if (!best.at_bound && std::isfinite(best.se_b)) {
    const double reach = student_t_quantile(0.975, df) * best.se_b;
    answer.ci95 = Interval{best.b - reach, best.b + reach};
  }
  answer.more = {{"attempts", static_cast<double>(series.values.size())}, {"a", best.a}, {"plateau", best.c}};
  if (!best.at_bound && std::isfinite(best.se_c)) {
    const double reach = student_t_quantile(0.975, df) * best.se_c;
    answer.more.push_back({"plateau_low", best.c - reach});
    answer.more.push_back({"plateau_high", best.c + reach});
  }
  if (best.at_bound)
    answer.notes.emplace_back(
        "The rate is at the edge of what is searched: these values show no curve of this form.");
  if (!learned(best, options.higher_is_better)) {
    answer.notes.emplace_back("No learning detected.");
  } else if (too_sudden(best, series.x, options.closed)) {
    answer.notes.emplace_back(kTooSudden);
  } else {
    add_ways(answer, best, series.x.front(), options.closed);
  }
}

double median_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

Answer of_several(Answer answer, const PersonsSeries& series, const LearningCurveOptions& options) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> rates;
  std::size_t learners = 0;
  for (const Series& one : series.persons) {
    const BothCurves curves = both(one);
    const LearningCurve* best = curves.better();
    if (best == nullptr) continue;
    const bool does = learned(*best, options.higher_is_better) && !too_sudden(*best, one.x, options.closed);
    learners += does ? 1 : 0;
    rates.push_back(best->b);
    const double arrived = does ? arrival(*best, one.x.front(), options.closed) : kNan;
    answer.rows.push_back({one.person,
                           {{"attempts", static_cast<double>(one.values.size())},
                            {"power", best->kind == CurveKind::power ? 1.0 : 0.0},
                            {"a", best->a},
                            {"b", best->b},
                            {"plateau", best->c},
                            {"learning", does ? 1.0 : 0.0}}});
    if (arrived < kFarAway) answer.rows.back().values.push_back({"plateau_reached_at", arrived});
  }
  answer.n = rates.size();
  if (rates.empty()) {
    Answer none = not_estimable(answer.test, "too_few", 0);
    none.missing = series.missing;
    none.notes.emplace_back("Nobody has five attempts at four different times, with values that vary.");
    return none;
  }
  answer.method = "least squares, of each person the better of power law and exponential; median over persons";
  answer.estimate = median_of(rates);
  answer.estimate_name = "median of the persons' learning rates b";
  answer.more = {{"persons_learning", static_cast<double>(learners)}};
  if (learners == 0) answer.notes.emplace_back("No learning detected.");
  if (rates.size() < series.persons.size())
    answer.notes.push_back(std::to_string(series.persons.size() - rates.size()) +
                           " persons have too few attempts, or values that do not vary, for a curve.");
  return settled(std::move(answer));
}

}  // namespace

std::optional<LearningCurve> better_curve(std::span<const double> t, std::span<const double> y) {
  const BothCurves curves{fit_curve(CurveKind::power, t, y), fit_curve(CurveKind::exponential, t, y)};
  const LearningCurve* best = curves.better();
  return best == nullptr ? std::nullopt : std::optional(*best);
}

double value_at(const LearningCurve& curve, double t) {
  return curve.a * (curve.kind == CurveKind::power ? std::pow(t, -curve.b) : std::exp(-curve.b * t)) + curve.c;
}

Answer learning_curve(const DataTable& table, const LearningCurveOptions& options) {
  const PersonsSeries series = persons_series(table);
  Answer answer;
  answer.test = "learning_curve";
  answer.n = series.persons.size();
  answer.missing = series.missing;
  if (series.persons.size() > 1) return of_several(std::move(answer), series, options);
  const char* reason = nullptr;
  if (series.values == 0) {
    reason = "no_data";
  } else if (series.values < kLeastAttempts) {
    reason = "too_few";
  } else {
    const Series& one = series.persons.front();
    const BothCurves curves = both(one);
    if (curves.better() != nullptr) {
      tell_one(answer, one, curves, options);
      return settled(std::move(answer));
    }
    const auto [low, high] = std::minmax_element(one.values.begin(), one.values.end());
    reason = *low == *high ? "no_variation" : "no_solution";
    answer.notes.emplace_back("A curve needs values that vary, and four different times that are not below 0.");
  }
  Answer none = not_estimable(answer.test, reason, answer.n);
  none.missing = answer.missing;
  none.notes = std::move(answer.notes);
  return none;
}

}  // namespace seldinger::assessment::statistics
