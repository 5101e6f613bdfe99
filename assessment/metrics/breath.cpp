// Metrics of a held breath, where the patient breathes: was it held when it mattered, and was it used.
#include <algorithm>

#include "assessment/metrics/tables.h"
#include "assessment/signals/breath_holds.h"
#include "assessment/signals/signals.h"

namespace seldinger::assessment {
namespace {

struct Pushed {
  double held_mm = 0.0, moving_mm = 0.0;
};
Pushed pushed(const Signals& signals) {
  const std::vector<BreathHold> holds = breath_holds(signals);
  const std::vector<double> pushed_mm = pushed_on_last_way_mm(signals);
  Pushed sum;
  for (std::size_t i = 0; i < pushed_mm.size(); ++i)
    if (pushed_mm[i] > 0.0) (held_at(holds, signals.poses[i].t_s) ? sum.held_mm : sum.moving_mm) += pushed_mm[i];
  return sum;
}

Measured advance_held_share(const Signals& signals) {
  const Pushed sum = pushed(signals);
  const double all_mm = sum.held_mm + sum.moving_mm;
  return all_mm >= kJiggleMm ? Measured::of(sum.held_mm / all_mm) : Measured::none("under_1_mm_of_advance");
}

Measured advance_in_breath(const Signals& signals) {
  return Measured::of(pushed(signals).moving_mm);
}

Measured fired_breath_held(const Signals& signals) {
  return Measured::of(held_at(breath_holds(signals), signals.endpoint->t_s) ? 1.0 : 0.0);
}

double held_s(const std::vector<BreathHold>& holds) {
  double sum_s = 0.0;
  for (const BreathHold& hold : holds) sum_s += hold.to_s - hold.from_s;
  return sum_s;
}

Measured breath_hold_time(const Signals& signals) {
  return Measured::of(held_s(breath_holds(signals)));
}

// Of each hold, from its begin to the last advance in it, or the trigger.
Measured breath_hold_used(const Signals& signals) {
  const std::vector<BreathHold> holds = breath_holds(signals);
  const double all_s = held_s(holds);
  if (!(all_s > 0.0)) return Measured::none("breath_never_held");
  double used_s = 0.0;
  for (const BreathHold& hold : holds) {
    double last_s = hold.from_s;
    for (std::size_t i = 0; i < signals.poses.size(); ++i)
      if (signals.advance_mm[i] > 0.0 && signals.poses[i].t_s > last_s && signals.poses[i].t_s <= hold.to_s)
        last_s = signals.poses[i].t_s;
    if (signals.endpoint && signals.endpoint->t_s > hold.from_s && signals.endpoint->t_s <= hold.to_s)
      last_s = signals.endpoint->t_s;
    used_s += last_s - hold.from_s;
  }
  return Measured::of(used_s / all_s);
}

Measured breath_holds_asked(const Signals& signals) {
  return Measured::of(static_cast<double>(
      std::count_if(signals.events->begin(), signals.events->end(), [&](const cases::Event& one) {
        return one.kind == cases::EventKind::breath_hold_request && one.t_s <= signals.poses.back().t_s;
      })));
}

Measured breath_holds_failed(const Signals& signals) {
  const std::vector<BreathHold> holds = breath_holds(signals);
  return Measured::of(static_cast<double>(
      std::count_if(holds.begin(), holds.end(), [](const BreathHold& hold) { return hold.lost; })));
}

constexpr Needs kHeld = kEvents | kBreathes;
constexpr const char* kInTheRoom =
    "1: judged by the room alone, so that a needle that moved with the tissue counted as pushed on.";
constexpr const char* kSource = "thesis, appendix A, steps 11 and 12; docs/clinical.md: check in breath-hold";

constexpr MetricInfo kBreathMetrics[] = {
    {"advance_breath_held_share", 2, "share", "Advance with breath held", Group::procedure,
     Direction::higher_is_better, kHeld | kSkin | kTarget | kMotion,
     "Share of the length by which the hand pushed the tip on inside the target's organ (where none is marked, at "
     "most 20 mm from the target's edge) while the breath was held; moving to and fro by under 1 mm is not an "
     "advance, nor is movement by breath. Null: under_1_mm_of_advance.",
     kSource, &advance_held_share, kMedianShare,
     kAnyPlace | kOneDarkFrame | kIdleBefore | kIdleAfter | kAtAnySpeed | kNothingIsNothing, kInTheRoom},
    {"advance_in_breath", 2, "mm", "Advance in moving breath", Group::procedure, Direction::lower_is_better,
     kHeld | kSkin | kTarget | kMotion,
     "The part of that length, as advance_breath_held_share counts it, that was covered while breath moved.",
     kSource, &advance_in_breath, kMedianRatio,
     kAnyPlace | kOneDarkFrame | kIdleBefore | kIdleAfter | kAtAnySpeed | kLostSamples, kInTheRoom},
    {"fired_breath_held", 1, "bool", "Fired with breath held", Group::procedure, Direction::higher_is_better,
     kHeld | kEndpoint, "1 or 0: whether the breath was held when the trigger was pressed.", kSource,
     &fired_breath_held, kProportionOrFailure,
     kAnyPlace | kOneDarkFrame | kIdleBefore | kIdleAfter | kAtAnySpeed | kLostSamples | kNothingIsNothing},
    {"breath_hold_time", 1, "s", "Breath held for", Group::procedure, Direction::none, kHeld,
     "Time up to the endpoint for which the patient held the breath: from when it stopped to when the hold was "
     "lost or released. Neither long nor short is better; if no hold is asked for it is 0.",
     kSource, &breath_hold_time, kMedianRatio, kAnyPlace | kOneDarkFrame | kIdleBefore | kLostSamples},
    {"breath_hold_used", 3, "share", "Held breath used", Group::procedure, Direction::higher_is_better,
     kHeld | kSkin,
     "Share of breath_hold_time that led to something: of each hold, from its start to the last advance in tissue "
     "during it, or to the trigger. Null: breath_never_held.",
     kSource, &breath_hold_used, kMedianShare, kAnyPlace | kOneDarkFrame | kIdleBefore | kNothingIsNothing,
     "1: an advance was how far the tip came in the tissue, by breath as well; 2: not the first 1 mm of a further "
     "puncture."},
    {"breath_holds_asked", 1, "count", "Breath holds asked for", Group::procedure, Direction::none, kHeld,
     "How often a held breath was asked for up to the endpoint.", kSource, &breath_holds_asked, kMeanCount,
     kAnyPlace | kOneDarkFrame | kIdleBefore | kIdleAfter | kAtAnySpeed | kLostSamples},
    {"breath_holds_failed", 1, "count", "Breath holds failed", Group::procedure, Direction::lower_is_better, kHeld,
     "How often, up to the endpoint, the patient lost a held breath: by holding it for too long, or by a cough.",
     kSource, &breath_holds_failed, kMeanCount,
     kAnyPlace | kOneDarkFrame | kIdleBefore | kIdleAfter | kAtAnySpeed | kLostSamples},
};

}  // namespace

std::span<const MetricInfo> breath_metrics() {
  return kBreathMetrics;
}

}  // namespace seldinger::assessment
