#include "assessment/metrics/time.h"

#include "assessment/signals.h"

namespace seldinger::assessment {

Measured time_total(const Signals& signals) {
  return Measured::of(signals.poses.back().t_s - signals.poses.front().t_s);
}

Measured gap_share(const Signals& signals) {
  const double total_s = signals.poses.back().t_s - signals.poses.front().t_s;
  if (!(total_s > 0.0)) return Measured::none("too_short");
  double gap_s = 0.0;
  for (std::size_t i = 0; i + 1 < signals.poses.size(); ++i)
    if (signals.gap(i)) gap_s += signals.interval_s(i);
  return Measured::of(gap_s / total_s);
}

}  // namespace seldinger::assessment
