#include "sim/haptics/needle/needle_law.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "sim/base/check.h"
#include "sim/base/exact_math.h"

namespace seldinger::haptics {
namespace {

using Path = std::span<const NeedleLayer>;

// The shaft takes no more than this share of the device's stiffness, so that the tip's part stays palpable
// (design).
constexpr double kShaftShare = 0.4;
// A capsule's spring is R (a q + (1 − a) q²) with q = dent / full dent: soft at touch, stiffest at rupture
// (design).
constexpr double kCapsuleLinearPart = 0.25;
// The fall after a rupture takes 5-20 ms (our judgement).
constexpr double kRuptureFallS = 0.008;
// A high fall takes as long as it needs to be no step, 0.1 N a tick (design; the goal of 0.15 N a tick).
constexpr double kMostFallNS = 100.0;
// Relaxation: to this part of what slides or cuts, with this time (our judgement, within 5-20 s).
constexpr double kRelaxedPart = 0.65, kRelaxationS = 10.0;

// Steel in a steel tube, wet: next to what tissue holds (design).
constexpr double kSheathFrictionN = 0.05, kSheathStiffnessNMm = 0.1;

// The faster, the less a capsule bears, down to a bound (Mahvash and Dupont, IEEE ICRA 2009, PMC3051196, read; IEEE
// TBME 2010, recalled: porcine heart); by how much a decade, and between which speeds, is design.
constexpr double kLessADecade = 0.15;
// Counts of an encoder make speeds of their own; a hand's lasts longer (design).
constexpr double kSpeedS = 0.03;

double next_start_mm(Path path, const NeedleTrack& track) noexcept {
  return track.opened < path.size() ? path[track.opened].start_mm : std::numeric_limits<double>::infinity();
}

double friction_limit_n(Path path, double length_mm, const NeedleTrack& track) noexcept {
  double limit_n = track.sheath_mm > 0.0 ? kSheathFrictionN : 0.0;
  for (std::size_t i = 0; i < track.opened; ++i) {
    const double end_mm = path[0].start_mm + length_mm;
    const double from_mm = std::max(path[i].start_mm, path[0].start_mm + track.sheath_mm);
    const double to_mm = i + 1 < path.size() ? std::min(path[i + 1].start_mm, end_mm) : end_mm;
    if (to_mm > from_mm) limit_n += path[i].tissue.slope_n_mm * (to_mm - from_mm);
  }
  return limit_n;
}

}  // namespace

NeedleSettings of_law(NeedleSettings settings, cases::TouchLaw law) noexcept {
  settings.relaxation = settings.rupture_by_speed = law != cases::TouchLaw::steady;
  return settings;
}

// The wall before the tip: a spring up to `limit_n`, which it bears at a stretch of `reach_mm`; then it is cut.
struct NeedleLaw::Tip {
  double stiffness_n_mm, limit_n, reach_mm;
};

NeedleLaw::NeedleLaw(const NeedleSettings& settings)
    : settings_(settings),
      damper_({.tick_s = settings.tick_s,
               .damping_n_s_mm = settings.damping_n_s_mm,
               .stiffness_n_mm = settings.stiffness_n_mm}),
      falling_share_(1.0 - base::exact_exp(-settings.tick_s / kRuptureFallS)),
      speed_share_(1.0 - base::exact_exp(-settings.tick_s / kSpeedS)) {
  // The spring's slope where it bears the most that may open it, in R / full dent.
  const double most = settings.rupture_by_speed ? rupture_share(kSlowestMmS) : 1.0;
  capsule_steepest_ = std::sqrt(kCapsuleLinearPart * kCapsuleLinearPart + 4.0 * (1.0 - kCapsuleLinearPart) * most);
}

double rupture_share(double speed_mm_s) noexcept {
  const double decades =
      base::exact_log(std::clamp(speed_mm_s, kSlowestMmS, kFastestMmS) / kRowSpeedMmS) / std::numbers::ln10;
  return 1.0 - kLessADecade * decades;
}

double inserted_mm(Path path, double depth_mm, const NeedleTrack& track) noexcept {
  return track.opened == 0 ? 0.0 : std::max(0.0, std::min(track.cut_mm, depth_mm) - path[0].start_mm);
}

NeedleLaw::Tip NeedleLaw::tip_of(const NeedleTissue& tissue) const noexcept {
  if (!(tissue.intercept_n > 0.0)) return {0.0, 0.0, 0.0};
  const double stiffness_n_mm = std::min(tissue.tip_stiffness_n_mm, settings_.stiffness_n_mm * (1.0 - kShaftShare));
  // The line is measured at the hub's depth; the shaft in tissue is shorter by the reach = limit / stiffness.
  const double limit_n = tissue.intercept_n / (1.0 - tissue.slope_n_mm / stiffness_n_mm);
  return {stiffness_n_mm, limit_n, limit_n / stiffness_n_mm};
}

double NeedleLaw::opens_at_n(const NeedleTissue& tissue, const NeedleTrack& track) const noexcept {
  return settings_.rupture_by_speed ? tissue.rupture_n * rupture_share(track.speed_mm_s) : tissue.rupture_n;
}

double NeedleLaw::shaft_stiffness_n_mm(double length_mm, const NeedleTrack& track) const noexcept {
  const double bare_mm = std::max(0.0, length_mm - track.sheath_mm);
  const double sheath_n_mm = track.sheath_mm > 0.0 ? kSheathStiffnessNMm : 0.0;
  return std::min(sheath_n_mm + kShaftStiffnessNMm2 * bare_mm, kShaftShare * settings_.stiffness_n_mm);
}

double NeedleLaw::dragged_mm(double length_mm, const NeedleTrack& track) const noexcept {
  const double stiffness_n_mm = shaft_stiffness_n_mm(length_mm, track);
  return stiffness_n_mm > 0.0 && length_mm > track.sheath_mm ? track.shaft_n / stiffness_n_mm : 0.0;
}

double NeedleLaw::tip_force_n(Path path, double depth_mm, const NeedleTrack& track) const noexcept {
  const double stretch_mm = depth_mm - track.cut_mm;
  if (!(stretch_mm > 0.0)) return 0.0;
  double reach_mm = 0.0, force_n = 0.0;
  if (track.opened > 0) {
    const Tip tip = tip_of(path[track.opened - 1].tissue);
    reach_mm = tip.reach_mm;
    force_n = stretch_mm < reach_mm ? tip.stiffness_n_mm * stretch_mm : tip.limit_n;
  }
  if (track.cut_mm < next_start_mm(path, track) || stretch_mm <= reach_mm) return force_n;
  const NeedleLayer& next = path[track.opened];
  const double dent_mm = stretch_mm - reach_mm;
  const double beside_shaft_n_mm =
      settings_.stiffness_n_mm - shaft_stiffness_n_mm(next.start_mm - path[0].start_mm, track);
  if (next.tissue.impenetrable) return force_n + beside_shaft_n_mm * dent_mm;
  if (!(next.tissue.rupture_n > 0.0)) return force_n;
  const double full_dent_mm =
      std::max(next.tissue.dent_mm, capsule_steepest_ * next.tissue.rupture_n / beside_shaft_n_mm);
  const double q = dent_mm / full_dent_mm;
  return force_n + next.tissue.rupture_n * q * (kCapsuleLinearPart + (1.0 - kCapsuleLinearPart) * q);
}

// The wall follows a tip that pushes harder than cutting takes, as far as the next capsule.
void NeedleLaw::cut(Path path, double depth_mm, NeedleTrack& track) const noexcept {
  const double reach_mm = tip_of(path[track.opened - 1].tissue).reach_mm;
  const double next_mm = next_start_mm(path, track);
  if (depth_mm - reach_mm > track.cut_mm) track.cut_mm = std::min(depth_mm - reach_mm, next_mm);
  if (!settings_.relaxation || track.cut_mm >= next_mm) return;
  const double excess_mm = depth_mm - track.cut_mm - kRelaxedPart * reach_mm;
  if (excess_mm > 0.0) track.cut_mm = std::min(track.cut_mm + settings_.tick_s / kRelaxationS * excess_mm, next_mm);
}

void NeedleLaw::slide(Path path, double depth_mm, NeedleTrack& track) const noexcept {
  const double length_mm = inserted_mm(path, depth_mm, track);
  const double limit_n = friction_limit_n(path, length_mm, track);
  const double moved_mm = track.begun ? depth_mm - track.last_depth_mm : 0.0;
  track.shaft_n = std::clamp(track.shaft_n + shaft_stiffness_n_mm(length_mm, track) * moved_mm, -limit_n, limit_n);
  if (!settings_.relaxation) return;
  const double kept_n = std::clamp(track.shaft_n, -kRelaxedPart * limit_n, kRelaxedPart * limit_n);
  track.shaft_n -= settings_.tick_s / kRelaxationS * (track.shaft_n - kept_n);
}

NeedleForce NeedleLaw::advance(Path path, double depth_mm, NeedleTrack& track) const noexcept {
  CHECK(track.opened <= path.size());
  NeedleForce force;
  if (track.opened == 0 && !path.empty()) track.cut_mm = path[0].start_mm;
  if (track.opened > 0) cut(path, depth_mm, track);
  force.tip_n = path.empty() ? 0.0 : tip_force_n(path, depth_mm, track);
  if (track.opened > 0 && track.cut_mm >= next_start_mm(path, track))
    force.capsule_n = std::max(0.0, force.tip_n - tip_of(path[track.opened - 1].tissue).limit_n);
  const double moved_mm = track.begun ? depth_mm - track.last_depth_mm : 0.0;
  track.speed_mm_s += speed_share_ * (moved_mm / settings_.tick_s - track.speed_mm_s);

  if (track.opened < path.size() && !path[track.opened].tissue.impenetrable && depth_mm > track.cut_mm &&
      track.cut_mm >= path[track.opened].start_mm && force.tip_n >= opens_at_n(path[track.opened].tissue, track)) {
    force.ruptured = true;
    force.capsule_n = 0.0;
    const double held_n = force.tip_n + track.shaft_n + track.damper_n;
    ++track.opened;
    cut(path, depth_mm, track);
    force.tip_n = tip_force_n(path, depth_mm, track);
    // The tissue that was pushed in slides back along the shaft.
    track.shaft_n = friction_limit_n(path, inserted_mm(path, depth_mm, track), track);
    track.falling_n += held_n - force.tip_n - track.shaft_n;
    track.damper_n = 0.0;
  } else {
    slide(path, depth_mm, track);
  }

  // On how fast the springs load: zero while the needle cuts and slides, whatever its speed.
  const double elastic_n = force.tip_n + track.shaft_n;
  const bool springs_load = track.begun && !force.ruptured && !track.exchanged;
  const double change_n = springs_load ? elastic_n - track.last_elastic_n : 0.0;
  if (track.exchanged && track.begun && !force.ruptured) track.falling_n += track.last_elastic_n - elastic_n;
  track.exchanged = false;
  track.damper_n = damper_.advance(track.damper_n, change_n);

  force.shaft_n = track.shaft_n;
  force.falling_n = track.falling_n;
  force.damper_n = track.damper_n;
  force.axial_n = elastic_n + track.falling_n + track.damper_n;
  // A surface that was only touched never pulls.
  if (track.opened == 0) force.axial_n = std::max(0.0, force.axial_n);

  const double most_fall_n = kMostFallNS * settings_.tick_s;
  track.falling_n -= std::clamp(falling_share_ * track.falling_n, -most_fall_n, most_fall_n);
  track.last_elastic_n = elastic_n;
  track.last_depth_mm = depth_mm;
  track.begun = true;
  return force;
}

}  // namespace seldinger::haptics
