#include "assessment/signals.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/base/vectors.h"

namespace seldinger::assessment {
namespace {

bool near_unit(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0.99 && length < 1.01;  // six decimals in a text file keep a unit vector well inside
}

}  // namespace

double Signals::inserted_mm(std::size_t i) const {
  const cases::SkinPassage& skin = passages[i];
  return skin.in_body ? std::max(0.0, glm::dot(skin.tip_lps_mm - skin.entry_lps_mm, poses[i].needle_direction))
                      : 0.0;
}

base::Result<Signals> make_signals(const AttemptSetting& setting, const cases::Recording& recording) {
  CHECK(setting.skin != nullptr);
  Signals signals;
  signals.setting = setting;
  signals.endpoint = recording.endpoint;
  for (std::size_t i = 0; i < recording.poses.size(); ++i) {
    const cases::PoseSample& pose = recording.poses[i];
    const std::string row = "pose " + std::to_string(i + 1);
    if (!(std::isfinite(pose.t_s) && base::is_finite(pose.tip_lps_mm) && base::is_finite(pose.needle_direction) &&
          base::is_finite(pose.probe_origin_lps_mm) && base::is_finite(pose.probe_axial) &&
          base::is_finite(pose.probe_lateral)))
      return base::Error{"bad_poses", row + " holds a number that is not finite"};
    if (!near_unit(pose.needle_direction) || !near_unit(pose.probe_axial) || !near_unit(pose.probe_lateral))
      return base::Error{"bad_poses", row + " holds a direction that is not of unit length"};
    if (!signals.poses.empty() && pose.t_s < signals.poses.back().t_s)
      return base::Error{"bad_poses", row + " is earlier than the one before"};
    if (recording.endpoint && pose.t_s > recording.endpoint->t_s) break;
    // A repeated time stamp adds nothing.
    if (!signals.poses.empty() && pose.t_s == signals.poses.back().t_s) continue;
    signals.poses.push_back(pose);
    // A core needle's throw, in the same tick, is not part of the way to the endpoint.
    if (recording.endpoint && pose.t_s == recording.endpoint->t_s) {
      signals.poses.back().tip_lps_mm = recording.endpoint->tip_lps_mm;
      signals.poses.back().needle_direction = recording.endpoint->direction;
    }
  }
  if (signals.poses.empty()) return base::Error{"bad_poses", "there is no pose"};
  // The endpoint is the last pose also where the trigger fell between two samples.
  if (recording.endpoint && recording.endpoint->t_s > signals.poses.back().t_s) {
    cases::PoseSample last = signals.poses.back();
    last.t_s = recording.endpoint->t_s;
    last.tip_lps_mm = recording.endpoint->tip_lps_mm;
    last.needle_direction = recording.endpoint->direction;
    signals.poses.push_back(last);
  }
  signals.passages.reserve(signals.poses.size());
  for (const cases::PoseSample& pose : signals.poses) {
    if (signals.passages.empty()) {
      signals.passages.push_back(cases::start_passage(*setting.skin, pose.tip_lps_mm, pose.needle_direction));
      continue;
    }
    cases::SkinPassage passage = signals.passages.back();
    cases::advance_passage(*setting.skin, pose.tip_lps_mm, passage);
    signals.passages.push_back(passage);
  }
  for (const cases::FrameTruth& frame : recording.frames) {
    if (recording.endpoint && frame.t_s > recording.endpoint->t_s) break;
    if (signals.frames.empty() || frame.t_s > signals.frames.back().t_s) signals.frames.push_back(frame);
  }
  return signals;
}

}  // namespace seldinger::assessment
