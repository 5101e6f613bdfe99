// Shares of time in which the picture showed needle tip, target, or both.
#include <algorithm>

#include "assessment/metrics/tables.h"
#include "assessment/signals/signals.h"

namespace seldinger::assessment {
namespace {

constexpr double kMinSeconds = 1.0;  // assessment.md §8: a shorter denominator says nothing

struct Shares {
  double session_s = 0.0, joint_session_s = 0.0;  // in tissue or not, live or not
  double live_s = 0.0, shaft_s = 0.0, needle_s = 0.0, target_s = 0.0, joint_s = 0.0;
  double joint_2_mm_s = 0.0, joint_5_mm_s = 0.0;  // where `near_plane` was told
  double needle_length_mm_s = 0.0;
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
      const double length_s = signals.gap(i) ? 0.0 : until_s - from_s;
      shares.session_s += length_s;
      if (next_frame > 0) {
        const cases::FrameTruth& frame = signals.frames[next_frame - 1];
        if (frame.live && frame.joint()) shares.joint_session_s += length_s;
        if (frame.live && signals.passages[i].in_body) {
          shares.live_s += length_s;
          if (frame.needle_length_mm > 0.0) shares.shaft_s += length_s;
          if (frame.needle_tip) shares.needle_s += length_s;
          if (frame.target) shares.target_s += length_s;
          if (frame.joint()) shares.joint_s += length_s;
          shares.needle_length_mm_s += frame.needle_length_mm * length_s;
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

template <double Shares::*part>
Measured share(const Signals& signals) {
  const Shares shares = integrate(signals);
  if (!(shares.live_s >= kMinSeconds)) return Measured::none("under_1_s_in_tissue_with_a_live_picture");
  return Measured::of(shares.*part / shares.live_s);
}

Measured vis_joint_session(const Signals& signals) {
  const Shares shares = integrate(signals);
  if (!(shares.session_s >= kMinSeconds)) return Measured::none("under_1_s");
  return Measured::of(shares.joint_session_s / shares.session_s);
}

constexpr const char* kPerk = "Perk Tutor's TargetsScanned: 5 mm in its code, 2 mm in its comment";

constexpr MetricInfo kVisibilityMetrics[] = {
    {"vis_joint", 1, "share", "Needle and target visible", Group::picture, Direction::higher_is_better,
     kInPlane | kTarget | kSkin,
     "As vis_needle, for tip and target at once. Null: under_1_s_in_tissue_with_a_live_picture.", kVidal,
     &share<&Shares::joint_s>},
    {"vis_needle", 1, "share", "Needle tip visible", Group::picture, Direction::higher_is_better, kInPlane | kSkin,
     "Share of the time in tissue with a live picture in which the picture showed the needle's tip. A "
     "fluoroscope's "
     "picture is live from a pulse until the time to the next is over; a held image is not. Null: "
     "under_1_s_in_tissue_with_a_live_picture.",
     kVidal, &share<&Shares::needle_s>},
    {"vis_shaft", 1, "share", "Any needle visible", Group::picture, Direction::higher_is_better, kInPlane | kSkin,
     "As vis_needle, for any part of the needle: shown without its tip, it misleads. Null: "
     "under_1_s_in_tissue_with_a_live_picture.",
     kJohnson, &share<&Shares::shaft_s>},
    {"vis_target", 1, "share", "Target visible", Group::picture, Direction::higher_is_better, kTarget | kSkin,
     "As vis_needle, for the target. Null: under_1_s_in_tissue_with_a_live_picture.", kVidal,
     &share<&Shares::target_s>},
    {"vis_joint_session", 1, "share", "Both visible, whole session", Group::picture, Direction::higher_is_better,
     kInPlane | kTarget | kPictures,
     "Share of the whole time, gaps left out, in which a live picture showed tip and target at once. Null: "
     "under_1_s.",
     kVidal, &vis_joint_session},
    {"vis_joint_2_mm", 1, "share", "Both within 2 mm", Group::picture, Direction::higher_is_better,
     kUltrasound | kInPlane | kTarget | kSkin | kNearPlane,
     "As vis_joint, by geometry alone: tip and target's centre within 2 mm of the picture's plane and inside its "
     "field. Null: as vis_joint.",
     kPerk, &share<&Shares::joint_2_mm_s>},
    {"vis_joint_5_mm", 1, "share", "Both within 5 mm", Group::picture, Direction::higher_is_better,
     kUltrasound | kInPlane | kTarget | kSkin | kNearPlane, "As vis_joint_2_mm, within 5 mm. Null: as vis_joint.",
     kPerk, &share<&Shares::joint_5_mm_s>},
    {"visible_needle_length", 1, "mm", "Visible needle length", Group::picture, Direction::higher_is_better,
     kInPlane | kSkin,
     "Mean, over the time that vis_needle counts, of the shaft's length that the picture showed. Null: as "
     "vis_needle.",
     kJohnson, &share<&Shares::needle_length_mm_s>},
};

}  // namespace

std::span<const MetricInfo> visibility_metrics() {
  return kVisibilityMetrics;
}

}  // namespace seldinger::assessment
