// Shares of time in which the picture showed needle tip, target, or both.
#include <algorithm>

#include "assessment/metrics/tables.h"
#include "assessment/signals/signals.h"
#include "assessment/signals/target_view.h"

namespace seldinger::assessment {
namespace {

constexpr double kMinSeconds = 1.0;  // our judgement: a shorter denominator says nothing

struct Shares {
  double session_s = 0.0, joint_session_s = 0.0;  // in tissue or not, live or not
  double tissue_s = 0.0;                          // with the tip in tissue, live or not
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
      if (signals.passages[i].in_body) shares.tissue_s += length_s;
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

enum class Shown { needle, target, places };  // places: by geometry alone

// A probe's picture is there unless somebody froze it, and what is frozen shows nothing. A fluoroscope's is there
// only while a pulse's time lasts, and nobody is asked to look between two.
template <double Shares::*part, Shown shown>
Measured share(const Signals& signals) {
  if (shown == Shown::target && no_view_shows_target(signals)) return Measured::none("no_view_shows_target");
  const Shares shares = integrate(signals);
  const bool xray = signals.setting.modality == cases::Modality::xray;
  const double all_s = xray ? shares.live_s : shares.tissue_s;
  if (!(all_s >= kMinSeconds))
    return Measured::none(xray ? "under_1_s_in_tissue_with_a_live_picture" : "under_1_s_in_tissue");
  return Measured::of(shares.*part / all_s);
}

Measured vis_joint_session(const Signals& signals) {
  if (no_view_shows_target(signals)) return Measured::none("no_view_shows_target");
  const Shares shares = integrate(signals);
  if (!(shares.session_s >= kMinSeconds)) return Measured::none("under_1_s");
  return Measured::of(shares.joint_session_s / shares.session_s);
}

constexpr const char* kPerk = "Perk Tutor's TargetsScanned: 5 mm in its code, 2 mm in its comment";

constexpr std::uint32_t kShares =
    kAnyPlace | kAtAnySpeed | kInAnyBreath | kIdleBefore | kOneDarkFrame | kLostSamples | kNothingIsNothing;

constexpr MetricInfo kVisibilityMetrics[] = {
    {"vis_joint", 7, "share", "Needle and target visible", Group::picture, Direction::higher_is_better,
     kInPlane | kTarget | kSkin | kPictures, "As vis_needle, for tip and target at once. Null: as vis_target.",
     kVidal, &share<&Shares::joint_s, Shown::target>, kMedianShare, kShares,
     "1: of the time with a live picture alone: freezing it took bad time out; 2" SELDINGER_BY_HALF_SLICE
     " 3" SELDINGER_BY_ECHO " 4" SELDINGER_WITHOUT_CLUTTER " 5" SELDINGER_WITHOUT_IODINE " 6" SELDINGER_AT_ANY_TILT,
     kAsksForAnyPicture},
    {"vis_needle", 7, "share", "Needle tip visible", Group::picture, Direction::higher_is_better,
     kInPlane | kSkin | kPictures,
     "Share of the time in tissue in which a live picture showed the needle's tip. A frozen picture shows nothing, "
     "but its time counts. Under fluoroscopy the share is of the time with a live picture only; a picture lasts "
     "from its pulse until the next is due. Null: under_1_s_in_tissue (fluoroscope: "
     "under_1_s_in_tissue_with_a_live_picture).",
     kVidal, &share<&Shares::needle_s, Shown::needle>, kMedianShare, kShares,
     "1: of the time with a live picture alone: freezing it took bad time out; 2" SELDINGER_BY_HALF_SLICE
     " 3" SELDINGER_BY_ECHO " 4" SELDINGER_WITHOUT_CLUTTER " 5" SELDINGER_WITHOUT_IODINE " 6" SELDINGER_AT_ANY_TILT,
     kAsksForAnyPicture},
    {"vis_shaft", 4, "share", "Any needle visible", Group::picture, Direction::higher_is_better,
     kInPlane | kSkin | kPictures,
     "As vis_needle, for any part of the needle: shown without its tip, it misleads. Null: as vis_needle.",
     kJohnson, &share<&Shares::shaft_s, Shown::needle>, kMedianShare, kShares,
     "1: of the time with a live picture alone: freezing it took bad time out; 2" SELDINGER_WITHOUT_CLUTTER
     " 3" SELDINGER_AT_ANY_TILT,
     kAsksForShaft},
    {"vis_target", 7, "share", "Target visible", Group::picture, Direction::higher_is_better,
     kTarget | kSkin | kPictures,
     "As vis_needle, for the target. Null: as vis_needle; no_view_shows_target (fluoroscope: none did, and none "
     "could: across its whole width the target attenuates under 5 % more or less than what lies around it). Under "
     "other guidance this is never the reason: a slice shows any target that lies in it, and in ultrasound one "
     "that echoes like what lies around it, or that bone or gas hides from everywhere, is not seen: 0.",
     kVidal, &share<&Shares::target_s, Shown::target>, kMedianShare, kShares,
     "1: of the time with a live picture alone, and 0 where no picture could show the target; "
     "2" SELDINGER_BY_HALF_SLICE " 3" SELDINGER_BY_ECHO " 4" SELDINGER_WITHOUT_CLUTTER " 5" SELDINGER_WITHOUT_IODINE
     " 6" SELDINGER_AT_ANY_TILT,
     kAsksForAnyPicture},
    {"vis_joint_session", 7, "share", "Both visible, whole session", Group::picture, Direction::higher_is_better,
     kInPlane | kTarget | kPictures,
     "Share of the whole time, gaps left out, in which a live picture showed tip and target at once. Null: "
     "under_1_s, no_view_shows_target.",
     kVidal, &vis_joint_session, kMedianShare, kAnyPlace | kAtAnySpeed,
     "1: 0 where no picture could show the target; 2" SELDINGER_BY_HALF_SLICE " 3" SELDINGER_BY_ECHO
     " 4" SELDINGER_WITHOUT_CLUTTER " 5" SELDINGER_WITHOUT_IODINE " 6" SELDINGER_AT_ANY_TILT,
     kAsksForAnyPicture},
    {"vis_joint_2_mm", 2, "share", "Both within 2 mm", Group::picture, Direction::higher_is_better,
     kUltrasound | kInPlane | kTarget | kSkin | kPictures | kNearPlane,
     "As vis_joint, by geometry alone: tip and target's centre within 2 mm of the picture's plane and inside its "
     "field. Null: as vis_needle.",
     kPerk, &share<&Shares::joint_2_mm_s, Shown::places>, kMedianShare, kShares,
     "1: of the time with a live picture alone: freezing it took bad time out."},
    {"vis_joint_5_mm", 2, "share", "Both within 5 mm", Group::picture, Direction::higher_is_better,
     kUltrasound | kInPlane | kTarget | kSkin | kPictures | kNearPlane,
     "As vis_joint_2_mm, within 5 mm. Null: as vis_needle.", kPerk, &share<&Shares::joint_5_mm_s, Shown::places>,
     kMedianShare, kShares, "1: of the time with a live picture alone: freezing it took bad time out."},
    {"visible_needle_length", 4, "mm", "Visible needle length", Group::picture, Direction::higher_is_better,
     kInPlane | kSkin | kPictures,
     "Mean, over the time that vis_needle counts, of the shaft's length that the picture showed. Null: as "
     "vis_needle.",
     kJohnson, &share<&Shares::needle_length_mm_s, Shown::needle>, kMedianRatio, kShares,
     "1: of the time with a live picture alone: freezing it took bad time out; 2" SELDINGER_WITHOUT_CLUTTER
     " 3" SELDINGER_AT_ANY_TILT,
     kAsksForShaft},
};

}  // namespace

std::span<const MetricInfo> visibility_metrics() {
  return kVisibilityMetrics;
}

}  // namespace seldinger::assessment
