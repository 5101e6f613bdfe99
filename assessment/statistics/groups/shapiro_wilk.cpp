#include "assessment/statistics/groups/shapiro_wilk.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "assessment/statistics/distributions.h"
#include "assessment/statistics/groups/samples.h"
#include "assessment/statistics/reasons.h"
#include "assessment/statistics/spread.h"

namespace seldinger::assessment::statistics {
namespace {

// From the lowest power up.
template <std::size_t N>
double polynomial(const std::array<double, N>& coefficients, double x) {
  double value = 0.0;
  for (std::size_t i = N; i-- > 0;) value = value * x + coefficients[i];
  return value;
}

// Weights of the upper half, the largest value's first; the lower half's are their negatives. Normal scores at
// Blom's places, the outermost one or two replaced by Royston's polynomials in 1/√n, the rest scaled to a length
// of 1.
std::vector<double> weights(std::size_t n) {
  const std::size_t half = n / 2;
  if (n == 3) return {std::numbers::sqrt2 / 2.0};
  const double count = static_cast<double>(n);
  std::vector<double> scores(half);
  double squares = 0.0;
  for (std::size_t i = 0; i < half; ++i) {
    scores[i] = -normal_quantile_of((static_cast<double>(i) + 0.625) / (count + 0.25));
    squares += 2.0 * scores[i] * scores[i];
  }
  const double length = std::sqrt(squares), x = 1.0 / std::sqrt(count);
  constexpr std::array kFirst = {0.0, 0.221157, -0.147981, -2.071190, 4.434685, -2.706056};
  constexpr std::array kSecond = {0.0, 0.042981, -0.293762, -1.752461, 5.682633, -3.582633};
  std::vector<double> weight(half);
  weight[0] = scores[0] / length + polynomial(kFirst, x);
  std::size_t fixed = 1;
  double left = squares - 2.0 * scores[0] * scores[0], free = 1.0 - 2.0 * weight[0] * weight[0];
  if (n > 5) {
    weight[1] = scores[1] / length + polynomial(kSecond, x);
    left -= 2.0 * scores[1] * scores[1];
    free -= 2.0 * weight[1] * weight[1];
    fixed = 2;
  }
  const double scale = std::sqrt(left / free);
  for (std::size_t i = fixed; i < half; ++i) weight[i] = scores[i] / scale;
  return weight;
}

// Of 1 − W, which may be too small to be told from W.
double p_of(double w, double lack, std::size_t n) {
  if (n == 3) {
    // Exact; the least W of three values is ¾.
    const double p = 6.0 / std::numbers::pi * (std::asin(std::sqrt(w)) - std::asin(std::sqrt(0.75)));
    return std::clamp(p, 0.0, 1.0);
  }
  const double count = static_cast<double>(n);
  double y = std::log(lack), mean = 0.0, sd = 1.0;
  if (n <= 11) {
    const double limit = -2.273 + 0.459 * count;
    if (!(y < limit)) return 0.0;
    y = -std::log(limit - y);
    mean = polynomial(std::array{0.5440, -0.39978, 0.025054, -6.714e-4}, count);
    sd = std::exp(polynomial(std::array{1.3822, -0.77857, 0.062767, -0.0020322}, count));
  } else {
    const double log_n = std::log(count);
    mean = polynomial(std::array{-1.5861, -0.31082, -0.083751, 0.0038915}, log_n);
    sd = std::exp(polynomial(std::array{-0.4803, -0.082676, 0.0030302}, log_n));
  }
  return normal_upper((y - mean) / sd);
}

const char* why_not(const Group& group) {
  if (group.values.size() < 3) return "too_few";
  if (group.values.size() > 5000) return "too_many";
  const Spread spread = spread_of(group.values);
  if (!spread.varies) return "no_variation";
  return spread.computable ? nullptr : "no_finite_answer";
}

}  // namespace

ShapiroWilk shapiro_wilk(std::span<const double> values) {
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  const std::size_t n = sorted.size();
  const double range = sorted.back() - sorted.front();
  for (double& value : sorted) value /= range;
  double mean = 0.0;
  for (const double value : sorted) mean += value / static_cast<double>(n);
  const std::vector<double> weight = weights(n);
  double squares = 0.0, product = 0.0, weights_squared = 0.0;
  for (const double value : sorted) squares += (value - mean) * (value - mean);
  for (std::size_t i = 0; i < weight.size(); ++i) {
    product += weight[i] * (sorted[n - 1 - i] - sorted[i]);
    weights_squared += 2.0 * weight[i] * weight[i];
  }
  const double length = std::sqrt(squares * weights_squared);
  const double lack = std::max(0.0, (length - product) * (length + product) / (length * length));
  return {1.0 - lack, p_of(1.0 - lack, lack, n)};
}

Answer shapiro(const DataTable& table, const ProcedureOptions&) {
  GroupsAsked asked;
  asked.groups = independent_groups(table);
  asked.reason = asked.groups.n == 0 ? "no_data" : asked.groups.reason;
  if (asked.reason == nullptr && table.group.empty()) asked.reason = why_not(asked.groups.groups.front());
  if (asked.reason != nullptr) return asked.refused("shapiro");
  Answer answer = asked.answer("shapiro", "Shapiro–Wilk, Royston's AS R94");
  answer.notes.emplace_back(
      "Small samples hide departures and large ones show trifles: do not choose a test by it.");
  if (table.group.empty()) {
    const ShapiroWilk test = shapiro_wilk(asked.groups.groups.front().values);
    answer.groups.clear();
    answer.statistic = test.w;
    answer.p_value = test.p_value;
    return settled(std::move(answer));
  }
  const char* none = nullptr;
  for (const Group& group : asked.groups.groups) {
    if (const char* reason = why_not(group); reason != nullptr) {
      answer.notes.push_back(group.name + ": not computed, " + find_reason(reason)->words + ".");
      none = reason;
      continue;
    }
    const ShapiroWilk test = shapiro_wilk(group.values);
    answer.rows.push_back(
        {group.name, {{"n", static_cast<double>(group.values.size())}, {"w", test.w}, {"p", test.p_value}}});
  }
  if (answer.rows.empty()) {
    asked.reason = none;
    return asked.refused("shapiro");
  }
  return settled(std::move(answer));
}

}  // namespace seldinger::assessment::statistics
