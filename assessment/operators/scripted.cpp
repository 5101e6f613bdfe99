#include "assessment/operators/scripted.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "sim/base/exact_math.h"
#include "sim/base/vectors.h"

namespace seldinger::assessment {
namespace {

constexpr double kStartMm = 60.0;  // the needle waits this far outside the entry
constexpr double kDriftLowHz = 0.03, kDriftHighHz = 0.15;
constexpr double kSweepMm = 15.0;         // the probe's first search, out of plane
constexpr double kRealignSeconds = 0.6;   // time constant of bringing the tip back into the picture
constexpr double kLearnedShare = 0.4;     // of the error about the target left after one look at a miss
constexpr double kOutsideMm = 8.0;        // a full withdrawal ends this far outside
constexpr double kLostMm = 5.0;           // a tip is missed from so far on after it should have appeared
constexpr double kPatienceSeconds = 4.0;  // of searching; then the needle goes on, unseen

}  // namespace

ScriptedOperator::ScriptedOperator(const OperatorProfile& profile, const PuncturePlan& plan,
                                   const cases::Instrument& instrument, std::uint64_t seed)
    : profile_(profile), plan_(plan), rng_(seed) {
  if (instrument.kind == cases::InstrumentKind::core)
    stop_short_mm_ = instrument.throw_mm - instrument.dead_tip_mm - instrument.notch_mm / 2;
  // Drawn one by one: the order of arguments' evaluation is the compiler's.
  const auto error = [this](double sd) {
    glm::dvec3 v(0.0);
    for (int axis = 0; axis < 3; ++axis) v[axis] = rng_.normal() * sd;
    return v;
  };
  believed_target_ = plan.target_lps_mm + error(profile.target_error_mm);
  const glm::dvec3 beside = error(profile.target_error_mm / 2);
  entry_ = plan.entry_lps_mm + beside - plan.direction * glm::dot(beside, plan.direction);
  scan_s_ = profile.scan_s * (0.7 + 0.6 * rng_.uniform());
  hand_ = UnsteadyHand(rng_);
  drift_ = make_wander(rng_, kDriftLowHz, kDriftHighHz);
  tilt_ = make_wander(rng_, kDriftLowHz, kDriftHighHz);
  inserted_mm_ = -kStartMm;
  aim();
}

// Towards where the target is believed to be; each new aim is better than the last.
void ScriptedOperator::aim() {
  const glm::dvec3 wanted = glm::normalize(believed_target_ - entry_);
  const auto [u, v] = base::perpendiculars(wanted);
  const double sd_rad = profile_.aim_error_deg * std::numbers::pi / 180.0 / (1 + redirections_);
  const double off_u = rng_.normal() * sd_rad, off_v = rng_.normal() * sd_rad;
  direction_ = glm::normalize(wanted + u * off_u + v * off_v);
}

bool ScriptedOperator::tip_seen() const noexcept {
  return !seen_.empty() && seen_.front().needle_tip;
}

double ScriptedOperator::goal_mm() const noexcept {
  return glm::dot(believed_target_ - entry_, direction_) - stop_short_mm_;
}

void ScriptedOperator::decide(const cases::State& state) {
  const double since_s = t_s_ - phase_since_s_;
  const auto enter = [this](Phase phase) {
    phase_ = phase;
    phase_since_s_ = t_s_;
  };
  switch (phase_) {
    case Phase::scan:
      if (since_s >= scan_s_) enter(Phase::approach);
      break;
    case Phase::approach:
      if (inserted_mm_ >= 0.0) enter(Phase::advance);
      break;
    case Phase::advance:
      if (inserted_mm_ >= goal_mm()) enter(Phase::look);
      break;
    case Phase::look: {
      if (since_s < 3.0 * profile_.reaction_delay_s) break;
      if (!tip_seen() && !going_blind_) break;  // searched for before the trigger
      // Only a tip in the picture can be seen to have missed.
      const glm::dvec3 miss = believed_target_ - state.needle.tip_lps_mm;
      const double beside_mm = glm::length(glm::cross(miss, state.needle.direction));
      if (tip_seen() && beside_mm > profile_.accept_miss_mm && redirections_ < profile_.max_redirections) {
        ++redirections_;
        believed_target_ = plan_.target_lps_mm + (believed_target_ - plan_.target_lps_mm) * kLearnedShare;
        const bool full = rng_.uniform() < profile_.full_withdrawal_share;
        withdraw_to_mm_ = full ? -kOutsideMm : inserted_mm_ * profile_.redirect_depth_share;
        enter(Phase::withdraw);
        break;
      }
      enter(Phase::fire);
      break;
    }
    case Phase::withdraw:
      if (inserted_mm_ > withdraw_to_mm_) break;
      aim();
      enter(withdraw_to_mm_ < 0.0 ? Phase::approach : Phase::advance);
      break;
    case Phase::fire:
      if (since_s >= kTriggerHoldSeconds) enter(Phase::done);
      break;
    case Phase::done:
      break;
  }
}

void ScriptedOperator::move(const cases::State& state, double dt_s) {
  const bool lost = !tip_seen() && (phase_ == Phase::look ||
                                    (phase_ == Phase::advance && inserted_mm_ > plan_.tip_shows_from_mm + kLostMm));
  if (!lost) {
    decided_blind_ = going_blind_ = false;
  } else if (!decided_blind_) {
    decided_blind_ = true;
    going_blind_ = rng_.uniform() < profile_.blind_advance_share;
    lost_since_s_ = t_s_;
  } else if (t_s_ - lost_since_s_ > kPatienceSeconds) {
    going_blind_ = true;
  }
  switch (phase_) {
    case Phase::approach:
      inserted_mm_ = std::min(0.0, inserted_mm_ + profile_.approach_mm_s * dt_s);
      break;
    case Phase::advance:
      if (!lost || going_blind_) inserted_mm_ = std::min(goal_mm(), inserted_mm_ + profile_.advance_mm_s * dt_s);
      break;
    case Phase::withdraw:
      inserted_mm_ -= 2.0 * profile_.advance_mm_s * dt_s;
      break;
    default:
      break;
  }
  // Who stops because the tip is gone fans the probe to it, and back to the target when the tip is found.
  const bool searching = lost && !going_blind_;
  const glm::dvec3 normal = glm::cross(plan_.probe.side, plan_.probe.axis);
  const double tip_off_mm = glm::dot(state.needle.tip_lps_mm - plan_.target_lps_mm, normal);
  alignment_ += ((searching ? 0.0 : 1.0) - alignment_) * (dt_s / (kRealignSeconds * (searching ? 1.0 : 10.0)));
  follow_mm_ +=
      ((searching ? tip_off_mm : 0.0) - follow_mm_) * (dt_s / (kRealignSeconds * (searching ? 1.0 : 10.0)));
}

cases::Inputs ScriptedOperator::act(const cases::State& state, const cases::FrameTruth* frame, double dt_s) {
  t_s_ += dt_s;
  if (frame != nullptr) seen_.push_back(*frame);
  while (seen_.size() > 1 && seen_[1].t_s <= t_s_ - profile_.reaction_delay_s) seen_.pop_front();
  decide(state);
  move(state, dt_s);

  cases::Inputs inputs;
  inputs.needle.position_lps_mm =
      entry_ + direction_ * inserted_mm_ +
      hand_.offset_mm(t_s_, direction_, profile_.tremor_mm, profile_.sway_mm, inserted_mm_ > 0.0);
  inputs.needle.axis = direction_;
  inputs.needle.side = base::perpendiculars(direction_).u;
  inputs.fire = phase_ == Phase::fire;

  const glm::dvec3 normal = glm::cross(plan_.probe.side, plan_.probe.axis);
  const double sweep = phase_ == Phase::scan
                           ? kSweepMm * (1.0 - (t_s_ - phase_since_s_) / scan_s_) * base::exact_sin(2.5 * t_s_)
                           : 0.0;
  const double off_mm = sweep + follow_mm_ + drift_.at(t_s_) * profile_.probe_drift_mm * alignment_;
  inputs.probe.position_lps_mm = plan_.probe.position_lps_mm + normal * off_mm;
  // A drifting hand also tilts: about 1° for each millimetre.
  const double tilt_rad = tilt_.at(t_s_) * profile_.probe_drift_mm * alignment_ * std::numbers::pi / 180.0;
  inputs.probe.axis = glm::normalize(plan_.probe.axis + normal * tilt_rad);
  inputs.probe.side = plan_.probe.side;
  return inputs;
}

}  // namespace seldinger::assessment
