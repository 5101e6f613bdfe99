// Metrics of how the needle was advanced in tissue under a picture: what of it was seen, and at what angle to it.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include "assessment/metrics/plane.h"
#include "assessment/metrics/tables.h"
#include "assessment/signals/signals.h"

namespace seldinger::assessment {
namespace {

constexpr double kBeyondMm = 3.0;      // docs/clinical.md, out-of-plane
constexpr double kSightSeconds = 0.2;  // of the tip, until an unseen advance is over: a flicker is no sight

struct Seen {
  double advance_mm = 0.0, visible_mm = 0.0;
  BlindRun longest_blind;
  std::optional<double> blind_s;  // when a blind run was first longer than was asked for
};

// Whether pictures show the tip, and for how long they have.
class Sight {
 public:
  // The picture since `t_s`.
  void picture(double t_s, bool visible) {
    if (visible && !visible_) since_s_ = t_s;
    if (!visible && visible_) ended_ = ended_ || lasts(t_s);
    visible_ = visible;
  }
  void gap(double seconds) { since_s_ += seconds; }  // is no sight
  bool visible() const { return visible_; }
  // Whether it had lasted kSightSeconds by then, now or since last asked.
  bool seen(double t_s) {
    const bool seen = ended_ || (visible_ && lasts(t_s));
    ended_ = false;
    return seen;
  }

 private:
  bool lasts(double t_s) const { return t_s - since_s_ >= kSightSeconds - kTimeTolerance_s; }
  double since_s_ = 0.0;
  bool visible_ = false, ended_ = false;
};

// What a picture showed counts for the step of the way that began with it.
Seen seen_advance(const Signals& signals, double blind_run_mm = 0.0) {
  Seen seen;
  BlindRun blind;
  Sight sight;
  std::size_t next_frame = 0;
  for (std::size_t i = 1; i < signals.poses.size(); ++i) {
    const double from_s = signals.poses[i - 1].t_s;
    const bool after_gap = i > 1 && signals.gap(i - 2);  // what a picture showed in it is seen from its end on
    for (; next_frame < signals.frames.size() && signals.frames[next_frame].t_s <= from_s; ++next_frame) {
      const cases::FrameTruth& frame = signals.frames[next_frame];
      sight.picture(after_gap ? from_s : frame.t_s, frame.live && frame.needle_tip);
    }
    if (sight.seen(from_s)) blind = {};
    if (signals.gap(i - 1)) sight.gap(signals.interval_s(i - 1));
    const double advance_mm = signals.advance_mm[i];
    seen.advance_mm += advance_mm;
    if (sight.visible()) {
      seen.visible_mm += advance_mm;
    } else if (advance_mm > 0.0) {
      if (blind.length_mm == 0.0) blind.from_s = from_s;
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

struct PlaneAngle {
  double mean_deg = 0.0, max_deg = 0.0;
  const char* reason = nullptr;
};
PlaneAngle plane_angle(const Signals& signals) {
  PlaneAngle angle;
  double advance_mm = 0.0;
  for (std::size_t i = 0; i < signals.poses.size(); ++i) {
    if (!(signals.advance_mm[i] > 0.0)) continue;
    const auto normal = plane_normal(signals.poses[i].probe_axial, signals.poses[i].probe_lateral);
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
    const auto normal = plane_normal(signals.poses[i].probe_axial, signals.poses[i].probe_lateral);
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

constexpr Needs kUnderProbe = kPicturePlane | kSkin | kPictures;
// Under a needle guide the angle to the plane is the guide's, and the guide holds the probe: kFreehand. What a
// picture showed of the advance stays the trainee's, who may still look away, freeze it or leave the field, and
// would else be spared a blind advance by taking up the guide.
constexpr std::uint32_t kSame =
    kInAnyFrame | kMirrored | kIdleBefore | kIdleAfter | kAtAnySpeed | kOneDarkFrame | kLostSamples;
constexpr const char* kByTissue =
    "1: how far the tip advanced in the tissue, so that breath that slid past a resting hand was advance; 2: "
    "without the first 1 mm of a further puncture.";
constexpr const char* kByTissueSeen =
    "1: how far the tip advanced in the tissue, so that breath that slid past a resting hand was advance; 2: "
    "without the first 1 mm of a further puncture; 3" SELDINGER_BY_HALF_SLICE " 4" SELDINGER_WITHOUT_CLUTTER
    " 5" SELDINGER_AT_ANY_TILT;
constexpr const char* kByTissueGuided =
    "1: how far the tip advanced in the tissue, so that breath that slid past a resting hand was advance; also "
    "under a needle guide; 2: without the first 1 mm of a further puncture.";

constexpr MetricInfo kAdvanceMetrics[] = {
    {"advance_visible_share", 6, "share", "Advance visible", Group::picture, Direction::higher_is_better,
     kUnderProbe | kInPlane,
     "Share of the length by which the hand advanced the tip in tissue while a live picture showed it; moving to "
     "and fro by under 1 mm is not an advance, nor is breath that slides past a hand at rest (as "
     "withdrawals_partial). A frozen picture shows nothing. Null: under_1_mm_of_advance.",
     "share of needle advancement in plane, BMC Anesthesiol. 2014, PMC4384236", &advance_visible_share,
     kMedianShare, kSame | kNothingIsNothing, kByTissueSeen, kAsksForProbesPicture},
    {"blind_advance", 6, "mm", "Blind advance", Group::picture, Direction::lower_is_better,
     kUnderProbe | kInPlane | kMotion | kTissue,
     "Length that the hand advanced the tip in tissue while no live picture showed it; as "
     "advance_visible_share counts it.",
     kSites, &blind_advance, kMedianRatio, kSame | kNothingIsNothing, kByTissueSeen, kAsksForProbesPicture},
    {"blind_advance_max", 6, "mm", "Longest blind advance", Group::picture, Direction::lower_is_better,
     kUnderProbe | kInPlane | kMotion | kTissue,
     "Longest part of blind_advance from one sight of the tip to the next; a sight lasts 0.2 s or longer, as a "
     "flicker shows nobody where the tip is. A tracking gap neither adds nor ends it.",
     kSites, &blind_advance_max, kMedianRatio,
     kInAnyFrame | kMirrored | kIdleBefore | kIdleAfter | kNothingIsNothing,
     "1: as blind_advance's version 1; one picture of the tip, and a gap, ended it; 2: as blind_advance's version "
     "2; a picture of the tip in a gap could end it; 3" SELDINGER_BY_HALF_SLICE " 4" SELDINGER_WITHOUT_CLUTTER
     " 5" SELDINGER_AT_ANY_TILT,
     kAsksForProbesPicture},
    {"plane_angle_mean", 3, "deg", "Mean angle to plane", Group::picture, Direction::lower_is_better,
     kUnderProbe | kInPlane | kMotion | kFreehand,
     "Angle between needle and picture plane, averaged over the length by which the hand advanced the tip in "
     "tissue. "
     "Null: under_1_mm_of_advance, no_picture_plane.",
     "NeedlePlaneAngle of TrainUS (Ebatinca), over length instead of time", &plane_angle_mean, kMedianInterval,
     kSame | kNothingIsNothing, kByTissueGuided},
    {"plane_angle_max", 3, "deg", "Largest angle to plane", Group::picture, Direction::lower_is_better,
     kUnderProbe | kInPlane | kMotion | kFreehand, "As plane_angle_mean, the largest. Null: as plane_angle_mean.",
     "NeedlePlaneAngle of TrainUS (Ebatinca)", &plane_angle_max, kMedianInterval, kSame | kNothingIsNothing,
     kByTissueGuided},
    {"advance_beyond_plane", 3, "mm", "Advance beyond plane", Group::picture, Direction::lower_is_better,
     kUnderProbe | kOutOfPlane | kMotion | kTissue,
     "Length that the hand advanced the tip in tissue while it was more than 3 mm beyond the picture's plane, "
     "on the side to which the needle points: out of plane, the probe goes first and the tip follows into the "
     "picture. Null: no_picture_plane.",
     "dynamic needle tip positioning: Clemmesen et al., Ultraschall Med. 33 (2012) E321", &advance_beyond_plane,
     kMedianRatio, kSame | kNothingIsNothing, kByTissue},
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
