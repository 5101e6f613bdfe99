// What metrics measure: the poses and frames of one attempt from the first row to the endpoint, each pose with its
// place relative to the skin. Made once per attempt from a recording or a pose file.
#pragma once

#include <optional>
#include <vector>

#include "sim/base/result.h"
#include "sim/case/case.h"
#include "sim/case/recording.h"
#include "sim/case/skin_passage.h"

namespace seldinger::assessment {

constexpr double kTimeTolerance_s = 1e-6;  // decimal time stamps are not exact
constexpr double kGapSeconds = 0.25;       // a longer silence of the tracker is not bridged (assessment.md §8)

// What is fixed about an attempt.
struct AttemptSetting {
  const cases::MeshIndex* skin = nullptr;
  std::optional<cases::Lesion> target;
  cases::Instrument instrument;
  cases::Modality modality = cases::Modality::mpr;
  cases::Approach approach = cases::Approach::in_plane;
};

struct Signals {
  AttemptSetting setting;
  std::vector<cases::PoseSample> poses;      // strictly increasing in time
  std::vector<cases::SkinPassage> passages;  // one per pose
  std::vector<cases::FrameTruth> frames;     // strictly increasing in time
  std::optional<cases::Endpoint> endpoint;

  // Interval i runs from pose i to pose i + 1; a gap belongs to no denominator.
  double interval_s(std::size_t i) const { return poses[i + 1].t_s - poses[i].t_s; }
  bool gap(std::size_t i) const { return interval_s(i) > kGapSeconds + kTimeTolerance_s; }
  // Along the needle from where it entered the skin to the tip; 0 outside.
  double inserted_mm(std::size_t i) const;
  // Whether nothing is known between any two poses.
  bool only_gaps() const {
    for (std::size_t i = 0; i + 1 < poses.size(); ++i)
      if (!gap(i)) return false;
    return poses.size() > 1;
  }
};

// Poses and frames after the endpoint are left out. Refused: `bad_poses` (none, times not increasing, a number not
// finite, a direction not near unit length).
base::Result<Signals> make_signals(const AttemptSetting& setting, const cases::Recording& recording);

}  // namespace seldinger::assessment
