#include "assessment/metrics/visibility.h"

#include <algorithm>

#include "assessment/signals.h"

namespace seldinger::assessment {
namespace {

constexpr double kMinSeconds = 1.0;  // assessment.md §8: a shorter denominator says nothing

constexpr double kJiggleMm = 1.0;  // to and fro by less is no advance (design)

struct Shares {
  double live_s = 0.0, needle_s = 0.0, target_s = 0.0, joint_s = 0.0;
  double joint_2_mm_s = 0.0, joint_5_mm_s = 0.0;  // where `near_plane` was told
  double needle_length_mm_s = 0.0;
  bool near_plane = true;  // in every picture
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
          shares.needle_length_mm_s += frame.needle_length_mm * length_s;
          shares.near_plane = shares.near_plane && frame.near_plane.has_value();
          const cases::NearPlane near_plane = frame.near_plane.value_or(cases::NearPlane{});
          if (near_plane.tip_2_mm && near_plane.target_2_mm) shares.joint_2_mm_s += length_s;
          if (near_plane.tip_5_mm && near_plane.target_5_mm) shares.joint_5_mm_s += length_s;
        }
      }
      from_s = until_s;
    }
  }
  return shares;
}

enum class Of { needle, target, both };

Measured share(const Signals& signals, double Shares::*part, Of of) {
  // A projection has no plane to be out of.
  if (of != Of::target && signals.setting.modality != cases::Modality::xray &&
      signals.setting.approach == cases::Approach::out_of_plane)
    return Measured::none("not_meaningful_out_of_plane");
  if (of != Of::needle && !signals.setting.target) return Measured::none("no_target");
  if (signals.setting.skin->empty()) return Measured::none("no_skin");
  const Shares shares = integrate(signals);
  if (!(shares.live_s >= kMinSeconds)) return Measured::none("under_1_s_in_tissue_with_a_live_picture");
  if ((part == &Shares::joint_2_mm_s || part == &Shares::joint_5_mm_s) && !shares.near_plane)
    return Measured::none("near_plane_not_recorded");
  return Measured::of(shares.*part / shares.live_s);
}

Measured joint_near_plane(const Signals& signals, double Shares::*part) {
  if (signals.setting.modality != cases::Modality::ultrasound) return Measured::none("not_ultrasound");
  return share(signals, part, Of::both);
}

}  // namespace

Measured vis_needle(const Signals& signals) {
  return share(signals, &Shares::needle_s, Of::needle);
}

Measured vis_target(const Signals& signals) {
  return share(signals, &Shares::target_s, Of::target);
}

Measured vis_joint(const Signals& signals) {
  return share(signals, &Shares::joint_s, Of::both);
}

Measured vis_joint_2_mm(const Signals& signals) {
  return joint_near_plane(signals, &Shares::joint_2_mm_s);
}

Measured vis_joint_5_mm(const Signals& signals) {
  return joint_near_plane(signals, &Shares::joint_5_mm_s);
}

Measured visible_needle_length(const Signals& signals) {
  return share(signals, &Shares::needle_length_mm_s, Of::needle);
}

Measured advance_visible_share(const Signals& signals) {
  if (signals.setting.modality == cases::Modality::xray) return Measured::none("not_meaningful_under_xray");
  if (signals.setting.approach == cases::Approach::out_of_plane)
    return Measured::none("not_meaningful_out_of_plane");
  if (signals.setting.skin->empty()) return Measured::none("no_skin");
  if (signals.frames.empty()) return Measured::none("no_picture");
  double advance_mm = 0.0, visible_mm = 0.0, reached_mm = 0.0;
  std::size_t next_frame = 0;
  for (std::size_t i = 0; i < signals.poses.size(); ++i) {
    // What the picture showed when this step of the way began.
    while (i > 0 && next_frame < signals.frames.size() &&
           signals.frames[next_frame].t_s <= signals.poses[i - 1].t_s)
      ++next_frame;
    const double inserted_mm = signals.inserted_mm(i);
    if (i == 0 || signals.gap(i - 1)) {
      reached_mm = inserted_mm;  // what happened before, or in a gap, is not known
    } else if (inserted_mm > reached_mm) {
      advance_mm += inserted_mm - reached_mm;
      if (next_frame > 0 && signals.frames[next_frame - 1].live && signals.frames[next_frame - 1].needle_tip)
        visible_mm += inserted_mm - reached_mm;
      reached_mm = inserted_mm;
    } else {
      reached_mm = std::min(reached_mm, inserted_mm + kJiggleMm);
    }
  }
  if (!(advance_mm >= kJiggleMm)) return Measured::none("under_1_mm_of_advance");
  return Measured::of(visible_mm / advance_mm);
}

}  // namespace seldinger::assessment
