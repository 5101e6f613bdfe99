#include "assessment/signals/breath_holds.h"

#include <algorithm>

#include "assessment/signals/signals.h"

namespace seldinger::assessment {
namespace {

using cases::EventKind;

bool on_last_way(const Signals& signals, const glm::dvec3& rest_lps_mm) {
  bool marked = false;
  for (const cases::Structure& one : signals.setting.structures) {
    if (one.rule != cases::StructureRule::organ) continue;
    marked = true;
    if (!cases::stretches_inside(one.shape, rest_lps_mm, rest_lps_mm).empty()) return true;
  }
  return !marked && cases::signed_distance_mm(cases::shape_of(*signals.setting.target), rest_lps_mm,
                                              kLastWayMm + 1.0) <= kLastWayMm;
}

}  // namespace

std::vector<BreathHold> breath_holds(const Signals& signals) {
  const double end_s = signals.poses.back().t_s;
  std::vector<BreathHold> holds;
  double from_s = 0.0;
  bool held = false;
  const auto close = [&](double to_s, bool lost) {
    if (held && from_s < end_s) holds.push_back({from_s, std::min(to_s, end_s), lost && to_s <= end_s});
    held = false;
  };
  for (const cases::Event& one : *signals.events) {
    if (one.kind == EventKind::breath_held && !held) {
      held = true;
      from_s = one.t_s;
    }
    if (one.kind == EventKind::breath_lost || one.kind == EventKind::breathe_again)
      close(one.t_s, one.kind == EventKind::breath_lost);
  }
  close(end_s, false);
  return holds;
}

bool held_at(std::span<const BreathHold> holds, double t_s, double grace_s) {
  return std::any_of(holds.begin(), holds.end(), [&](const BreathHold& hold) {
    return t_s > hold.from_s + kTimeTolerance_s &&
           t_s <= hold.to_s + (hold.lost ? grace_s : 0.0) + kTimeTolerance_s;
  });
}

std::vector<double> pushed_on_last_way_mm(const Signals& signals) {
  std::vector<double> pushed(signals.poses.size(), 0.0);
  for (std::size_t i = 0; i < signals.poses.size(); ++i)
    if (signals.advance_mm[i] > 0.0 && on_last_way(signals, signals.poses[i].tip_at_rest_lps_mm()))
      pushed[i] = signals.advance_mm[i];
  return pushed;
}

}  // namespace seldinger::assessment
