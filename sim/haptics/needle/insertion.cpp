#include "sim/haptics/needle/insertion.h"

#include <algorithm>
#include <cmath>

#include "sim/base/check.h"

namespace seldinger::haptics {
namespace {

// The ticks that a distance takes; a count that is whole but for rounding is that count.
double ticks(double amount, double per_tick) {
  return std::ceil(amount / per_tick * (1.0 - 1e-12));
}

}  // namespace

double insertion_samples(const Insertion& insertion, const NeedleSettings& settings) {
  const double way = ticks(insertion.depth_mm, insertion.speed_mm_s * settings.tick_s);
  return 1.0 + way * (insertion.retract ? 2.0 : 1.0) + ticks(insertion.hold_s, settings.tick_s);
}

std::vector<InsertionSample> insert(const Insertion& insertion, const NeedleSettings& settings) {
  CHECK(insertion.speed_mm_s > 0.0 && insertion.depth_mm > 0.0 && insertion.hold_s >= 0.0);
  const double step_mm = insertion.speed_mm_s * settings.tick_s;
  const auto way = static_cast<long long>(ticks(insertion.depth_mm, step_mm));
  const auto held = static_cast<long long>(ticks(insertion.hold_s, settings.tick_s));
  const long long last = way + held + (insertion.retract ? way : 0);
  const NeedleLayer layer{0.0, insertion.tissue};
  const NeedleLaw law(settings);
  NeedleTrack track;
  if (insertion.introducer_mm > 0.0) {
    track.opened = 1;
    track.cut_mm = track.sheath_mm = insertion.introducer_mm;
  }
  std::vector<InsertionSample> samples;
  samples.reserve(static_cast<std::size_t>(last) + 1);
  for (long long i = 0; i <= last; ++i) {
    const double in_mm = std::min(insertion.depth_mm, static_cast<double>(i) * step_mm);
    const double out_mm = static_cast<double>(std::max(0LL, i - way - held)) * step_mm;
    const double depth_mm = std::max(0.0, in_mm - out_mm);
    samples.push_back(
        {static_cast<double>(i) * settings.tick_s, depth_mm, law.advance({&layer, 1}, depth_mm, track)});
  }
  return samples;
}

}  // namespace seldinger::haptics
