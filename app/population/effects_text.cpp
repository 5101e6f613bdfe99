#include "app/population/effects_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <span>

#include "assessment/population/raters.h"
#include "assessment/population/reference_effects.h"
#include "assessment/statistics/ranks.h"

namespace seldinger::app {
namespace {

namespace population = assessment::population;
using population::EffectKind;
using population::ReferenceEffect;

double mean_of(const std::vector<double>& x) {
  return std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
}

double squares_of(const std::vector<double>& x) {
  const double mean = mean_of(x);
  return std::accumulate(x.begin(), x.end(), 0.0,
                         [&](double sum, double one) { return sum + (one - mean) * (one - mean); });
}

SimulatedEffect effect_of(const std::string& metric, const std::vector<double>& less,
                          const std::vector<double>& more) {
  SimulatedEffect made{.metric = metric, .values = less.size() + more.size()};
  if (less.size() < 2 || more.size() < 2) return made;
  const double pooled = std::sqrt((squares_of(less) + squares_of(more)) / static_cast<double>(made.values - 2));
  if (!(pooled > 0.0)) return made;
  made.difference = (mean_of(more) - mean_of(less)) / pooled;
  std::vector<double> all = more;
  all.insert(all.end(), less.begin(), less.end());
  const auto ranks = assessment::statistics::midranks(all);
  const auto n = static_cast<double>(more.size());
  const double sum = std::accumulate(ranks.begin(), ranks.begin() + static_cast<std::ptrdiff_t>(more.size()), 0.0);
  made.area = (sum - n * (n + 1.0) / 2.0) / (n * static_cast<double>(less.size()));
  return made;
}

// What a study of so many people would find of these metrics: the share that is significant, and how large those
// look.
struct Found {
  double share = 0.0, mean_size = 0.0;
};
Found found_by(const SimulatedEffects& effects, const ReferenceEffect& row) {
  double power = 0.0, size = 0.0, metrics = 0.0;
  for (const SimulatedEffect& one : row.of_two ? effects.of_two : effects.metrics) {
    if (!one.difference) continue;
    const auto selected = population::selected_of(*one.difference, row.n1, row.n2);
    power += selected.power;
    size += selected.power * selected.mean_size;
    metrics += 1.0;
  }
  return metrics > 0.0 ? Found{power / metrics, size / power} : Found{};
}

}  // namespace

std::optional<double> predicted(const SimulatedEffects& effects, const ReferenceEffect& row) {
  if (row.kind == EffectKind::discriminating) return found_by(effects, row).share;
  if (row.kind == EffectKind::difference && row.selected) return found_by(effects, row).mean_size;
  const auto of = std::find_if(effects.metrics.begin(), effects.metrics.end(),
                               [&](const SimulatedEffect& one) { return one.metric == row.metric; });
  if (of != effects.metrics.end() && row.kind == EffectKind::level) return of->novices;
  if (of != effects.metrics.end() && of->novices && of->practised && *of->novices != 0.0)
    return *of->practised / *of->novices;
  if (row.statement >= 0) return effects.answers.at(static_cast<std::size_t>(row.statement)).difference;
  return std::nullopt;
}

std::optional<bool> is_within(const SimulatedEffects& effects, const ReferenceEffect& row) {
  constexpr double kMayBeOff = 0.15;
  const auto value = predicted(effects, row);
  if (!value) return std::nullopt;
  const auto interval = population::interval95(row);
  return std::abs(*value - row.value) <= kMayBeOff ||
         (interval && interval->low <= *value && *value <= interval->high);
}

const char* kind_text(EffectKind kind) {
  switch (kind) {
    case EffectKind::difference:
      return "d";
    case EffectKind::discriminating:
      return "share that discriminates";
    case EffectKind::ratio:
      return "ratio";
    case EffectKind::level:
      return "level";
  }
  return "";
}

SimulatedEffects simulated_effects(const population::Surrogate& surrogate, std::size_t people, std::uint64_t seed) {
  SimulatedEffects made{surrogate.mark().case_title, people, 0.0, {}, {}, {}};
  const std::size_t metrics = surrogate.mark().metrics.size();
  const std::size_t asked = population::statements().size();
  std::vector<std::vector<double>> less(metrics), more(metrics), less_of_two(metrics), more_of_two(metrics);
  std::vector<std::vector<double>> trainees(asked), experts(asked), practised(metrics);
  const std::vector<double> all_before(kPractised);  // on day 0
  for (const bool expert : {false, true}) {
    const auto group = *population::named_group(expert ? "expert" : "novice");
    for (std::size_t number = 1; number <= people; ++number) {
      const population::Person person = population::drawn_person(group, seed, number);
      const auto values = surrogate.draw(person, {1, 0, 0.0});
      const auto after = [&](std::size_t others) {
        const auto before = std::span(all_before).first(others);
        return surrogate.draw(person, {1, others, population::gain_of(person.practice, before, 0.0)});
      };
      const auto next = after(1), last = after(kPractised);
      if (!expert)
        made.practice_gain += population::gain_of(person.practice, all_before, 0.0) / static_cast<double>(people);
      for (std::size_t s = 0; s < asked; ++s)
        (expert ? experts : trainees)[s].push_back(population::answer_of(person, s));
      for (std::size_t m = 0; m < metrics; ++m) {
        if (!expert && last[m]) practised[m].push_back(*last[m]);
        if (!values[m]) continue;
        (expert ? more : less)[m].push_back(*values[m]);
        if (next[m]) (expert ? more_of_two : less_of_two)[m].push_back((*values[m] + *next[m]) / 2.0);
      }
    }
  }
  for (std::size_t m = 0; m < metrics; ++m) {
    if (less[m].size() + more[m].size() == 0) continue;
    made.metrics.push_back(effect_of(surrogate.mark().metrics[m].id, less[m], more[m]));
    if (!less[m].empty()) made.metrics.back().novices = mean_of(less[m]);
    if (!practised[m].empty()) made.metrics.back().practised = mean_of(practised[m]);
    if (!more[m].empty()) made.metrics.back().experts = mean_of(more[m]);
    made.of_two.push_back(effect_of(surrogate.mark().metrics[m].id, less_of_two[m], more_of_two[m]));
  }
  for (std::size_t s = 0; s < asked; ++s)
    made.answers.push_back(effect_of(std::string(population::statements()[s].words), trainees[s], experts[s]));
  return made;
}

namespace {

std::string number_text(const std::optional<double>& value) {
  if (!value) return "–";
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", *value);
  return text;
}

// What makes the rows that are of practice and of levels: how far practice leads, beside how far experts are.
void add_practice(const SimulatedEffects& effects, std::string& text) {
  char line[512];
  std::snprintf(line, sizeof line,
                "\n%zu attempts on one day add %.2f standard deviations to every ability, in the mean of novices; "
                "experts are 1.2 ahead of them. Means:\n\n"
                "| metric | novices' first | after %zu others | experts' first | experts to novices |\n"
                "|---|---|---|---|---|\n",
                kPractised, effects.practice_gain, kPractised);
  text += line;
  const auto is_asked = [](const SimulatedEffect& one) {
    for (const ReferenceEffect& row : population::reference_effects())
      if (row.metric == one.metric) return true;
    return one.metric == "hit" || one.metric == "withdrawals_partial" || one.metric == "withdrawals_full";
  };
  for (const SimulatedEffect& one : effects.metrics)
    if (is_asked(one))
      text +=
          "| `" + one.metric + "` | " + number_text(one.novices) + " | " + number_text(one.practised) + " | " +
          number_text(one.experts) + " | " +
          number_text(one.novices && one.experts && *one.novices != 0.0 ? std::optional(*one.experts / *one.novices)
                                                                        : std::nullopt) +
          " |\n";
}

// How often studies of those sizes find a difference of .8.
void add_power(std::string& text) {
  text += "\nA true d of 0.8 becomes significant in";
  bool first = true;
  for (const ReferenceEffect& row : population::reference_effects()) {
    if (row.kind != EffectKind::discriminating) continue;
    char line[128];
    std::snprintf(line, sizeof line, "%s %.0f %% of studies of %zu and %zu people", first ? "" : " and in",
                  100.0 * population::selected_of(0.8, row.n1, row.n2).power, row.n1, row.n2);
    text += line;
    first = false;
  }
  text += ".\n";
}

}  // namespace

std::string text_of_effects(const SimulatedEffects& effects) {
  char line[512];
  std::snprintf(
      line, sizeof line,
      "Simulated, nothing here is about people: %zu novices and %zu experts at `%s`, experts minus novices.\n\n",
      effects.people, effects.people, effects.case_title.c_str());
  std::string text = line;
  text += "| metric | values | d | area under the ROC curve |\n|---|---|---|---|\n";
  for (const SimulatedEffect& one : effects.metrics) {
    if (!one.difference || !one.area) continue;
    std::snprintf(line, sizeof line, "| `%s` | %zu | %+.2f | %.2f |\n", one.metric.c_str(), one.values,
                  *one.difference, *one.area);
    text += line;
  }
  text +=
      "\n| published | of | what | value | standard error | 95 % | people | simulated | within .15 or the interval "
      "| "
      "|\n|---|---|---|---|---|---|---|---|---|---|\n";
  for (const ReferenceEffect& row : population::reference_effects()) {
    char error[32] = "not reported", bounds[48] = "", people[32] = "not reported", simulated[32] = "not simulated";
    if (const auto known = population::standard_error(row)) std::snprintf(error, sizeof error, "%.2f", *known);
    if (const auto interval = population::interval95(row))
      std::snprintf(bounds, sizeof bounds, "%.2f to %.2f", interval->low, interval->high);
    if (row.n2 > 0)
      std::snprintf(people, sizeof people, "%zu and %zu", row.n1, row.n2);
    else if (row.n1 > 0)
      std::snprintf(people, sizeof people, "%zu", row.n1);
    if (const auto value = predicted(effects, row)) std::snprintf(simulated, sizeof simulated, "%.2f", *value);
    const auto within = is_within(effects, row);
    std::snprintf(line, sizeof line, "| %s | %s | %s | %.2f | %s | %s | %s | %s | %s | %s%s |\n", row.source.data(),
                  row.what.data(), kind_text(row.kind), row.value, error, bounds, people, simulated,
                  !within   ? ""
                  : *within ? "yes"
                            : "**no**",
                  row.selected ? "reported because significant; " : "", row.fitted ? "fitted" : "not fitted");
    text += line;
  }
  add_practice(effects, text);
  add_power(text);
  return text;
}

}  // namespace seldinger::app
