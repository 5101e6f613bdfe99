#include "casedb/attempts/conditions.h"

#include <algorithm>
#include <vector>

#include "casedb/attempts/condition_table.h"

namespace seldinger::casedb {
namespace {

// What leads the needle is noted first thing, or once an arm has had time to answer (app/window/hands).
constexpr double kNotedFromS = 1.0;

}  // namespace

void add_recorded(const cases::Recording& recording, Conditions& conditions) {
  if (!recording.events) return;
  const std::vector<cases::Event>& events = *recording.events;
  int changes = 0, pauses = 0;
  double noted_from_s = 0.0;
  double paused_s = 0.0;
  std::optional<cases::HandKind> needle, probe, needle_first, probe_first;
  for (const cases::Event& event : events) {
    if (event.kind == cases::EventKind::paused) {
      ++pauses;
      paused_s += event.wall_s;
    }
    const auto by = cases::led_by(event.kind);
    if (!by) continue;
    const bool of_needle = by->tool == cases::LedTool::needle;
    auto& hand = of_needle ? needle : probe;
    auto& first = of_needle ? needle_first : probe_first;
    if (hand && *hand != by->hand) ++changes;
    if (!first) first = by->hand;
    if (of_needle && !needle) noted_from_s = event.t_s;
    hand = by->hand;
  }
  // By a recorder that noted nothing of the kind, or only what a later program went on with.
  if (!needle_first || noted_from_s > kNotedFromS) return;
  conditions.needle_hand = needle_first;
  conditions.probe_hand = probe_first;
  conditions.hand_changes = changes;
  conditions.pauses = pauses;
  conditions.paused_s = paused_s;
  const double length_s = static_cast<double>(recording.inputs.size()) * recording.dt_s;
  double guided_s = 0.0;
  const std::vector<cases::EventSpan> guided = cases::guided_times(events);
  for (const cases::EventSpan& span : guided)
    guided_s += std::max(0.0, std::min(span.to_s, length_s) - std::min(span.from_s, length_s));
  conditions.guide_used = !guided.empty();
  if (length_s > 0.0) conditions.guide_share = guided_s / length_s;
}

std::optional<assessment::PlannedPath> planned_path(const Conditions& conditions) {
  const auto place = [](const LpsPlace& from) -> std::optional<glm::dvec3> {
    if (!from.x_mm || !from.y_mm || !from.z_mm) return std::nullopt;
    return glm::dvec3(*from.x_mm, *from.y_mm, *from.z_mm);
  };
  const auto entry = place(conditions.planned_entry), tip = place(conditions.planned_tip);
  if (!entry || !tip || !(glm::distance(*entry, *tip) > 0.0)) return std::nullopt;
  return assessment::PlannedPath{*entry, *tip};
}

void put_planned_path(const std::optional<assessment::PlannedPath>& path, Conditions& conditions) {
  const auto place = [](const glm::dvec3& at) { return LpsPlace{at.x, at.y, at.z}; };
  conditions.planned_entry = path ? place(path->entry_lps_mm) : LpsPlace{};
  conditions.planned_tip = path ? place(path->tip_lps_mm) : LpsPlace{};
}

Conditions simulated_conditions() {
  Conditions known;
  known.needle_hand = known.probe_hand = cases::HandKind::simulated;
  known.hand_changes = known.pauses = 0;
  known.guide_used = known.begun_again = false;
  known.guide_share = known.paused_s = 0.0;
  return known;
}

Conditions joined(const Conditions& older, const Conditions& newer) {
  Conditions both = older;
  for (const ConditionRow& row : condition_rows())
    if (const ConditionValue value = row.read(newer); !std::holds_alternative<std::monostate>(value))
      row.write(both, value);
  return both;
}

}  // namespace seldinger::casedb
