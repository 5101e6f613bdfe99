#include "assessment/registry.h"

#include <bit>
#include <cmath>
#include <iterator>
#include <string_view>
#include <utility>

#include "assessment/metrics/tables.h"
#include "assessment/signals/need_words.h"

namespace seldinger::assessment {
namespace {

std::vector<MetricInfo> all_metrics() {
  std::vector<MetricInfo> all;
  for (const auto& table : {endpoint_metrics(), approach_metrics(), puncture_metrics(), structure_metrics(),
                            procedure_metrics(), breath_metrics(), force_metrics(), advance_metrics(),
                            probe_metrics(), last_advance_metrics(), visibility_metrics(), path_metrics(),
                            time_metrics(), fluoroscopy_metrics(), recording_metrics(), way_metrics()})
    all.insert(all.end(), table.begin(), table.end());
  return all;
}

const char* words(Direction direction) {
  switch (direction) {
    case Direction::lower_is_better:
      return "lower";
    case Direction::higher_is_better:
      return "higher";
    case Direction::none:
      break;
  }
  return "–";
}

std::string needs_of(const MetricInfo& info) {
  const std::string text = words_of_needs(info.needs);
  return text.empty() ? "–" : text;
}

constexpr std::pair<Law, const char*> kLaws[] = {
    {kAtAnySpeed, "the same path in half to twice the time"},
    {kInAnyFrame, "case and attempt, turned and shifted"},
    {kMirrored, "left for right"},
    {kInAnyBreath, "breath on or off, the hands at rest relative to tissue"},
    {kIdleBefore, "seconds in which nothing is done, before"},
    {kIdleAfter, "the same after the last action, where nothing was fired"},
    {kOneDarkFrame, "one picture that shows nothing"},
    {kLostSamples, "one pose in a hundred missing"},
    {kNothingIsNothing, "(an attempt in which nothing is done has no value)"}};

// "1 2 5": the laws that hold, by their place in the table.
std::string laws_of(const MetricInfo& info) {
  std::string text;
  for (std::size_t i = 0; i < std::size(kLaws); ++i)
    if ((info.laws & kLaws[i].first) != 0) text += (text.empty() ? "" : " ") + std::to_string(i + 1);
  return text.empty() ? "–" : text;
}

std::string estimands_markdown() {
  std::string text =
      "\n## What is estimated\n\nOne value per person (from the attempts on one task, by the column \"of a "
      "person's\"), and only from attempts in which\nthe procedure was performed (`procedure_performed`). An "
      "attempt without an endpoint, neither fired nor deferred, counts\nas follows: not at all where the metric is "
      "left out; as the worst value there is where it is a failure; where it is\ncensored, as a time that was "
      "still running, longer than any that ended. What was never reached is also a failure\n(`never_punctured`, "
      "`not_in_target_structure`, `not_in_tissue_at_the_end`). Somebody who defers without a puncture counts\nonly "
      "in the metrics of deciding, steps and pain; but a deferral that `decision_right` calls wrong is a failure "
      "or censored,\nlike giving up. Where a case does not say what is right, a deferral is not held against the "
      "person: proportions of such a\ncase are of those who went ahead. \"Unchanged by\" names laws of the table "
      "below.\n\n| id | scale | better | without an endpoint | of a person's | unchanged by "
      "|\n|---|---|---|---|---|---|\n";
  for (const MetricInfo& info : registry())
    text += "| `" + std::string(info.id) + "` | " + std::string(words(info.estimand.scale)) + " | " +
            words(info.direction) + " | " + std::string(words(info.estimand.without_endpoint)) + " | " +
            std::string(words(info.estimand.aggregation)) + " | " + laws_of(info) + " |\n";
  text += "\n| law | a metric that names it does not change under |\n|---|---|\n";
  for (std::size_t i = 0; i < std::size(kLaws); ++i)
    text += "| " + std::to_string(i + 1) + " | " + kLaws[i].second + " |\n";
  return text;
}

std::string history_markdown() {
  std::string text =
      "\n## Older versions\n\nValues stored by an older version stay as they are; `seldinger recompute` adds the "
      "newest beside them. What the older\nones did otherwise:\n\n| id | version now | before |\n|---|---|---|\n";
  for (const MetricInfo& info : registry())
    if (*info.history != '\0')
      text += "| `" + std::string(info.id) + "` | " + std::to_string(info.version) + " | " + info.history + " |\n";
  return text;
}

}  // namespace

std::string_view words(Scale scale) noexcept {
  constexpr std::string_view kWords[] = {"ratio", "interval", "share", "count", "yes or no"};
  return kWords[static_cast<std::size_t>(scale)];
}

std::string_view words(WithoutEndpoint without) noexcept {
  constexpr std::string_view kWords[] = {"left out", "failure", "censored"};
  return kWords[static_cast<std::size_t>(without)];
}

std::string_view words(Aggregation aggregation) noexcept {
  constexpr std::string_view kWords[] = {"median", "mean", "proportion"};
  return kWords[static_cast<std::size_t>(aggregation)];
}

std::span<const MetricInfo> registry() {
  static const std::vector<MetricInfo> all = all_metrics();
  return all;
}

const MetricInfo* find_metric(const std::string& id) {
  for (const MetricInfo& info : registry())
    if (id == info.id) return &info;
  return nullptr;
}

int version_of(const MetricInfo& info, cases::SightLaw law) noexcept {
  return info.version - std::popcount(info.by_sight >> (static_cast<unsigned>(law) + 1U));
}

std::vector<MetricValue> measure_all(const Signals& signals) {
  const Needs unmet = unmet_needs(signals);
  const auto measure = [&](const MetricInfo& info) {
    for (const NeedInfo& need : needs())
      if ((info.needs & unmet & need.need) != 0) return Measured::none(need.reason);
    const Measured measured = info.measure(signals);
    return measured.value && !std::isfinite(*measured.value) ? Measured::none("not_finite") : measured;
  };
  std::vector<MetricValue> values;
  for (const MetricInfo& info : registry()) {
    const Measured measured = measure(info);
    values.push_back(
        {info.id, version_of(info, signals.setting.sight_law), measured.value, info.unit, measured.reason});
  }
  return values;
}

bool applies(const MetricValue& metric, const Manner& manner) {
  const MetricInfo* info = find_metric(metric.id);
  return info == nullptr || applies(info->needs, manner);
}

std::string metrics_markdown() {
  std::string text =
      "# Metrics\n\nMade from the tables in `assessment/metrics/` by `seldinger help --metrics`; a test compares.\n"
      "Lengths in mm, coordinates in LPS. A metric that cannot be given is null with a reason, never 0. The path "
      "to "
      "the\n"
      "endpoint counts; time and distance in tracking gaps do not.\n\n"
      "| id | version | unit | better | needs | definition | source |\n|---|---|---|---|---|---|---|\n";
  for (const MetricInfo& info : registry())
    text += "| `" + std::string(info.id) + "` | " + std::to_string(info.version) + " | " + info.unit + " | " +
            words(info.direction) + " | " + needs_of(info) + " | " + info.definition + " | " + info.source + " |\n";
  text += "\nA metric that lacks something it needs is null, for the first of these reasons:\n\n";
  text += "| needs | reason |\n|---|---|\n";
  for (const NeedInfo& need : needs()) text += "| " + std::string(need.words) + " | `" + need.reason + "` |\n";
  return text + estimands_markdown() + history_markdown();
}

}  // namespace seldinger::assessment
