#include "sim/haptics/force_limiter.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/base/check.h"
#include "sim/base/vectors.h"

namespace seldinger::haptics {
namespace {

// After a fault all force is gone in this time (docs/touch.md, S16).
constexpr double kFadeS = 0.020;
// Per tick of 1 ms (docs/touch.md): what changes faster follows at this rate.
constexpr double kMostChangeNS = 150.0;
// What a device bears "for 24 hours" (thesis §5.3.2) is said of motors and housing, which warm up in minutes
// (design; no maker's figure is at hand). Up to this part of that heat nothing is held back, so that a puncture
// feels as it is.
constexpr double kThermalS = 60.0;
constexpr double kFreePart = 0.8;

glm::dvec3 at_most(const glm::dvec3& v, double length) {
  const double square = glm::dot(v, v);
  return square > length * length ? length / std::sqrt(square) * v : v;
}

}  // namespace

ForceLimiter::ForceLimiter(const ForceLimits& limits) : limits_(limits) {
  CHECK(limits.continuous_n > 0.0 && limits.peak_n >= limits.continuous_n && limits.tick_s > 0.0);
}

glm::dvec3 ForceLimiter::advance(const glm::dvec3& wanted_n, double elapsed_s, bool healthy,
                                 ForceLimiterState& state) const noexcept {
  const double passed_s = elapsed_s > limits_.tick_s ? elapsed_s : limits_.tick_s;
  state.held_back_n = 0.0;
  const bool stalled = !(elapsed_s < kFadeS);
  if (!healthy || stalled || !base::is_finite(wanted_n)) {
    if (!(state.fault_s > 0.0)) state.fault_n = state.out_n;
    state.fault_s = stalled ? kFadeS : state.fault_s + passed_s;
    state.share = 0.0;
    state.out_n = std::max(0.0, 1.0 - state.fault_s / kFadeS) * state.fault_n;
  } else {
    state.fault_s = 0.0;
    state.share = std::min(1.0, state.share + limits_.tick_s / kReturnS);
    // From peak down to what is borne for ever, so that the mean square never passes that.
    const double warm = state.heat_n2 / (limits_.continuous_n * limits_.continuous_n);
    const double cold = std::clamp((1.0 - warm) / (1.0 - kFreePart), 0.0, 1.0);
    const double most_n = limits_.continuous_n + (limits_.peak_n - limits_.continuous_n) * cold;
    const glm::dvec3 asked_n = state.share * wanted_n, target_n = at_most(asked_n, most_n);
    if (target_n != asked_n) state.held_back_n = std::sqrt(glm::dot(asked_n, asked_n)) - most_n;
    state.out_n += at_most(target_n - state.out_n, kMostChangeNS * limits_.tick_s);
  }
  const double part = std::min(1.0, passed_s / kThermalS);
  state.heat_n2 += part * (glm::dot(state.out_n, state.out_n) - state.heat_n2);
  return state.out_n;
}

}  // namespace seldinger::haptics
