// Metrics of the needle's force, where a device or its model gave one.
#include <algorithm>
#include <cmath>

#include "assessment/metrics/tables.h"
#include "assessment/signals/signals.h"

namespace seldinger::assessment {
namespace {

Measured force_peak_axial(const Signals& signals) {
  double peak_n = 0.0;
  for (const cases::ForceSample& force : signals.forces) peak_n = std::max(peak_n, force.needle_axial_n);
  return Measured::of(peak_n);
}

Measured lateral_force_peak(const Signals& signals) {
  double peak_n = 0.0;
  for (const cases::ForceSample& force : signals.forces)
    peak_n = std::max(peak_n, std::abs(force.needle_lateral_n));
  return Measured::of(peak_n);
}

constexpr const char* kModel = "model force: what the needle's law commanded, not what a hand felt";

constexpr const char* kHistory =
    "1: also of needles that mouse, gamepad or 3-D mouse led; 2: null where an arm led the needle in tissue and "
    "another hand took it up in the air at the end.";

constexpr MetricInfo kForcesMetrics[] = {
    {"force_peak_axial", 3, "N", "Peak axial force", Group::safety, Direction::lower_is_better, kForces | kArmLed,
     "Greatest force along the needle against its insertion, up to the endpoint, where an arm led the needle "
     "whenever it was in tissue: a mouse gives no force that could be felt.",
     kModel, &force_peak_axial, kMedianRatio, kAnyPlace | kAtAnySpeed | kIdleBefore | kIdleAfter | kOneDarkFrame,
     kHistory},
    {"lateral_force_peak", 3, "N", "Peak lateral force", Group::safety, Direction::lower_is_better,
     kForces | kArmLed,
     "Greatest force across the needle, up to the endpoint, where an arm led it as for force_peak_axial: it bends "
     "the needle and tears the organ.",
     kModel, &lateral_force_peak, kMedianRatio, kAnyPlace | kAtAnySpeed | kIdleBefore | kIdleAfter | kOneDarkFrame,
     kHistory},
};

}  // namespace

std::span<const MetricInfo> force_metrics() {
  return kForcesMetrics;
}

}  // namespace seldinger::assessment
