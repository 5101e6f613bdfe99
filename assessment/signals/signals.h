// What metrics measure: the poses, frames and forces of one attempt from the first row to the endpoint, each pose
// with its place relative to the skin, and the filtered way that they make. Made once per attempt from a recording
// or a pose file.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "assessment/signals/motion.h"
#include "assessment/signals/needs.h"
#include "assessment/signals/tracking.h"
#include "assessment/signals/way.h"
#include "sim/base/result.h"
#include "sim/case/case.h"
#include "sim/case/probe_depths.h"
#include "sim/case/record/recording.h"
#include "sim/case/skin_passage.h"
#include "sim/case/structure.h"

namespace seldinger::assessment {

constexpr double kTimeTolerance_s = 1e-6;  // decimal time stamps are not exact
constexpr double kGapSeconds = 0.25;       // a longer silence of the tracker is not bridged (our judgement)

// Where the needle was to enter the skin, and how.
struct PlannedEntry {
  glm::dvec3 entry_lps_mm{0.0};
  glm::dvec3 direction{0.0, 0.0, 1.0};  // unit, into the body
};

// What is fixed about an attempt. What it points to outlives the signals.
struct AttemptSetting {
  const cases::MeshIndex* skin = nullptr;
  std::optional<cases::Lesion> target{};
  cases::Instrument instrument{};
  cases::Modality modality = cases::Modality::mpr;
  cases::Approach approach = cases::Approach::in_plane;
  std::optional<PlannedEntry> plan{};
  std::span<const cases::Structure> structures{};
  cases::Subject subject = cases::Subject::patient;
  cases::PatientPosition position = cases::PatientPosition::supine;  // which way a fluoroscope's angles look
  std::optional<bool> defer_is_right{};                              // what the case has to be decided
  cases::SightLaw sight_law = cases::kNewestSightLaw;                // by which the frames were told
  std::optional<double> table_mm{};       // how high, upwards, what the patient lies on is; nothing: not known
  bool breathes = false, yields = false;  // what moves the case's tissue
  std::optional<cases::DepthRange> probe_suits{};  // where whoever attempted it chose the probe
  bool target_cannot_show = false;                 // in no picture of the case (target_view.h)
};

inline Manner manner_of(const AttemptSetting& setting) {
  return {setting.modality, setting.approach, setting.instrument.kind};
}

// What was done after the endpoint: when the tip left the skin (it may never have been in), and when a picture then
// showed the target.
struct Aftermath {
  std::optional<double> needle_out_s, scanned_s;
};

struct Signals {
  AttemptSetting setting;
  std::vector<cases::PoseSample> poses;      // strictly increasing in time, at most 200 a second; repaired
  std::vector<Gap> gaps;                     // one per pose: what is between it and the next
  std::vector<cases::SkinPassage> passages;  // one per pose
  std::vector<double> pushed_mm;             // one per pose: how deep the hand has pushed the needle
  std::vector<double> advance_mm;            // one per pose: how far that came beyond where it had been (below)
  std::vector<cases::FrameTruth> frames;     // strictly increasing in time
  std::vector<cases::ForceSample> forces;    // empty: no device
  // Of the whole recording, after the endpoint too; nothing: it was not listened to.
  std::optional<std::vector<cases::Event>> events;
  Aftermath after;
  std::optional<cases::Endpoint> endpoint;
  std::optional<double> sample_rate_p5_hz;  // 95 % of the time was sampled at least so often; gaps not counted
  Tracking tracking;
  std::vector<Step> steps;          // the tools' way, filtered
  std::vector<WayPoint> way;        // the tip's, without what trembles
  std::vector<TraceSegment> trace;  // the tip's way without its tremor

  // Interval i runs from pose i to pose i + 1; a gap belongs to no denominator.
  double interval_s(std::size_t i) const { return poses[i + 1].t_s - poses[i].t_s; }
  bool gap(std::size_t i) const { return gaps[i] != Gap::none; }
  // Along the needle from where it entered the skin to the tip; 0 outside.
  double inserted_mm(std::size_t i) const;
  // Whether nothing is known between any two poses.
  bool only_gaps() const {
    for (std::size_t i = 0; i + 1 < poses.size(); ++i)
      if (!gap(i)) return false;
    return poses.size() > 1;
  }
};

// advance_mm: to and fro by less than this is no advance.
constexpr double kJiggleMm = 1.0;

// Poses, frames and forces after the endpoint are left out. Refused: `bad_poses` (none, times not increasing, a
// number not finite, a direction not near unit length), `bad_forces` (as poses), `bad_frames` and
// `bad_events` (a time not finite), `bad_target` (no sphere), `bad_plan`, `bad_skin` (its surface faces inwards, so
// that everything far away would be in the body).
base::Result<Signals> make_signals(const AttemptSetting& setting, const cases::Recording& recording);

}  // namespace seldinger::assessment
