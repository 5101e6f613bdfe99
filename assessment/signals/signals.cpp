#include "assessment/signals/signals.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "assessment/signals/pushed.h"
#include "sim/base/vectors.h"

namespace seldinger::assessment {
namespace {

// What follows within this adds nothing to a hand's motion: faster streams are thinned, at most to 200 poses a
// second.
constexpr double kDenseSeconds = 0.005;
constexpr double kLowShare = 0.05;                    // of the time, sampled more slowly than sample_rate_p5
constexpr double kFarAwayMm = 1e5;                    // outside of any patient
constexpr double kFarthestMm = 1e6, kLongestS = 1e7;  // no arm reaches so far, no attempt lasts so long

bool near_unit(const glm::dvec3& v) {
  const double length2 = glm::dot(v, v);
  return length2 > 0.98 && length2 < 1.02;  // six decimals in a text file keep a unit vector well inside
}

// A surface that faces inwards, or none that can tell in from out.
bool everything_is_inside(const cases::MeshIndex& skin) {
  if (skin.empty()) return false;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-kFarAwayMm, kFarAwayMm}) {
      glm::dvec3 away(0.0);
      away[axis] = side;
      if (skin.closest(away).distance_mm > 0.0) return false;
    }
  return true;
}

base::Result<void> check(const AttemptSetting& setting) {
  if (everything_is_inside(*setting.skin))
    return base::Error{"bad_skin", "the skin's surface does not tell inside from outside"};
  if (setting.target && !(base::is_finite(setting.target->center_lps_mm) &&
                          std::isfinite(setting.target->radius_mm) && setting.target->radius_mm > 0.0))
    return base::Error{"bad_target", "the target is no sphere"};
  if (setting.plan && !(base::is_finite(setting.plan->entry_lps_mm) && near_unit(setting.plan->direction)))
    return base::Error{"bad_plan", "the planned entry is no point with a direction"};
  return {};
}

// What is wrong with a pose; nothing when it is sound.
const char* wrong_with(const cases::PoseSample& pose) {
  if (!(std::isfinite(pose.t_s) && base::is_finite(pose.tip_lps_mm) && base::is_finite(pose.tip_at_rest_lps_mm()) &&
        base::is_finite(pose.needle_direction) && base::is_finite(pose.probe_origin_lps_mm) &&
        base::is_finite(pose.probe_axial) && base::is_finite(pose.probe_lateral)))
    return " holds a number that is not finite";
  // Squares of what is much more would not be finite.
  for (const glm::dvec3& point : {pose.tip_lps_mm, pose.tip_at_rest_lps_mm(), pose.probe_origin_lps_mm})
    for (int axis = 0; axis < 3; ++axis)
      if (std::abs(point[axis]) > kFarthestMm) return " holds a place more than a kilometre away";
  if (std::abs(pose.t_s) > kLongestS) return " holds a time beyond 10 000 000 s";
  if (!near_unit(pose.needle_direction) || !near_unit(pose.probe_axial) || !near_unit(pose.probe_lateral))
    return " holds a direction that is not of unit length";
  return nullptr;
}

// How often poses came, asked 100 times a second, so that a burst is not more than its time.
class RateMeter {
 public:
  void interval(double from_s, double to_s) {
    if (to_s - from_s > kGapSeconds + kTimeTolerance_s) {
      next_s_ = to_s;
      return;
    }
    for (next_s_ = std::max(next_s_, from_s); next_s_ < to_s; next_s_ += 1.0 / kMotionRateHz)
      intervals_s_.push_back(to_s - from_s);
  }
  std::optional<double> p5_hz() {
    if (intervals_s_.empty()) return std::nullopt;
    const auto rank = static_cast<std::ptrdiff_t>((1.0 - kLowShare) * static_cast<double>(intervals_s_.size() - 1));
    std::nth_element(intervals_s_.begin(), intervals_s_.begin() + rank, intervals_s_.end());
    return 1.0 / intervals_s_[static_cast<std::size_t>(rank)];
  }

 private:
  double next_s_ = -1e300;
  std::vector<double> intervals_s_;
};

// Poses up to the endpoint, thinned; the last before a silence stays.
base::Result<void> take_poses(const cases::Recording& recording, Signals& signals) {
  RateMeter rate;
  const cases::PoseSample* before = nullptr;  // the last one read
  const auto far_from_kept = [&](const cases::PoseSample& pose) {
    return signals.poses.empty() || pose.t_s - signals.poses.back().t_s > kDenseSeconds + kTimeTolerance_s;
  };
  for (std::size_t i = 0; i < recording.poses.size(); ++i) {
    const cases::PoseSample& pose = recording.poses[i];
    const char* wrong = wrong_with(pose);
    if (wrong == nullptr && before != nullptr && pose.t_s < before->t_s) wrong = " is earlier than the one before";
    if (wrong != nullptr) return base::Error{"bad_poses", "pose " + std::to_string(i + 1) + wrong};
    if (recording.endpoint && pose.t_s > recording.endpoint->t_s) break;
    if (before != nullptr && pose.t_s == before->t_s) continue;  // a repeated time stamp adds nothing
    if (before != nullptr) {
      rate.interval(before->t_s, pose.t_s);
      const bool silence = pose.t_s - before->t_s > kGapSeconds + kTimeTolerance_s;
      if (silence && before->t_s > signals.poses.back().t_s) signals.poses.push_back(*before);
    }
    if (far_from_kept(pose)) signals.poses.push_back(pose);
    before = &pose;
  }
  if (before == nullptr) return base::Error{"bad_poses", "there is no pose"};
  if (before->t_s > signals.poses.back().t_s) signals.poses.push_back(*before);
  signals.sample_rate_p5_hz = rate.p5_hz();
  // The endpoint is the last pose also where the trigger fell between two samples. A core needle's throw, in the
  // same tick, is not part of the way to it.
  if (recording.endpoint) {
    cases::PoseSample last = signals.poses.back();
    last.t_s = recording.endpoint->t_s;
    last.tip_lps_mm = recording.endpoint->tip_lps_mm;
    last.rest_tip_lps_mm = recording.endpoint->rest_tip_lps_mm;
    last.needle_direction = recording.endpoint->direction;
    if (last.t_s > signals.poses.back().t_s)
      signals.poses.push_back(last);
    else
      signals.poses.back() = last;
    if (const char* wrong = wrong_with(last)) return base::Error{"bad_poses", std::string("the endpoint") + wrong};
  }
  return {};
}

base::Result<void> take_forces(std::span<const cases::ForceSample> forces, Signals& signals) {
  for (std::size_t i = 0; i < forces.size(); ++i) {
    const cases::ForceSample& force = forces[i];
    if (!(std::isfinite(force.t_s) && std::isfinite(force.needle_axial_n) && std::isfinite(force.needle_lateral_n)))
      return base::Error{"bad_forces", "force " + std::to_string(i + 1) + " holds a number that is not finite"};
    if (i > 0 && force.t_s < forces[i - 1].t_s)
      return base::Error{"bad_forces", "force " + std::to_string(i + 1) + " is earlier than the one before"};
    if (signals.endpoint && force.t_s > signals.endpoint->t_s) break;
    signals.forces.push_back(force);
  }
  return {};
}

std::vector<cases::SkinPassage> passages_of(const cases::MeshIndex& skin,
                                            std::span<const cases::PoseSample> poses) {
  std::vector<cases::SkinPassage> passages;
  passages.reserve(poses.size());
  for (const cases::PoseSample& pose : poses) {
    if (passages.empty()) {
      passages.push_back(cases::start_passage(skin, pose.tip_at_rest_lps_mm(), pose.needle_direction));
      continue;
    }
    cases::SkinPassage passage = passages.back();
    cases::advance_passage(skin, pose.tip_at_rest_lps_mm(), passage);
    passages.push_back(passage);
  }
  return passages;
}

Aftermath aftermath_of(const Signals& signals, const cases::Recording& recording) {
  Aftermath after;
  if (!signals.endpoint) return after;
  cases::SkinPassage passage = signals.passages.back();
  if (!passage.in_body) after.needle_out_s = signals.endpoint->t_s;
  for (const cases::PoseSample& pose : recording.poses) {
    if (after.needle_out_s) break;
    if (pose.t_s <= signals.endpoint->t_s) continue;
    cases::advance_passage(*signals.setting.skin, pose.tip_at_rest_lps_mm(), passage);
    if (!passage.in_body) after.needle_out_s = pose.t_s;
  }
  for (const cases::FrameTruth& frame : recording.frames)
    if (!after.scanned_s && after.needle_out_s && frame.t_s > *after.needle_out_s && frame.live && frame.target)
      after.scanned_s = frame.t_s;
  return after;
}

}  // namespace

double Signals::inserted_mm(std::size_t i) const {
  const cases::SkinPassage& skin = passages[i];
  return skin.in_body ? std::max(0.0, glm::dot(skin.tip_lps_mm - skin.entry_lps_mm, poses[i].needle_direction))
                      : 0.0;
}

base::Result<Signals> make_signals(const AttemptSetting& setting, const cases::Recording& recording) {
  CHECK(setting.skin != nullptr);
  if (auto sound = check(setting); !sound) return sound.error();
  Signals signals;
  signals.setting = setting;
  signals.endpoint = recording.endpoint;
  if (auto taken = take_poses(recording, signals); !taken) return taken.error();
  if (auto taken = take_forces(recording.forces, signals); !taken) return taken.error();
  for (const cases::FrameTruth& frame : recording.frames) {
    if (!std::isfinite(frame.t_s)) return base::Error{"bad_frames", "a frame's time is not finite"};
    if (recording.endpoint && frame.t_s > recording.endpoint->t_s) break;
    if (signals.frames.empty() || frame.t_s > signals.frames.back().t_s) signals.frames.push_back(frame);
  }
  signals.events = recording.events;
  for (const cases::Event& event : signals.events.value_or(std::vector<cases::Event>{}))
    if (!std::isfinite(event.t_s)) return base::Error{"bad_events", "an event's time is not finite"};
  const auto by_program =
      program_moves(signals.poses, signals.events ? std::span<const cases::Event>(*signals.events)
                                                  : std::span<const cases::Event>());
  signals.tracking = mend(by_program, signals.poses, signals.gaps);
  signals.passages = passages_of(*setting.skin, signals.poses);
  signals.pushed_mm = pushed_mm_of(signals);
  signals.advance_mm = advances_of(signals);
  signals.steps = steps_of(signals);
  signals.way = way_of(signals);
  signals.trace = trace_of(signals);
  signals.after = aftermath_of(signals, recording);
  return signals;
}

}  // namespace seldinger::assessment
