#include "assessment/metrics/visibility.h"

#include <algorithm>

#include "assessment/signals.h"

namespace seldinger::assessment {
namespace {

constexpr double kMinSeconds = 1.0;  // assessment.md §8: a shorter denominator says nothing

struct Shares {
  double live_s = 0.0, needle_s = 0.0, target_s = 0.0, joint_s = 0.0;
};

// Poses and frames are both held until the next one; the integral runs over the union of their times.
Shares integrate(const Signals& signals) {
  Shares shares;
  std::size_t next_frame = 0;  // first frame later than the time reached
  for (std::size_t i = 0; i + 1 < signals.poses.size(); ++i) {
    double from_s = signals.poses[i].t_s;
    const double to_s = signals.poses[i + 1].t_s;
    while (from_s < to_s) {
      while (next_frame < signals.frames.size() && signals.frames[next_frame].t_s <= from_s) ++next_frame;
      const double until_s =
          next_frame < signals.frames.size() ? std::min(to_s, signals.frames[next_frame].t_s) : to_s;
      if (next_frame > 0 && signals.passages[i].in_body && !signals.gap(i)) {
        const cases::FrameTruth& frame = signals.frames[next_frame - 1];
        if (frame.live) {
          const double length_s = until_s - from_s;
          shares.live_s += length_s;
          if (frame.needle_tip) shares.needle_s += length_s;
          if (frame.target) shares.target_s += length_s;
          if (frame.joint()) shares.joint_s += length_s;
        }
      }
      from_s = until_s;
    }
  }
  return shares;
}

Measured share(const Signals& signals, double Shares::*part, bool of_needle) {
  // A projection has no plane to be out of.
  if (of_needle && signals.setting.modality != cases::Modality::xray &&
      signals.setting.approach == cases::Approach::out_of_plane)
    return Measured::none("not_meaningful_out_of_plane");
  if (!of_needle && !signals.setting.target) return Measured::none("no_target");
  if (part == &Shares::joint_s && !signals.setting.target) return Measured::none("no_target");
  if (signals.setting.skin->empty()) return Measured::none("no_skin");
  const Shares shares = integrate(signals);
  if (!(shares.live_s >= kMinSeconds)) return Measured::none("under_1_s_in_tissue_with_a_live_picture");
  return Measured::of(shares.*part / shares.live_s);
}

}  // namespace

Measured vis_needle(const Signals& signals) {
  return share(signals, &Shares::needle_s, true);
}

Measured vis_target(const Signals& signals) {
  return share(signals, &Shares::target_s, false);
}

Measured vis_joint(const Signals& signals) {
  return share(signals, &Shares::joint_s, true);
}

}  // namespace seldinger::assessment
