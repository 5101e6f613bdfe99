// Deeds that show a step of a procedure to be done, where saying so would show nothing: each a moment, or never.
#pragma once

#include <optional>

namespace seldinger::assessment {

struct Signals;

// What counts as shown (judgement, all of them; an angle and a depth by eye and marks are no better).
constexpr double kSlideMm = 10.0, kRockDeg = 10.0, kTestSeconds = 10.0;
constexpr double kMeasuredMm = 5.0, kMovedMm = 15.0;  // beside the target's edges; more where tissue moves
constexpr double kPictureSeconds = 1.0;               // so long a live picture is still looked at
constexpr double kAngleDeg = 15.0;
constexpr double kPlannedDepthMm = 10.0;  // a needle's marks are 10 mm apart
constexpr double kExchangeMm = 10.0;      // an introducer stops before the target, and the needle goes on
constexpr double kCheckSeconds = 1.0;     // a hold that is over sooner left no time for a look
constexpr double kUncheckedMm = 2.0;      // so far is no slip of the hand

// With the face on the skin and the picture live, the probe was slid along its marker's axis by kSlideMm one way
// and back, or rocked so by kRockDeg, within kTestSeconds. There is skin.
std::optional<double> orientation_tested_s(const Signals& signals, double on_skin_mm);

// What was measured from the face is the target's depth below it, in a picture that showed the target: the last
// live one, or another of the second before. Events are known, and there is a target.
std::optional<double> depth_measured_s(const Signals& signals);

// The first puncture, where the needle stood to the skin within kAngleDeg of the plan's angle. There are skin and
// plan: without a way that is given no angle is right or wrong, and cases state no limits of their own.
std::optional<double> angle_kept_s(const Signals& signals);

// The trigger, where the needle was in by the depth that was last planned before the first puncture. Events are
// known, and there is skin.
std::optional<double> planned_depth_kept_s(const Signals& signals);

// An introducer, its stylet in, was first in the body: one that was put aside before, or refused in tissue, was not
// used. Events are known, and there is skin.
std::optional<double> introducer_used_s(const Signals& signals);

// An introducer's stylet was drawn in tissue, its tip at most kExchangeMm from the target's edge, or in it. Events
// are known, and there are target and skin.
std::optional<double> stylet_exchanged_s(const Signals& signals);

// The trigger, where it fell while the introducer's stylet was in. Events are known, and there is skin.
std::optional<double> fired_on_stylet_s(const Signals& signals);

// The check in the held breath and its way back (thesis, appendix A, step 12), of the holds that began with the
// needle in tissue. Events are known.
struct BreathChecks {
  // The needle was pushed on, or the trigger fell, in a hold of which no picture had yet shown the tip.
  std::optional<double> on_unchecked_s;
  // The end of the first hold that never showed it and in which the needle rested; when a live picture showed the
  // tip after that, before the needle went on; and when it went on without, after any such hold.
  std::optional<double> unseen_s, found_again_s, on_unfound_s;
};
BreathChecks breath_checks(const Signals& signals);

}  // namespace seldinger::assessment
