// Metrics of the probe while the needle is advanced: how far the picture's plane went, and what the hand did to it.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "assessment/metrics/plane.h"
#include "assessment/metrics/tables.h"
#include "assessment/signals/signals.h"

namespace seldinger::assessment {
namespace {

constexpr double kProbePlayMm = 1.0, kProbePlayDeg = 1.0;  // to and fro by less is a hand that holds still
constexpr double kAlongCosine = 0.5;                       // the tip went along the needle, by 60°
constexpr double kOnsetSeconds = 0.1;                      // of what came after a rest

// When the tip came on along the needle in tissue, by rising time.
std::vector<TimeSpan> advancing(const Signals& signals) {
  std::vector<TimeSpan> spans;
  for (std::size_t i = 1; i < signals.way.size(); ++i) {
    const WayPoint &from = signals.way[i - 1], &to = signals.way[i];
    if (to.first || to.rest || !(from.depth_mm > 0.0) || !(to.depth_mm > 0.0)) continue;
    const glm::dvec3 gone_mm = to.lps_mm - from.lps_mm;
    if (glm::dot(gone_mm, to.needle_direction) > kAlongCosine * glm::length(gone_mm))
      spans.push_back({to.t_s - from.t_s > kRestSeconds ? to.t_s - kOnsetSeconds : from.t_s, to.t_s});
  }
  return spans;
}

// The way of what is dragged along by a lead of `play` behind what moves. It moves as far as the room and the
// tissue under it both say so: a probe at rest on skin that breathes does not, nor one that goes along with it.
class Dragged {
 public:
  explicit Dragged(double play) : play_(play) {}
  void move_by(const glm::dvec3& in_room, const glm::dvec3& in_tissue) {
    room_ += in_room;
    tissue_ += in_tissue;
    if (std::min(glm::length(room_), glm::length(tissue_)) >= kTraceMm) pause();
  }
  // What comes next is another motion.
  void pause() {
    if (glm::dot(room_, tissue_) > 0.0) {
      lead_ += glm::length(room_) < glm::length(tissue_) ? room_ : tissue_;
      const double length = glm::length(lead_);
      if (length > play_) {
        way_ += length - play_;
        lead_ *= play_ / length;
      }
    }
    room_ = tissue_ = glm::dvec3(0.0);
  }
  // Nothing is known of the time before.
  void begin() { room_ = tissue_ = lead_ = glm::dvec3(0.0); }
  double way() const { return way_; }

 private:
  double play_, way_ = 0.0;
  glm::dvec3 room_{0.0}, tissue_{0.0}, lead_{0.0};
};

// A place in the picture: below the probe's face, and beside its middle.
struct InPicture {
  double depth_mm = 0.0, beside_mm = 0.0;
};
InPicture in_picture(const Step& step, const glm::dvec3& p) {
  const glm::dvec3 from_face = p - step.probe_from_lps_mm;
  return {std::max(0.0, glm::dot(from_face, step.probe_axial_from)), glm::dot(from_face, step.probe_lateral_from)};
}

struct Probe {
  double drift_mm = 0.0, shift_mm = 0.0, turn_deg = 0.0;
  bool no_plane = false;
};

// How far a place in the picture went across its plane.
glm::dvec3 across(const Step& step, const InPicture& at, const glm::dvec3& normal, const glm::dvec3& tissue_mm) {
  const glm::dvec3 went_mm = step.probe_to_lps_mm - step.probe_from_lps_mm +
                             at.depth_mm * (step.probe_axial_to - step.probe_axial_from) +
                             at.beside_mm * (step.probe_lateral_to - step.probe_lateral_from) - tissue_mm;
  return {glm::dot(normal, went_mm), 0.0, 0.0};
}

// As a rotation vector, in degrees.
glm::dvec3 turned_deg(const Step& step) {
  const glm::dvec3 normal_from = glm::cross(step.probe_axial_from, step.probe_lateral_from),
                   normal_to = glm::cross(step.probe_axial_to, step.probe_lateral_to);
  return 0.5 * 180.0 / std::numbers::pi *
         (glm::cross(step.probe_axial_from, step.probe_axial_to) +
          glm::cross(step.probe_lateral_from, step.probe_lateral_to) + glm::cross(normal_from, normal_to));
}

Probe probe_while_advancing(const Signals& signals) {
  Dragged at_tip(kProbePlayMm), at_target(kProbePlayMm), face(kProbePlayMm), axes(kProbePlayDeg);
  Probe probe;
  const std::vector<TimeSpan> spans = advancing(signals);
  auto span = spans.begin();
  for (const Step& step : signals.steps) {
    if (step.first)
      for (Dragged* one : {&at_tip, &at_target, &face, &axes}) one->begin();
    const double middle_s = step.t_s + 0.5 * step.length_s;
    while (span != spans.end() && span->to_s < middle_s) ++span;
    if (span == spans.end() || middle_s < span->from_s) {
      for (Dragged* one : {&at_tip, &at_target, &face, &axes}) one->pause();
      continue;
    }
    const auto normal =
        plane_normal(step.probe_axial_from + step.probe_axial_to, step.probe_lateral_from + step.probe_lateral_to);
    if (!plane_normal(step.probe_axial_from, step.probe_lateral_from) || !normal) {
      probe.no_plane = true;
      return probe;
    }
    // What breath did to the tissue at the tip, in this step and until now.
    const glm::dvec3 displaced_mm = step.from_lps_mm - step.rest_from_lps_mm;
    const glm::dvec3 tissue_mm = step.to_lps_mm - step.rest_to_lps_mm - displaced_mm;
    const auto drags = [&](Dragged& one, const glm::dvec3& p) {
      const InPicture at = in_picture(step, p);
      one.move_by(across(step, at, *normal, glm::dvec3(0.0)), across(step, at, *normal, tissue_mm));
    };
    drags(at_tip, step.from_lps_mm);
    if (signals.setting.target) drags(at_target, signals.setting.target->center_lps_mm + displaced_mm);
    const glm::dvec3 slid_mm = step.probe_to_lps_mm - step.probe_from_lps_mm, turned = turned_deg(step);
    face.move_by(slid_mm, slid_mm - tissue_mm);
    axes.move_by(turned, turned);
  }
  for (Dragged* one : {&at_tip, &at_target, &face, &axes}) one->pause();
  probe.drift_mm = std::max(at_tip.way(), at_target.way());
  probe.shift_mm = face.way();
  probe.turn_deg = axes.way();
  return probe;
}

template <double Probe::*part>
Measured measured(const Signals& signals) {
  const Probe probe = probe_while_advancing(signals);
  return probe.no_plane ? Measured::none("no_picture_plane") : Measured::of(probe.*part);
}

// How deep below the probe's face, along its axis, the target lay when the skin was punctured for the first time.
// Where breath has the target just then is not known: it lies as in the CT.
Measured probe_suits(const Signals& signals) {
  const PunctureCounts counts = count_punctures(signals);
  if (counts.punctures == 0) return Measured::none("never_punctured");
  const cases::PoseSample& pose = signals.poses[counts.first_pose];
  const double depth_mm =
      glm::dot(signals.setting.target->center_lps_mm - pose.probe_origin_lps_mm, pose.probe_axial);
  const auto& [from_mm, to_mm] = *signals.setting.probe_suits;
  return Measured::of(depth_mm >= from_mm && depth_mm <= to_mm ? 1.0 : 0.0);
}

constexpr Needs kOfProbe = kPicturePlane | kSkin | kPictures | kInPlane | kMotion | kTissue | kFreehand;
constexpr std::uint32_t kProbeLaws =
    kInAnyFrame | kMirrored | kIdleBefore | kIdleAfter | kOneDarkFrame | kLostSamples | kNothingIsNothing;

constexpr MetricInfo kProbeMetrics[] = {
    {"probe_suits", 1, "bool", "Probe that suits", Group::picture, Direction::higher_is_better,
     kUltrasound | kTarget | kSkin | kMotion | kProbeChosen,
     "1 where the chosen probe suits the target's depth, else 0: when the skin was first punctured, the target's "
     "middle lay at most 50 mm below a linear probe's face, at least 25 mm below a curved one's, along its axis. "
     "Null: never_punctured.",
     "teaching texts take a linear probe down to about 5 cm; our judgement nearer", &probe_suits, kProportion,
     kInAnyFrame | kMirrored | kIdleBefore | kIdleAfter | kOneDarkFrame | kNothingIsNothing},
    {"probe_drift_advancing", 2, "mm", "Probe drift advancing", Group::picture, Direction::lower_is_better,
     kOfProbe,
     "How far the picture's plane moved, at right angles to itself, at the tip or at the target's centre, "
     "whichever is more, while the needle advanced in tissue; a tilt counts with its depth. Moving to and fro by "
     "under 1 mm is not drift, nor is a probe at rest on a patient who breathes or one that moves with the skin: "
     "only movement both in the room and in the tissue at the tip counts. Null: no_picture_plane.",
     kSites, &measured<&Probe::drift_mm>, kMedianRatio, kProbeLaws,
     "1: the path of the middle of the probe's face in the room, so that no tilt counted, while the needle went "
     "at more than 2 mm/s, also under a needle guide."},
    {"probe_shift_advancing", 1, "mm", "Probe shift advancing", Group::picture, Direction::lower_is_better,
     kOfProbe,
     "The part of probe_drift_advancing's motion that slides: path of the middle of the probe's face over the "
     "skin, in any direction, while the needle advanced in tissue; counted in the same way. Null: "
     "no_picture_plane.",
     kSites, &measured<&Probe::shift_mm>, kMedianRatio, kProbeLaws},
    {"probe_turn_advancing", 1, "deg", "Probe turn advancing", Group::picture, Direction::lower_is_better, kOfProbe,
     "The part that turns: by how much the probe was tilted, rocked or rotated while the needle advanced in "
     "tissue; turning to and fro by under 1° does not count. Null: no_picture_plane.",
     kSites, &measured<&Probe::turn_deg>, kMedianRatio, kProbeLaws},
};

}  // namespace

std::span<const MetricInfo> probe_metrics() {
  return kProbeMetrics;
}

}  // namespace seldinger::assessment
