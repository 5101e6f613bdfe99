#include "app/population/agreement_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "assessment/statistics/distributions.h"
#include "sim/base/check.h"

namespace seldinger::app {
namespace {

namespace population = assessment::population;

constexpr double kErrors = 3.0;
constexpr std::size_t kWorstShown = 5;

double area_errors(const population::EffectAgreement& one) {
  return std::abs(one.area_drawn - one.area) / one.area_error;
}
double d_errors(const population::EffectAgreement& one) {
  return std::abs(one.d_drawn - one.d) / one.d_error;
}

template <typename... Numbers>
void add_line(std::string& text, const char* format, Numbers... numbers) {
  char line[512];
  std::snprintf(line, sizeof line, format, numbers...);
  text += line;
}

void add_levels(const std::vector<LevelAgreement>& levels, std::string& text) {
  text += "| |";
  for (const LevelAgreement& one : levels) text += " " + one.group + " |";
  text += "\n|---|";
  for (std::size_t i = 0; i < levels.size(); ++i) text += "---|";
  text += "\n";
  const auto row = [&](const char* what, const auto& cell) {
    text += std::string("| ") + what + " |";
    for (const LevelAgreement& one : levels) add_line(text, " %zu |", cell(one.agreement));
    text += "\n";
  };
  const auto error_row = [&](const char* what, const auto& cell) {
    text += std::string("| ") + what + " |";
    for (const LevelAgreement& one : levels) add_line(text, " %.3f |", cell(one.agreement));
    text += "\n";
  };
  using Level = const population::Agreement&;
  row("attempts it was not fitted to", [](Level one) { return one.attempts; });
  row("metrics", [](Level one) { return one.metrics.size(); });
  // Found, what a surrogate without fault would have beside it, and those beyond chance.
  const auto off_rows = [&](const char* what, std::size_t population::Off::*which) {
    row(what, [&](Level one) { return one.off.*which; });
    text += "| for a faultless surrogate: the median of " + std::to_string(population::Agreement::kFaultless) +
            " checks (at most) |";
    for (const LevelAgreement& one : levels)
      add_line(text, " %zu (%zu) |", one.agreement.off_without_fault.*which,
               one.agreement.most_off_without_fault.*which);
    text += "\n";
    row("found beyond 3 standard errors, too", [&](Level one) { return one.beyond_chance.*which; });
  };
  off_rows("metrics with a quantile (10, 50, 90 %) off by more than .1 SD", &population::Off::quantiles);
  error_row("root mean square error beyond chance, SD", [](Level one) { return one.quantile_own_sd; });
  off_rows("shares of nulls and zeros off by more than 3 points", &population::Off::shares);
  row("pairs of metrics", [](Level one) { return one.pairs; });
  off_rows("pairs with a rank correlation off by more than .1", &population::Off::pairs);
  error_row("root mean square error beyond chance", [](Level one) { return one.rank_correlation_own; });
}

void add_worst(const LevelAgreement& level, std::string& text) {
  const population::Agreement& one = level.agreement;
  std::vector<population::MetricAgreement> worst = one.metrics;
  std::sort(worst.begin(), worst.end(),
            [](const auto& a, const auto& b) { return std::abs(a.quantile_sd) > std::abs(b.quantile_sd); });
  worst.resize(std::min(worst.size(), kWorstShown));
  text += "\nFurthest off, " + level.group + ":";
  for (const population::MetricAgreement& metric : worst)
    add_line(text, " `%s` %+.2f SD (standard error %.2f; beyond the bound by %.1f),", metric.metric.c_str(),
             metric.quantile_sd, metric.quantile_error_sd, metric.quantile_errors);
  if (one.worst_pair.empty())
    text += " and no pair could be compared.\n";
  else
    add_line(text, " and the rank correlation of %s, by %.2f (%.2f).\n", one.worst_pair.c_str(),
             one.worst_rank_correlation, one.rank_correlation_error);
}

void add_effects(const GroupsAgreement& groups, std::string& text) {
  add_line(text, "\n%s minus %s: %zu of %zu metrics with an area or a d off by more than 3 standard errors.\n",
           groups.more.c_str(), groups.less.c_str(), effects_off(groups), groups.effects.size());
  if (groups.effects.empty()) return;
  const auto& paired = most_paired(groups);
  add_line(text, "People with the same number in both: the largest rank correlation is %+.2f (`%s`).\n",
           paired.pairs, paired.metric.c_str());
  text +=
      "\n| metric | area, whole | drawn | d, whole | drawn | furthest, in standard errors "
      "|\n|---|---|---|---|---|---|\n";
  for (const population::EffectAgreement& one : groups.effects)
    add_line(text, "| `%s` | %.3f ± %.3f | %.3f | %+.2f ± %.2f | %+.2f | %.1f |\n", one.metric.c_str(), one.area,
             one.area_error, one.area_drawn, one.d, one.d_error, one.d_drawn,
             std::max(area_errors(one), d_errors(one)));
}

}  // namespace

std::size_t effects_off(const GroupsAgreement& groups) {
  return static_cast<std::size_t>(
      std::count_if(groups.effects.begin(), groups.effects.end(), [](const population::EffectAgreement& one) {
        return !(area_errors(one) <= kErrors && d_errors(one) <= kErrors);
      }));
}

const population::EffectAgreement& most_paired(const GroupsAgreement& groups) {
  CHECK(!groups.effects.empty());
  return *std::max_element(groups.effects.begin(), groups.effects.end(),
                           [](const auto& a, const auto& b) { return std::abs(a.pairs) < std::abs(b.pairs); });
}

Verdict verdict_of(const SurrogateAgreement& agreement) {
  Verdict verdict;
  for (const LevelAgreement& one : agreement.levels) {
    verdict.comparisons += one.agreement.comparisons;
    verdict.furthest_errors = std::max(verdict.furthest_errors, one.agreement.furthest_errors);
  }
  for (const GroupsAgreement& groups : agreement.effects)
    for (const population::EffectAgreement& one : groups.effects) {
      verdict.comparisons += 2;
      verdict.furthest_errors = std::max({verdict.furthest_errors, area_errors(one), d_errors(one)});
    }
  constexpr double kFalseAlarms = 0.05;
  const auto m = static_cast<double>(std::max<std::size_t>(verdict.comparisons, 1));
  verdict.allowed_errors = assessment::statistics::normal_quantile_of(1.0 - kFalseAlarms / (2.0 * m));
  return verdict;
}

std::string text_of_agreement(const SurrogateAgreement& agreement) {
  std::string text =
      "Simulated, nothing here is about people: what the surrogate draws, beside fully simulated attempts.\n\n";
  add_levels(agreement.levels, text);
  for (const LevelAgreement& one : agreement.levels) add_worst(one, text);
  for (const GroupsAgreement& one : agreement.effects) add_effects(one, text);
  const Verdict verdict = verdict_of(agreement);
  add_line(text,
           "\nIn one check in twenty, chance alone puts the furthest of %zu comparisons %.1f standard errors or "
           "more beyond its bound (Bonferroni); here it is %.1f: ",
           verdict.comparisons, verdict.allowed_errors, verdict.furthest_errors);
  text += verdict.within_chance() ? "within chance.\n" : "the surrogate is off.\n";
  return text;
}

}  // namespace seldinger::app
