// Metrics of the moment the trigger fell.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "assessment/metrics/tables.h"
#include "assessment/signals/signals.h"

namespace seldinger::assessment {
namespace {

constexpr double kFarMm = 500.0;    // no needle is farther from its target
constexpr double kMinCoreMm = 5.0;  // of a core in the target, for a hit: our judgement

bool core(const Signals& signals) {
  return signals.setting.instrument.kind == cases::InstrumentKind::core;
}

// The sample notch after the throw: from start, along the needle, notch_mm long.
glm::dvec3 notch_start(const Signals& signals) {
  const cases::Instrument& needle = signals.setting.instrument;
  return signals.endpoint->tip_at_rest_lps_mm() +
         signals.endpoint->direction * (needle.throw_mm - needle.dead_tip_mm - needle.notch_mm);
}

// Length of start + s·direction, 0 ≤ s ≤ length, inside the target.
double length_in(const cases::Lesion& target, const glm::dvec3& start, const glm::dvec3& direction,
                 double length_mm) {
  double inside_mm = 0.0;
  for (const cases::Stretch& part :
       cases::stretches_inside(cases::shape_of(target), start, start + direction * length_mm))
    inside_mm += (part.to - part.from) * length_mm;
  return inside_mm;
}

// The point that counts, to the target's centre: the tip, or the middle of a core needle's notch
// (docs/clinical.md).
glm::dvec3 to_target(const Signals& signals) {
  glm::dvec3 point = signals.endpoint->tip_at_rest_lps_mm();
  if (core(signals))
    point = notch_start(signals) + signals.endpoint->direction * (signals.setting.instrument.notch_mm / 2);
  return signals.setting.target->center_lps_mm - point;
}

// From that point to the target's surface, negative inside.
double to_surface_mm(const Signals& signals) {
  const cases::Lesion& target = *signals.setting.target;
  // A plain sphere's distance has no limit to be told.
  if (!target.shape) return glm::length(to_target(signals)) - target.radius_mm;
  return cases::signed_distance_mm(*target.shape, target.center_lps_mm - to_target(signals), kFarMm);
}

Measured core_in_target(const Signals& signals) {
  return Measured::of(length_in(*signals.setting.target, notch_start(signals), signals.endpoint->direction,
                                signals.setting.instrument.notch_mm));
}

Measured hit(const Signals& signals) {
  return Measured::of(target_hit(signals) ? 1.0 : 0.0);
}

Measured first_pass_success(const Signals& signals) {
  const PunctureCounts counts = count_punctures(signals);
  if (counts.punctures == 0) return Measured::none("never_punctured");
  const bool one_pass = counts.punctures == 1 && counts.partial_withdrawals == 0;
  return Measured::of(one_pass && target_hit(signals) ? 1.0 : 0.0);
}

Measured tip_target_dist(const Signals& signals) {
  return Measured::of(glm::length(to_target(signals)));
}

Measured tip_target_surface(const Signals& signals) {
  return Measured::of(to_surface_mm(signals));
}

Measured tip_target_axial(const Signals& signals) {
  return Measured::of(glm::dot(to_target(signals), signals.endpoint->direction));
}

Measured tip_target_lateral(const Signals& signals) {
  return Measured::of(glm::length(glm::cross(to_target(signals), signals.endpoint->direction)));
}

constexpr MetricInfo kEndpointMetrics[] = {
    {"hit", 3, "bool", "Target hit", Group::target, Direction::higher_is_better, kEndpoint | kTarget,
     "1 or 0. At the endpoint (trigger): access needle, the tip is inside the target, or, where a structure is the "
     "lumen to be reached, inside that lumen; core needle, at least 5 mm of the fired notch lies inside the "
     "target. Passing through it earlier is not a hit, nor is reaching it other than through the skin.",
     kVidal, &hit, kProportionOrFailure, kOfTheWay | kNothingIsNothing,
     "1: an access needle hit the target lesion alone, also where a structure is the lumen to be reached; 2: also "
     "with a needle that had not come through skin, as cases from before decision 0057 still have it.",
     kAsksForHit},
    {"first_pass_success", 4, "bool", "First pass hit", Group::target, Direction::higher_is_better,
     kEndpoint | kTarget | kSkin | kMotion,
     "1 where the target was hit with one skin puncture and no partial withdrawal, else 0. Null: never_punctured.",
     "first-pass completion as in a phantom study of needle guidance, PMC5318157", &first_pass_success,
     kProportionOrFailure, kOfTheWay | kNothingIsNothing,
     "1: as hit 1 and withdrawals_partial 1 had it; 2: as withdrawals_partial 2 had it; 3: as hit 2 had it.",
     kAsksForHit},
    {"core_in_target", 1, "mm", "Core in target", Group::target, Direction::higher_is_better,
     kCoreNeedle | kEndpoint | kTarget, "Length of the fired notch inside the target.", kJohnson, &core_in_target,
     kMedianRatioOrFailure, kOfTheWay | kNothingIsNothing},
    {"tip_target_dist", 1, "mm", "Distance to target centre", Group::target, Direction::lower_is_better,
     kEndpoint | kTarget,
     "At the endpoint, from the tip (core needle: the middle of the fired notch) to the target's centre; never the "
     "closest approach.",
     kVidal, &tip_target_dist, kMedianRatioOrFailure, kOfTheWay | kNothingIsNothing},
    {"tip_target_surface", 1, "mm", "Distance to target surface", Group::target, Direction::lower_is_better,
     kEndpoint | kTarget, "As tip_target_dist, to the target's surface; negative inside.", kVidal,
     &tip_target_surface, kMedianIntervalOrFailure, kOfTheWay | kNothingIsNothing},
    {"tip_target_axial", 1, "mm", "Depth error", Group::target, Direction::none, kEndpoint | kTarget,
     "The part of tip_target_dist along the needle; positive when the needle stopped short.", kJohnson,
     &tip_target_axial, kMedianInterval, kOfTheWay | kNothingIsNothing},
    {"tip_target_lateral", 1, "mm", "Beside target", Group::target, Direction::lower_is_better, kEndpoint | kTarget,
     "The part of tip_target_dist across the needle.", kJohnson, &tip_target_lateral, kMedianRatioOrFailure,
     kOfTheWay | kNothingIsNothing},
};

}  // namespace

bool target_hit(const Signals& signals) {
  const bool asks_for_skin = signals.setting.sight_law != cases::SightLaw::half_slice;  // as cases of before do not
  if (asks_for_skin && !signals.setting.skin->empty() && !signals.passages.back().in_body) return false;
  if (core(signals)) return *core_in_target(signals).value >= kMinCoreMm;
  // A lumen to be reached is reached anywhere in it, not only where a lesion marks the place.
  const glm::dvec3& tip = signals.endpoint->tip_at_rest_lps_mm();
  bool lumen = false;
  for (const cases::Structure& one : signals.setting.structures) {
    if (one.rule != cases::StructureRule::target) continue;
    lumen = true;
    if (cases::signed_distance_mm(one.shape, tip, 1.0) <= 0.0) return true;
  }
  return !lumen && to_surface_mm(signals) <= 0.0;
}

std::span<const MetricInfo> endpoint_metrics() {
  return kEndpointMetrics;
}

}  // namespace seldinger::assessment
