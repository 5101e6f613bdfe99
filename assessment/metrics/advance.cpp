// Metrics of how the needle was advanced in tissue under a picture: what of it was seen, and where the probe was.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include "assessment/metrics/tables.h"
#include "assessment/signals/signals.h"

namespace seldinger::assessment {
namespace {

constexpr double kBeyondMm = 3.0;      // clinical.md, out-of-plane
constexpr double kAdvancingMmS = 2.0;  // assessment.md §8, probe_drift_advancing
constexpr double kProbePlayMm = 1.0;   // a probe that breathes with the skin has not drifted
constexpr double kMinPlaneSine = 0.5;  // the probe's axes are perpendicular, or nothing can be said

struct Seen {
  double advance_mm = 0.0, visible_mm = 0.0;
  BlindRun longest_blind;
  std::optional<double> blind_s;  // when a blind run was first longer than was asked for
};

// What a picture showed counts for the step of the way that began with it.
Seen seen_advance(const Signals& signals, double blind_run_mm = 0.0) {
  Seen seen;
  BlindRun blind;
  bool visible = false;
  std::size_t next_frame = 0;
  for (std::size_t i = 1; i < signals.poses.size(); ++i) {
    bool shown = visible;  // by any picture since the step before
    for (; next_frame < signals.frames.size() && signals.frames[next_frame].t_s <= signals.poses[i - 1].t_s;
         ++next_frame) {
      visible = signals.frames[next_frame].live && signals.frames[next_frame].needle_tip;
      shown = shown || visible;
    }
    if (shown || signals.gap(i - 1)) blind.length_mm = 0.0;  // what happened in a gap is not known
    const double advance_mm = signals.advance_mm[i];
    seen.advance_mm += advance_mm;
    if (visible) {
      seen.visible_mm += advance_mm;
    } else if (advance_mm > 0.0) {
      if (blind.length_mm == 0.0) blind.from_s = signals.poses[i - 1].t_s;
      blind.length_mm += advance_mm;
      blind.to_s = signals.poses[i].t_s;
      if (blind.length_mm > seen.longest_blind.length_mm) seen.longest_blind = blind;
      if (!seen.blind_s && blind.length_mm > blind_run_mm) seen.blind_s = signals.poses[i].t_s;
    }
  }
  return seen;
}

Measured advance_visible_share(const Signals& signals) {
  const Seen seen = seen_advance(signals);
  if (!(seen.advance_mm >= kJiggleMm)) return Measured::none("under_1_mm_of_advance");
  return Measured::of(seen.visible_mm / seen.advance_mm);
}

Measured blind_advance(const Signals& signals) {
  const Seen seen = seen_advance(signals);
  return Measured::of(seen.advance_mm - seen.visible_mm);
}

Measured blind_advance_max(const Signals& signals) {
  return Measured::of(seen_advance(signals).longest_blind.length_mm);
}

// Unit normal of the picture's plane; nothing where the probe's axes span none.
std::optional<glm::dvec3> plane_normal(const cases::PoseSample& pose) {
  const glm::dvec3 across = glm::cross(pose.probe_axial, pose.probe_lateral);
  const double sine = glm::length(across);
  if (!(sine >= kMinPlaneSine)) return std::nullopt;
  return across / sine;
}

struct PlaneAngle {
  double mean_deg = 0.0, max_deg = 0.0;
  const char* reason = nullptr;
};
PlaneAngle plane_angle(const Signals& signals) {
  PlaneAngle angle;
  double advance_mm = 0.0;
  for (std::size_t i = 0; i < signals.poses.size(); ++i) {
    if (!(signals.advance_mm[i] > 0.0)) continue;
    const auto normal = plane_normal(signals.poses[i]);
    if (!normal) return {0.0, 0.0, "no_picture_plane"};
    const double sine = std::min(1.0, std::abs(glm::dot(*normal, signals.poses[i].needle_direction)));
    const double deg = std::asin(sine) * 180.0 / std::numbers::pi;
    advance_mm += signals.advance_mm[i];
    angle.mean_deg += deg * signals.advance_mm[i];
    angle.max_deg = std::max(angle.max_deg, deg);
  }
  if (!(advance_mm >= kJiggleMm)) return {0.0, 0.0, "under_1_mm_of_advance"};
  angle.mean_deg /= advance_mm;
  return angle;
}

Measured plane_angle_mean(const Signals& signals) {
  const PlaneAngle angle = plane_angle(signals);
  return angle.reason != nullptr ? Measured::none(angle.reason) : Measured::of(angle.mean_deg);
}

Measured plane_angle_max(const Signals& signals) {
  const PlaneAngle angle = plane_angle(signals);
  return angle.reason != nullptr ? Measured::none(angle.reason) : Measured::of(angle.max_deg);
}

struct Beyond {
  double advance_mm = 0.0;
  bool no_plane = false;
  std::optional<double> first_s;  // when it was first more than was asked for
};
Beyond beyond_plane(const Signals& signals, double more_than_mm = 0.0) {
  Beyond beyond;
  for (std::size_t i = 1; i < signals.poses.size(); ++i) {
    if (!(signals.advance_mm[i] > 0.0)) continue;
    const auto normal = plane_normal(signals.poses[i]);
    if (!normal) {
      beyond.no_plane = true;
      return beyond;
    }
    // The far side is where the needle points to.
    const glm::dvec3 far = glm::dot(*normal, signals.poses[i].needle_direction) < 0.0 ? -*normal : *normal;
    const auto past_mm = [&](const glm::dvec3& tip) {
      return glm::dot(far, tip - signals.poses[i].probe_origin_lps_mm) - kBeyondMm;
    };
    const double to_mm = past_mm(signals.poses[i].tip_lps_mm);
    if (!(to_mm > 0.0)) continue;
    const double from_mm = past_mm(signals.poses[i - 1].tip_lps_mm);
    beyond.advance_mm += signals.advance_mm[i] * (from_mm < 0.0 ? to_mm / (to_mm - from_mm) : 1.0);
    if (!beyond.first_s && beyond.advance_mm > more_than_mm) beyond.first_s = signals.poses[i].t_s;
  }
  return beyond;
}

Measured advance_beyond_plane(const Signals& signals) {
  const Beyond beyond = beyond_plane(signals);
  return beyond.no_plane ? Measured::none("no_picture_plane") : Measured::of(beyond.advance_mm);
}

// The probe is followed by a point that it drags along once it is kProbePlayMm away: the point's way is the drift.
Measured probe_drift_advancing(const Signals& signals) {
  double drift_mm = 0.0;
  glm::dvec3 lead(0.0);  // from the point to the probe
  for (const Step& step : signals.steps) {
    const double speed_mm_s = glm::dot(step.to_lps_mm - step.from_lps_mm, step.needle_direction) / step.length_s;
    const bool advancing = step.depth_from_mm > 0.0 && speed_mm_s > kAdvancingMmS;
    if (step.first) lead = glm::dvec3(0.0);
    if (!advancing) continue;  // the point goes with it
    lead += step.probe_to_lps_mm - step.probe_from_lps_mm;
    const double length_mm = glm::length(lead);
    if (length_mm <= kProbePlayMm) continue;
    drift_mm += length_mm - kProbePlayMm;
    lead *= kProbePlayMm / length_mm;
  }
  return Measured::of(drift_mm);
}

constexpr std::uint32_t kUnderProbe = kPicturePlane | kSkin | kPictures;
// Under a needle guide the angle to the plane is the guide's, and the guide holds the probe: kFreehand. What a
// picture showed of the advance stays the trainee's, who may still look away, freeze it or leave the field, and
// would else be spared a blind advance by taking up the guide.

constexpr MetricInfo kAdvanceMetrics[] = {
    {"advance_visible_share", 1, "share", "Advance visible", Group::picture, Direction::higher_is_better,
     kUnderProbe | kInPlane,
     "Share of the way that the tip advanced in tissue while a live picture showed it; to and fro by under 1 mm is "
     "no "
     "advance. A frozen picture shows nothing. Null: under_1_mm_of_advance.",
     "share of needle advancement in plane, BMC Anesthesiol. 2014, PMC4384236", &advance_visible_share},
    {"blind_advance", 1, "mm", "Blind advance", Group::picture, Direction::lower_is_better,
     kUnderProbe | kInPlane | kMotion | kTissue,
     "Length that the tip advanced in tissue while no live picture showed it; as advance_visible_share counts it.",
     kSites, &blind_advance},
    {"blind_advance_max", 1, "mm", "Longest blind advance", Group::picture, Direction::lower_is_better,
     kUnderProbe | kInPlane | kMotion | kTissue,
     "Longest part of blind_advance from one sight of the tip to the next.", kSites, &blind_advance_max},
    {"plane_angle_mean", 2, "deg", "Mean angle to plane", Group::picture, Direction::lower_is_better,
     kUnderProbe | kInPlane | kMotion | kFreehand,
     "Angle between needle and picture plane, averaged over the way that the tip advanced in tissue. Null: "
     "under_1_mm_of_advance, no_picture_plane.",
     "NeedlePlaneAngle of TrainUS (Ebatinca), over way instead of time", &plane_angle_mean},
    {"plane_angle_max", 2, "deg", "Largest angle to plane", Group::picture, Direction::lower_is_better,
     kUnderProbe | kInPlane | kMotion | kFreehand, "As plane_angle_mean, the largest. Null: as plane_angle_mean.",
     "NeedlePlaneAngle of TrainUS (Ebatinca)", &plane_angle_max},
    {"advance_beyond_plane", 1, "mm", "Advance beyond plane", Group::picture, Direction::lower_is_better,
     kUnderProbe | kOutOfPlane | kMotion | kTissue,
     "Length that the tip advanced in tissue while it was more than 3 mm beyond the picture's plane, on the side "
     "to "
     "which the needle points: out of plane, the probe goes first and the tip follows into the picture. Null: "
     "no_picture_plane.",
     "dynamic needle tip positioning: Clemmesen et al., Ultraschall Med. 33 (2012) E321", &advance_beyond_plane},
    {"probe_drift_advancing", 2, "mm", "Probe drift advancing", Group::picture, Direction::lower_is_better,
     kUnderProbe | kInPlane | kMotion | kTissue | kFreehand,
     "Way of the probe, filtered as path_tip, while the needle in tissue advanced at more than 2 mm/s; to and fro "
     "by "
     "under 1 mm is no drift.",
     kSites, &probe_drift_advancing},
};

}  // namespace

std::optional<double> first_blind_run_s(const Signals& signals, double longer_than_mm) {
  return seen_advance(signals, longer_than_mm).blind_s;
}

std::optional<double> first_beyond_plane_s(const Signals& signals, double more_than_mm) {
  return beyond_plane(signals, more_than_mm).first_s;
}

std::optional<BlindRun> longest_blind_run(const Signals& signals) {
  const BlindRun run = seen_advance(signals).longest_blind;
  return run.length_mm > 0.0 ? std::optional(run) : std::nullopt;
}

std::span<const MetricInfo> advance_metrics() {
  return kAdvanceMetrics;
}

}  // namespace seldinger::assessment
