#include "assessment/registry.h"

#include <cmath>

#include "assessment/metrics/tables.h"

namespace seldinger::assessment {
namespace {

std::vector<MetricInfo> all_metrics() {
  std::vector<MetricInfo> all;
  for (const auto& table :
       {endpoint_metrics(), approach_metrics(), puncture_metrics(), structure_metrics(), procedure_metrics(),
        breath_metrics(), force_metrics(), advance_metrics(), last_advance_metrics(), visibility_metrics(),
        path_metrics(), time_metrics(), fluoroscopy_metrics(), recording_metrics()})
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
  std::string text;
  for (const NeedInfo& need : needs())
    if ((info.needs & need.need) != 0) text += (text.empty() ? "" : ", ") + std::string(need.words);
  return text.empty() ? "–" : text;
}

}  // namespace

std::span<const MetricInfo> registry() {
  static const std::vector<MetricInfo> all = all_metrics();
  return all;
}

const MetricInfo* find_metric(const std::string& id) {
  for (const MetricInfo& info : registry())
    if (id == info.id) return &info;
  return nullptr;
}

std::vector<MetricValue> measure_all(const Signals& signals) {
  const std::uint32_t unmet = unmet_needs(signals);
  const auto measure = [&](const MetricInfo& info) {
    for (const NeedInfo& need : needs())
      if ((info.needs & unmet & need.need) != 0) return Measured::none(need.reason);
    const Measured measured = info.measure(signals);
    return measured.value && !std::isfinite(*measured.value) ? Measured::none("not_finite") : measured;
  };
  std::vector<MetricValue> values;
  for (const MetricInfo& info : registry()) {
    const Measured measured = measure(info);
    values.push_back({info.id, info.version, measured.value, info.unit, measured.reason});
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
      "Lengths in mm, coordinates in LPS. A metric that cannot be given is null with a reason, never 0. The way to "
      "the\n"
      "endpoint counts; time and distance in tracking gaps do not.\n\n"
      "| id | version | unit | better | needs | definition | source |\n|---|---|---|---|---|---|---|\n";
  for (const MetricInfo& info : registry())
    text += "| `" + std::string(info.id) + "` | " + std::to_string(info.version) + " | " + info.unit + " | " +
            words(info.direction) + " | " + needs_of(info) + " | " + info.definition + " | " + info.source + " |\n";
  text += "\nWhat a metric needs and does not find makes it null, for the first of these reasons:\n\n";
  text += "| needs | reason |\n|---|---|\n";
  for (const NeedInfo& need : needs()) text += "| " + std::string(need.words) + " | `" + need.reason + "` |\n";
  return text;
}

}  // namespace seldinger::assessment
