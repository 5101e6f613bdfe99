#include "assessment/statistics/growth/mixed_model.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "assessment/statistics/distributions.h"
#include "assessment/statistics/growth/linear_mixed.h"
#include "assessment/statistics/growth/person_rows.h"
#include "assessment/statistics/growth/repeated_persons.h"
#include "assessment/statistics/spread.h"

namespace seldinger::assessment::statistics {
namespace {

constexpr const char* kMixed = "mixed_model";
constexpr std::size_t kOccasionsForSlope = 4;

Answer no_model(const PersonRows& rows, const char* reason, const char* why) {
  return no_repeated_persons(kMixed, rows, reason, why);
}

// What is no matter of the units of y and x comes back in them.
void add_variances(Answer& answer, const MixedFit& fit, const FixedEffects& fixed, double unit, bool slopes) {
  const double sd = fit.sigma * unit;
  const double level = fit.l11 * fit.l11, slope = fit.l21 * fit.l21 + fit.l22 * fit.l22, both = fit.l11 * fit.l21;
  const double shift = slopes ? fixed.centre / fixed.size : 0.0;  // from the centre of x back to 0
  const double at_zero = std::max(0.0, level - 2.0 * shift * both + shift * shift * slope);
  answer.more.push_back({"sd_intercept", sd * std::sqrt(at_zero)});
  if (slopes) {
    answer.more.push_back({"sd_slope", sd * std::sqrt(slope) / fixed.size});
    if (at_zero > 0.0 && slope > 0.0)
      answer.more.push_back(
          {"correlation", std::clamp((both - shift * slope) / std::sqrt(at_zero * slope), -1.0, 1.0)});
  }
  answer.more.push_back({"sd_residual", sd});
  if (!slopes) answer.more.push_back({"icc", level / (1.0 + level)});
}

void add_effects(Answer& answer, const MixedFit& fit, const FixedEffects& fixed, double unit, double mean) {
  for (std::size_t k = 0; k < fixed.names.size(); ++k) {
    const MixedFit::Contrast& one = fit.contrasts[k];
    const double value = unit * one.value + (k == 0 ? mean : 0.0), se = unit * one.se, t = value / se;
    const double reach = student_t_quantile(0.975, one.df) * se;
    answer.rows.push_back({fixed.names[k],
                           {{"estimate", value},
                            {"se", se},
                            {"df", one.df},
                            {"t", t},
                            {"p", 2.0 * student_t_upper(std::abs(t), one.df)},
                            {"low", value - reach},
                            {"high", value + reach}}});
  }
}

void bear_out(Answer& answer, const FixedEffects& fixed, const PersonRows& rows) {
  const std::size_t k = rows.x.empty() && rows.groups.size() != 2 ? 0 : 1;
  const std::vector<Named>& values = answer.rows[k].values;
  answer.estimate = values[0].value;
  answer.estimate_name = effect_name(fixed, rows, k);
  answer.df = {values[2].value};
  answer.statistic = values[3].value;
  answer.p_value = values[4].value;
  answer.ci95 = Interval{values[5].value, values[6].value};
}

bool wants_slopes(const PersonRows& rows, RandomEffects random) {
  if (rows.x.empty() || random == RandomEffects::intercept) return false;
  if (random == RandomEffects::slope) return true;
  return rows.occasions >= kOccasionsForSlope && rows.rows() > 2 * rows.persons;
}

}  // namespace

Answer mixed_model(const DataTable& table, const MixedModelOptions& options) {
  const PersonRows rows = person_rows(table);
  if (const auto no = unfit_for_model(kMixed, rows)) return *no;
  const bool slopes = wants_slopes(rows, options.random);
  if (rows.rows() <= rows.persons * (slopes ? 2 : 1))
    return no_model(rows, "too_few", "There must be more values than random effects.");
  const Spread spread = spread_of(rows.y);
  if (!spread.varies) return no_model(rows, "no_variation", "The values do not vary.");
  if (!spread.computable) return no_model(rows, "no_finite_answer", "The values are too large or vary too little.");
  const FixedEffects fixed = fixed_effects(rows, options.interaction);
  const double unit = std::sqrt(spread.variance);
  MixedRows standard;
  standard.fixed = fixed.columns;
  standard.persons = rows.persons;
  standard.person = rows.person;
  standard.x = fixed.matrix;
  for (const double y : rows.y) standard.y.push_back((y - spread.mean) / unit);
  if (slopes)
    for (const double x : rows.x) standard.slope.push_back((x - fixed.centre) / fixed.size);
  const auto fit = fit_mixed(standard, fixed.weights);
  if (!fit)
    return no_model(rows, "no_convergence",
                    "Effects cannot be separated (one follows from the others), or no residual variation is left.");
  Answer answer = of_repeated_persons(kMixed, rows);
  answer.method = std::string("linear mixed model by REML, random intercept ") + (slopes ? "and slope " : "") +
                  "per person, Satterthwaite's df";
  const double degrees = static_cast<double>(rows.rows()) - static_cast<double>(fixed.columns);
  answer.more = {{"values", static_cast<double>(rows.rows())},
                 {"reml_criterion", fit->criterion + 2.0 * degrees * std::log(unit) +
                                        2.0 * static_cast<double>(fixed.columns_with_x) * std::log(fixed.size)}};
  add_variances(answer, *fit, fixed, unit, slopes);
  add_effects(answer, *fit, fixed, unit, spread.mean);
  bear_out(answer, fixed, rows);
  if (fit->singular)
    answer.notes.emplace_back(
        "The fit is singular: a variance between persons is 0, or intercept and slope are fully correlated.");
  return settled(std::move(answer));
}

}  // namespace seldinger::assessment::statistics
