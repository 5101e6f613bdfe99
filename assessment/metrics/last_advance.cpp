// How the target was come to: what of the last of the way showed tip and target at once; and out of plane, how far
// the needle went between two sights of its tip.
#include <algorithm>

#include "assessment/metrics/tables.h"
#include "assessment/signals/signals.h"

namespace seldinger::assessment {
namespace {

constexpr double kLastMm = 20.0;  // judgement: from where a hand is no longer turned but only pushed

// Advance from one depth to a deeper one, along the needle from where it entered the skin.
struct Push {
  double from_mm = 0.0, to_mm = 0.0;
  bool joint = false;  // as the picture showed it when the push began
};

// Of the last puncture; what came before it did not lead to the endpoint.
std::vector<Push> pushes_of(const Signals& signals) {
  std::vector<Push> pushes;
  bool joint = false;
  std::size_t next_frame = 0;
  for (std::size_t i = 1; i < signals.poses.size(); ++i) {
    for (; next_frame < signals.frames.size() && signals.frames[next_frame].t_s <= signals.poses[i - 1].t_s;
         ++next_frame)
      joint = signals.frames[next_frame].live && signals.frames[next_frame].joint();
    if (!signals.passages[i].in_body) pushes.clear();
    const double advance_mm = signals.advance_mm[i], to_mm = signals.pushed_mm[i];
    if (advance_mm > 0.0) pushes.push_back({to_mm - advance_mm, to_mm, joint});
  }
  return pushes;
}

// Each depth counts once, by the last push through it: so neither waiting in view nor to and fro adds to a share,
// and who goes back and comes again in view has mended what was not seen.
Measured joint_visible_last(const Signals& signals) {
  const std::vector<Push> pushes = pushes_of(signals);
  double above_mm = signals.pushed_mm.back();  // what is deeper has been counted
  const double from_mm = above_mm - kLastMm;
  double advance_mm = 0.0, joint_mm = 0.0;
  for (auto push = pushes.rbegin(); push != pushes.rend(); ++push) {
    const double length_mm = std::min(push->to_mm, above_mm) - std::max(push->from_mm, from_mm);
    above_mm = std::min(above_mm, push->from_mm);
    if (!(length_mm > 0.0)) continue;
    advance_mm += length_mm;
    if (push->joint) joint_mm += length_mm;
  }
  if (!(advance_mm >= kJiggleMm)) return Measured::none("under_1_mm_of_advance");
  return Measured::of(joint_mm / advance_mm);
}

// Out of plane the tip is seen in passing: one picture ends a run. A gap neither adds nor ends one: what a picture
// showed in it counts where it still does at its end.
Measured longest_between_sights(const Signals& signals) {
  double advance_mm = 0.0, run_mm = 0.0, longest_mm = 0.0;
  bool visible = false;
  std::size_t next_frame = 0;
  for (std::size_t i = 1; i < signals.poses.size(); ++i) {
    bool shown = visible;  // by any picture since the step before
    const bool after_gap = i > 1 && signals.gap(i - 2);
    for (; next_frame < signals.frames.size() && signals.frames[next_frame].t_s <= signals.poses[i - 1].t_s;
         ++next_frame) {
      visible = signals.frames[next_frame].live && signals.frames[next_frame].needle_tip;
      shown = shown || (visible && !after_gap);
    }
    if (shown || visible || !signals.passages[i].in_body) run_mm = 0.0;
    advance_mm += signals.advance_mm[i];
    if (visible) continue;
    run_mm += signals.advance_mm[i];
    longest_mm = std::max(longest_mm, run_mm);
  }
  if (!(advance_mm >= kJiggleMm)) return Measured::none("under_1_mm_of_advance");
  return Measured::of(longest_mm);
}

constexpr MetricInfo kLastAdvanceMetrics[] = {
    {"advance_joint_visible_last_20_mm",
     5,
     "share",
     "Both visible near target",
     Group::picture,
     Direction::higher_is_better,
     kPicturePlane | kInPlane | kTarget | kSkin | kPictures | kMotion | kTissue | kEndpoint,
     "Share of the last 20 mm of depth before the endpoint through which the tip was pushed while a live picture "
     "showed tip and target at once. Where a depth was passed more than once, the last time counts; a shorter path "
     "counts as a whole. Waiting in view adds nothing. A frozen picture shows nothing. Null: "
     "under_1_mm_of_advance.",
     "by length instead of time as advance_visible_share, PMC4384236; 20 mm: judgement",
     &joint_visible_last,
     {Scale::share, WithoutEndpoint::failure, Aggregation::median},
     kAtAnySpeed | kInAnyFrame | kMirrored | kIdleBefore | kNothingIsNothing,
     "1: without the first 1 mm of a further puncture; 2" SELDINGER_BY_HALF_SLICE " 3" SELDINGER_WITHOUT_CLUTTER
     " 4" SELDINGER_AT_ANY_TILT,
     kAsksForProbesPicture},
    {"longest_advance_between_sights", 5, "mm", "Advance between sights", Group::picture,
     Direction::lower_is_better, kPicturePlane | kOutOfPlane | kSkin | kPictures | kMotion | kTissue,
     "Greatest length by which the tip was pushed in tissue from one live picture that showed it to the next, from "
     "the "
     "skin "
     "to the first, or from the last to the endpoint: out of plane the tip is seen in passing, each time the probe "
     "goes ahead and the needle follows. Null: under_1_mm_of_advance.",
     "dynamic needle tip positioning: Clemmesen et al., Ultraschall Med. 33 (2012) E321", &longest_between_sights,
     kMedianRatio, kAtAnySpeed | kInAnyFrame | kMirrored | kIdleBefore | kIdleAfter | kNothingIsNothing,
     "1: a picture of the tip in a gap ended it; without the first 1 mm of a further puncture; "
     "2" SELDINGER_BY_HALF_SLICE " 3" SELDINGER_WITHOUT_CLUTTER " 4" SELDINGER_AT_ANY_TILT,
     kAsksForProbesPicture},
};

}  // namespace

std::span<const MetricInfo> last_advance_metrics() {
  return kLastAdvanceMetrics;
}

}  // namespace seldinger::assessment
