#include "assessment/statistics/groups/power.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "assessment/statistics/distributions.h"
#include "assessment/statistics/groups/samples.h"
#include "assessment/statistics/roots.h"

namespace seldinger::assessment::statistics {
namespace {

constexpr double kMostPersons = 1e7;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// Both sides: an effect may be found with the wrong sign.
double power_at(double noncentrality, double df, double alpha) {
  const double critical = student_t_quantile(1.0 - alpha / 2.0, df);
  return 1.0 - noncentral_t_cdf(critical, df, noncentrality) + noncentral_t_cdf(-critical, df, noncentrality);
}

// Standard errors of a normal test; what others need lies between half and a multiple of it.
double normal_errors(double power, double alpha) {
  return normal_quantile_of(1.0 - alpha / 2.0) + normal_quantile_of(power);
}

double errors_of(double n1, double n2) {
  return std::sqrt(1.0 / n1 + 1.0 / n2);
}

struct Plan {
  double n1 = 0.0, n2 = 0.0, d = 0.0, power = 0.0, alpha = kAlpha, p = 0.0, share = 0.5;
  bool has_n = false, has_d = false, has_power = false, has_p = false;
};

// Empty: `plan` holds what was typed; else what is wrong with it.
std::string read_plan(const ProcedureOptions& options, Plan& plan) {
  struct Field {
    const char* name;
    double low, high;
    double Plan::*into;
  };
  constexpr double kAbove = std::numeric_limits<double>::min();
  const Field fields[] = {{"n", 2, kMostPersons, &Plan::n1},     {"n1", 2, kMostPersons, &Plan::n1},
                          {"n2", 2, kMostPersons, &Plan::n2},    {"d", kAbove, 100, &Plan::d},
                          {"power", 0.01, 0.9999, &Plan::power}, {"alpha", 1e-6, 0.5, &Plan::alpha},
                          {"p", 0.501, 0.999, &Plan::p},         {"share", 0.01, 0.99, &Plan::share}};
  for (const Field& field : fields) {
    if (!options.has(field.name)) continue;
    const auto value = number_within(options, field.name, 0.0, field.low, field.high);
    if (!value)
      return std::string(field.name) + " must lie from " + in_words(field.low) + " to " + in_words(field.high) +
             ".";
    plan.*field.into = *value;
  }
  if (options.has("n") && (options.has("n1") || options.has("n2")))
    return "n is the n of both groups: do not give it with n1 or n2.";
  if (options.has("n1") != options.has("n2")) return "n1 and n2 go together.";
  if (options.has("n")) plan.n2 = plan.n1;
  plan.has_n = options.has("n") || options.has("n1");
  plan.has_d = options.has("d");
  plan.has_power = options.has("power");
  plan.has_p = options.has("p");
  if (plan.has_p && plan.has_d) return "p and d are two ways to state an effect: give one of them.";
  if (!(plan.alpha < plan.power) && plan.has_power) return "power must lie above alpha.";
  return {};
}

// What is asked is what was not given.
Answer by_noether(const Plan& plan, Answer answer) {
  answer.method = "Mann–Whitney test, two-sided; Noether's formula";
  if (plan.has_n == plan.has_power) return bad_option("power", "With p give n (or n1 and n2), or power.");
  if (plan.has_power) {
    answer.estimate = noether_total(plan.p, plan.share, plan.power, plan.alpha);
    answer.estimate_name = "persons of both groups together";
    answer.more = {{"p", plan.p}, {"power", plan.power}, {"alpha", plan.alpha}, {"share", plan.share}};
    return settled(std::move(answer));
  }
  const double total = plan.n1 + plan.n2, share = plan.n1 / total;
  const double errors = std::sqrt(12.0 * share * (1.0 - share) * total) * (plan.p - 0.5);
  answer.estimate = normal_cdf(errors - normal_quantile_of(1.0 - plan.alpha / 2.0));
  answer.estimate_name = "power";
  answer.more = {{"n1", plan.n1}, {"n2", plan.n2}, {"p", plan.p}, {"alpha", plan.alpha}};
  return settled(std::move(answer));
}

}  // namespace

double t_test_power(double n1, double n2, double d, double alpha) {
  return power_at(d / errors_of(n1, n2), n1 + n2 - 2.0, alpha);
}

double t_test_power_right(double n1, double n2, double d, double alpha) {
  const double df = n1 + n2 - 2.0;
  return 1.0 - noncentral_t_cdf(student_t_quantile(1.0 - alpha / 2.0, df), df, d / errors_of(n1, n2));
}

double t_test_n(double d, double power, double alpha) {
  const auto off = [&](double n) { return t_test_power(n, n, d, alpha) - power; };
  const double normal = 2.0 * std::pow(normal_errors(power, alpha) / d, 2.0);
  if (!(off(2.0) < 0.0)) return 2.0;  // fewer are no group
  return root_between(2.0, std::min(kMostPersons, 4.0 * normal + 20.0), off);
}

double t_test_detectable(double n1, double n2, double power, double alpha) {
  return detectable_errors(n1 + n2 - 2.0, power, alpha) * errors_of(n1, n2);
}

double detectable_errors(double df, double power, double alpha) {
  if (!(df >= 1.0)) return kNone;
  const double normal = normal_errors(power, alpha);
  const double critical = student_t_quantile(1.0 - alpha / 2.0, df);
  return root_between(0.5 * normal, 2.0 * (normal + critical),
                      [&](double errors) { return power_at(errors, df, alpha) - power; });
}

double noether_total(double p, double share_of_first, double power, double alpha) {
  const double errors = normal_errors(power, alpha), off = p - 0.5;
  return errors * errors / (12.0 * share_of_first * (1.0 - share_of_first) * off * off);
}

double detectable_probability(double error, double power, double alpha) {
  return 0.5 + normal_errors(power, alpha) * error;
}

double detectable_f(double groups, double total, double power, double alpha) {
  const double df1 = groups - 1.0, df2 = total - groups;
  if (!(df1 >= 1.0 && df2 >= 1.0)) return kNone;
  const double critical = f_quantile(1.0 - alpha, df1, df2);
  const auto off = [&](double lambda) { return 1.0 - noncentral_f_cdf(critical, df1, df2, lambda) - power; };
  return std::sqrt(root_between(0.5, 20.0 * (df1 * critical + 10.0), off) / total);
}

double detectable_noncentrality(double df, double power, double alpha) {
  const double critical = chi_squared_quantile_of(1.0 - alpha, df);
  const auto off = [&](double lambda) { return 1.0 - noncentral_chi_squared_cdf(critical, df, lambda) - power; };
  return root_between(0.5, 4.0 * (critical + 10.0), off);
}

void say_detectable(Answer& answer, const std::string& name, const std::string& effect, double value, double most) {
  if (!std::isfinite(value)) return;
  const bool not_significant = answer.p_value && !(*answer.p_value < kAlpha);
  if (value < most) answer.more.push_back({name, value});
  if (!not_significant) return;
  answer.notes.push_back(
      value < most
          ? "Not significant: " + effect + " of " + in_words(value) + " would have been found with 80 % power."
          : "Not significant: with so few, " + effect + " of no size would have been found with 80 % power.");
}

Answer power(const DataTable&, const ProcedureOptions& options) {
  Plan plan;
  if (const std::string wrong = read_plan(options, plan); !wrong.empty()) return bad_option("power", wrong);
  Answer answer;
  answer.test = "power";
  answer.method = "t-test of two groups, equal spreads, two-sided; non-central t";
  if (plan.has_p) return by_noether(plan, std::move(answer));
  if (plan.has_n + plan.has_d + plan.has_power != 2)
    return bad_option("power", "Give two of n (or n1 and n2), d and power; or p and one of n and power.");
  if (!plan.has_power) {
    plan.power = t_test_power(plan.n1, plan.n2, plan.d, plan.alpha);
    answer.estimate = plan.power;
    answer.estimate_name = "power";
  } else if (!plan.has_d) {
    plan.d = t_test_detectable(plan.n1, plan.n2, plan.power, plan.alpha);
    answer.estimate = plan.d;
    answer.estimate_name = "detectable difference of means in standard deviations";
  } else {
    plan.n1 = plan.n2 = t_test_n(plan.d, plan.power, plan.alpha);
    answer.estimate = plan.n1;
    answer.estimate_name = "persons in each group";
    answer.notes.emplace_back("Round up.");
  }
  answer.more = {{"n1", plan.n1}, {"n2", plan.n2}, {"d", plan.d}, {"power", plan.power}, {"alpha", plan.alpha}};
  answer.more.push_back({"power_right_side", t_test_power_right(plan.n1, plan.n2, plan.d, plan.alpha)});
  return settled(std::move(answer));
}

}  // namespace seldinger::assessment::statistics
