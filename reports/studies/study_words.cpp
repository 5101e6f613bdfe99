#include "reports/studies/study_words.h"

#include <cmath>
#include <cstdio>

#include "assessment/registry.h"
#include "assessment/statistics/reasons.h"

namespace seldinger::reports {
namespace {

namespace study = assessment::study;

std::string superscript(int exponent) {
  constexpr const char* kDigits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(exponent))) text += kDigits[digit - '0'];
  return text;
}

// Whether the first group does better, by the estimate; nothing: neither, or nobody knows.
std::optional<bool> first_is_better(const study::Compared& one) {
  if (!one.answer.estimate) return std::nullopt;
  const double middle = one.outcome.test == study::Test::brunner_munzel ? 0.5 : 0.0;
  const double off = *one.answer.estimate - middle;
  if (off == 0.0) return std::nullopt;
  return (off < 0.0) == (one.outcome.better == assessment::Direction::lower_is_better);
}

// How the interval lies to the smallest difference that is worth a word; of an effect in the metric's unit.
std::string worthwhile_text(const study::Compared& one, bool shown) {
  if (one.outcome.test == study::Test::brunner_munzel || !one.answer.ci95) return {};
  const double small = one.outcome.smallest_worthwhile;
  const assessment::statistics::Interval ci = *one.answer.ci95;
  if (ci.low > -small && ci.high < small) return " Any difference is smaller than the smallest worthwhile one.";
  if (!shown) return {};
  return ci.low >= small || ci.high <= -small ? " The difference is larger than the smallest worthwhile one."
                                              : " Whether it is large enough to be worthwhile remains open.";
}

}  // namespace

std::string digits_text(double value) {
  if (!std::isfinite(value)) return "–";
  if (value == 0.0) return "0";
  const double size = std::abs(value);
  char text[64];
  std::string made;
  if (size >= 1e-4 && size < 1e6) {
    const int whole = static_cast<int>(std::floor(std::log10(size))) + 1;
    std::snprintf(text, sizeof text, "%.*f", std::max(0, 3 - whole), size);
    made = text;
    if (made.find('.') != std::string::npos) {
      made.erase(made.find_last_not_of('0') + 1);
      if (made.back() == '.') made.pop_back();
    }
  } else {
    const int exponent = static_cast<int>(std::floor(std::log10(size)));
    std::snprintf(text, sizeof text, "%.3g", size / std::pow(10.0, exponent));
    made = std::string(text) + " × 10" + superscript(exponent);
  }
  return (value < 0.0 ? "−" : "") + made;
}

std::string p_text(const std::optional<double>& p) {
  if (!p) return "–";
  if (*p < 0.001) return "< 0.001";
  char text[32];
  std::snprintf(text, sizeof text, *p < 0.1 ? "%.3f" : "%.2f", *p);
  return text;
}

std::string interval_text(const std::optional<assessment::statistics::Interval>& interval) {
  if (!interval) return "no interval";
  return digits_text(interval->low) + " to " + digits_text(interval->high);
}

std::string of_text(std::size_t some, std::size_t all) {
  return std::to_string(some) + " of " + std::to_string(all);
}

std::optional<double> further(const assessment::statistics::Answer& answer, std::string_view beginning) {
  for (const assessment::statistics::Named& one : answer.more)
    if (one.name.starts_with(beginning)) return one.value;
  return std::nullopt;
}

std::string verdict_text(const study::Compared& one, double alpha) {
  if (!one.refused.empty()) return "Not analysed. " + one.refused;
  if (!one.answer.estimable()) {
    const auto* reason = assessment::statistics::find_reason(one.answer.reason.c_str());
    return std::string("Not estimable: ") + (reason == nullptr ? one.answer.reason : reason->words) + ".";
  }
  if (!one.p_adjusted) return "No test could be made.";
  const auto better = first_is_better(one);
  if (*one.p_adjusted > alpha || !better)
    return "No difference between " + one.outcome.first + " and " + one.outcome.second +
           " was shown. That is no evidence that there is none." + worthwhile_text(one, false);
  return (*better ? one.outcome.first : one.outcome.second) + " did better than " +
         (*better ? one.outcome.second : one.outcome.first) + "." + worthwhile_text(one, true);
}

std::string detectable_text(const study::Compared& one) {
  const auto value = further(one.answer, "detectable_");
  if (!value) return one.answer.estimable() && one.refused.empty() ? "none: too few" : "–";
  const assessment::MetricInfo* info = assessment::find_metric(one.outcome.metric);
  if (one.outcome.test == study::Test::welch)
    return digits_text(*value) + (info == nullptr ? std::string() : std::string(" ") + info->unit);
  return "P = " + digits_text(*value);
}

std::string test_text(study::Test test) {
  switch (test) {
    case study::Test::welch:
      return "Welch’s t-test";
    case study::Test::brunner_munzel:
      return "Brunner–Munzel test";
    case study::Test::mann_whitney:
      return "Mann–Whitney test";
  }
  return {};
}

std::string group_text(const study::GroupSum& sum, std::string_view unit) {
  std::string text = "n = " + std::to_string(sum.persons - sum.absent);
  if (sum.median)
    text += ", median " + digits_text(*sum.median) + " (" + digits_text(*sum.low_quartile) + " to " +
            digits_text(*sum.high_quartile) + ")" + (unit.empty() ? "" : " ") + std::string(unit);
  if (sum.failures + sum.censored > 0) text += ", " + std::to_string(sum.failures + sum.censored) + " failed";
  if (sum.absent > 0) text += ", " + std::to_string(sum.absent) + " absent";
  return text;
}

}  // namespace seldinger::reports
