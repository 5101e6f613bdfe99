#include "assessment/operators/scripted.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "assessment/operators/probe_over.h"
#include "sim/base/exact_math.h"
#include "sim/base/hash.h"
#include "sim/base/vectors.h"

namespace seldinger::assessment {
namespace {

constexpr double kStartMm = 60.0;  // the needle waits this far outside the entry
constexpr double kDriftLowHz = 0.03, kDriftHighHz = 0.15;
constexpr double kSweepMm = 15.0;         // the probe's first search, out of plane
constexpr double kSideMm = 14.0;          // … and along the picture, to and fro, to see which side is which
constexpr double kBackTimes = 10.0;       // slower back to the planned plane than to the tip
constexpr double kOutsideMm = 8.0;        // a full withdrawal ends this far outside
constexpr double kLostMm = 1.0;           // the tip counts as lost this far beyond where it should have appeared
constexpr double kPatienceSeconds = 2.5;  // of searching before trying something else
constexpr double kRetreatMm = 5.0;        // back first, to where it was seen, …
constexpr double kCreepMm = 2.0;          // … then forward, and searched for again
constexpr double kBeforeOrganMm = 3.0, kWithinOrganMm = 4.0;  // the aim is checked before, and corrected within
constexpr double kPlaneThereMm = 0.5;
constexpr double kPlaneStepMm = 3.0;  // dynamic tip positioning: the plane goes ahead, the tip follows into it
constexpr double kJiggleMm = 1.5, kJiggleHz = 2.0, kJiggleSeconds = 1.0;
constexpr double kLeaveMmS = 60.0;
constexpr double kGrantSeconds = 4.0;     // after which a hold that has not come is asked for again
constexpr double kBreatherSeconds = 3.0;  // before a patient who had to breathe is asked again
constexpr double kPauseLevel = 0.15;      // of a breath: a level below it is the pause between two
constexpr double kPauseMm = 20.0;         // outside, where the needle waits: the skin moves, too
constexpr std::uint64_t kBreathStream = 0x627265617468ULL;  // apart from what the hands draw
constexpr std::uint64_t kDeedStream = 0x6465656473ULL;      // the same

}  // namespace

ScriptedOperator::ScriptedOperator(const OperatorProfile& profile, const PuncturePlan& plan,
                                   const cases::Instrument& instrument, std::uint64_t seed)
    : profile_(profile),
      plan_(plan),
      across_(plan.approach == cases::Approach::out_of_plane),
      rng_(seed),
      conduct_(profile, plan.brief, true, seed) {
  if (instrument.kind == cases::InstrumentKind::core) {
    stop_short_mm_ = instrument.throw_mm - instrument.dead_tip_mm - instrument.notch_mm / 2;
    thrown_mm_ = instrument.throw_mm;
  }
  // Components are drawn one by one: the order in which arguments are evaluated is unspecified.
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
  base::Rng breath(base::hash_combine(seed, kBreathStream));
  asks_early_ = breath.uniform() < profile.holds_breath_early_share;
  waits_ = breath.uniform() < profile.waits_for_breath_share;
  base::Rng deeds(base::hash_combine(seed, kDeedStream));
  tests_side_ = deeds.uniform() < profile.shows_share;
  measures_ = looks_over_target_ = deeds.uniform() < profile.shows_share;
  inserted_mm_ = -kStartMm;
  plane_at_mm_ = plane_now_mm_ = plan.tip_shows_from_mm + kPlaneStepMm;
  aim();
  enter(Phase::sign_in);
}

void ScriptedOperator::enter(Phase phase) {
  phase_ = phase;
  phase_since_s_ = t_s_;
  if (phase == Phase::sign_in) conduct_.begin(Conduct::Part::sign_in);
  if (phase == Phase::prepare) conduct_.begin(Conduct::Part::prepare);
  if (phase == Phase::hold_breath) conduct_.begin(Conduct::Part::hold_breath);
  if (phase == Phase::finish) conduct_.begin(Conduct::Part::finish);
}

// Aims at where the target is believed to be; each new aim is better than the last.
void ScriptedOperator::aim() {
  const glm::dvec3 wanted = glm::normalize(target_now() - entry_);
  const auto [u, v] = base::perpendiculars(wanted);
  const double sd_rad = profile_.aim_error_deg * std::numbers::pi / 180.0 / (1 + redirections_);
  const double off_u = rng_.normal() * sd_rad, off_v = rng_.normal() * sd_rad;
  direction_ = glm::normalize(wanted + u * off_u + v * off_v);
}

// Where the target is believed to be, in tissue that has moved.
glm::dvec3 ScriptedOperator::target_now() const {
  return believed_target_ + target_moved_mm_;
}

bool ScriptedOperator::tip_seen() const noexcept {
  return picture() != nullptr && picture()->live && picture()->needle_tip;
}

double ScriptedOperator::goal_mm() const noexcept {
  return glm::dot(target_now() - entry_, direction_) - stop_short_mm_;
}

// While its tip is searched for, the needle is moved to and fro a little, never beyond where it was.
double ScriptedOperator::jiggle_mm() const noexcept {
  const double since_s = t_s_ - lost_since_s_;
  if (!lost_ || going_blind_ || phase_ != Phase::advance || since_s > kJiggleSeconds) return 0.0;
  return -0.5 * kJiggleMm * (1.0 - base::exact_cos(2.0 * std::numbers::pi * kJiggleHz * since_s));
}

// By how much the needle's line is seen to miss the target; a look at both also makes the target better known. 0
// while the picture does not show the tip: then nothing is known.
double ScriptedOperator::seen_miss_mm(const cases::State& state) {
  if (!tip_seen()) return 0.0;
  if (picture()->target)
    believed_target_ = plan_.target_lps_mm + (believed_target_ - plan_.target_lps_mm) * profile_.look_error_share;
  return glm::length(glm::cross(target_now() - state.needle.tip_lps_mm, state.needle.direction));
}

// Back, if possible within an organ that has been entered, and forward again with a better aim.
void ScriptedOperator::redirect() {
  ++redirections_;
  const bool full = chance(profile_.full_withdrawal_share), out = chance(profile_.leaves_organ_share);
  withdraw_to_mm_ = inserted_mm_ * profile_.redirect_depth_share;
  const double within_mm = plan_.organ_from_mm + kWithinOrganMm;
  if (!out && plan_.organ_from_mm > 0.0 && inserted_mm_ > within_mm)
    withdraw_to_mm_ = std::max(withdraw_to_mm_, within_mm);
  if (full) withdraw_to_mm_ = -kOutsideMm;
  enter(Phase::withdraw);
}

// Whether the patient's belly is still, seen with the usual delay; and whether it is as it was in the CT (between
// two breaths, where that was taken in expiration), which the rhythm tells in time.
void ScriptedOperator::watch_breath(const cases::PatientBreath& breath) {
  breathes_ = breath.moves;
  pauses_ = !breath.moves || std::abs(breath.level - plan_.ct_level) < kPauseLevel;
  const bool still = breath.moves && breath.state.held >= 1.0 && breath.state.cough_s == 0.0;
  if (still != still_) still_changed_s_ = t_s_;
  still_ = still;
  if (t_s_ - still_changed_s_ >= profile_.reaction_delay_s) seen_still_ = still;
}

// From the skin on, if this operator asks early: breathing would move tissue against a needle that waits inside.
bool ScriptedOperator::wants_breath() const noexcept {
  return breathes_ && asks_early_ && inserted_mm_ >= -kPauseMm;
}

void ScriptedOperator::ask_for_breath() {
  asked_s_ = t_s_;
  conduct_.begin(Conduct::Part::ask_breath);
}

bool ScriptedOperator::breath_will_do() const noexcept {
  return waits_ ? seen_still_ : asked_s_ >= 0.0 && conduct_.over();
}

// Whether it is time for the next phase. One function for each phase with more than one way out.
void ScriptedOperator::decide(const cases::State& state) {
  if (stops_for_breath()) return;
  const double since_s = t_s_ - phase_since_s_;
  switch (phase_) {
    case Phase::sign_in:
      if (conduct_.over()) enter(conduct_.deferred() ? Phase::finish : Phase::scan);
      break;
    case Phase::scan:
      if (since_s >= scan_s_) enter(Phase::prepare);
      break;
    case Phase::prepare:
      if (conduct_.over()) enter(Phase::approach);
      break;
    case Phase::approach:
      if (inserted_mm_ >= 0.0) enter(Phase::advance);
      break;
    case Phase::advance:
      decide_in_advance();
      break;
    case Phase::check:
      if (looked()) enter_or_redirect(Phase::advance, state);
      break;
    case Phase::look:
      decide_at_target(state);
      break;
    case Phase::withdraw:
      if (inserted_mm_ > withdraw_to_mm_) break;
      aim();
      put_plane_at(std::max(inserted_mm_, 0.0) + kPlaneStepMm);
      enter(withdraw_to_mm_ < 0.0 ? Phase::approach : Phase::advance);
      break;
    case Phase::retreat:
      if (inserted_mm_ > withdraw_to_mm_) break;
      put_plane_at(inserted_mm_ + kPlaneStepMm);
      enter(Phase::advance);
      break;
    case Phase::await_breath:
      if (breath_will_do())
        enter(before_breath_);
      else if (conduct_.over() && since_s >= kBreatherSeconds && t_s_ - asked_s_ >= kGrantSeconds)
        ask_for_breath();
      break;
    case Phase::hold_breath:
      decide_in_held_breath();
      break;
    case Phase::fire:
      if (since_s >= kTriggerHoldSeconds) enter(Phase::leave);
      break;
    case Phase::leave:
      if (inserted_mm_ <= -kOutsideMm - thrown_mm_) enter(Phase::finish);
      break;
    case Phase::finish:
      if (conduct_.over()) enter(Phase::done);
      break;
    case Phase::done:
      break;
  }
}

// On the way in, an operator who asks for held breath early does not go on without it.
bool ScriptedOperator::stops_for_breath() {
  const bool on_the_way =
      phase_ == Phase::approach || phase_ == Phase::advance || phase_ == Phase::check || phase_ == Phase::look;
  if (!on_the_way || !wants_breath() || breath_will_do()) return false;
  before_breath_ = phase_;
  const bool again = asked_s_ >= 0.0;
  enter(Phase::await_breath);
  if (!again) ask_for_breath();
  return true;
}

// A look takes a few reaction times.
bool ScriptedOperator::looked() const noexcept {
  return t_s_ - phase_since_s_ >= 3.0 * profile_.reaction_delay_s;
}

void ScriptedOperator::enter_or_redirect(Phase next, const cases::State& state) {
  const bool misses = seen_miss_mm(state) > profile_.accept_miss_mm;
  if (misses && redirections_ < static_cast<int>(std::lround(profile_.max_redirections)))
    redirect();
  else
    enter(next);
}

void ScriptedOperator::decide_in_advance() {
  // A tip searched for in vain: back once to where it was last seen, then forward in small steps.
  if (lost_ && !going_blind_ && t_s_ - lost_since_s_ > kPatienceSeconds && creep_to_mm_ <= inserted_mm_) {
    lost_since_s_ = t_s_;
    if (!retreated_ && inserted_mm_ > plan_.tip_shows_from_mm + kLostMm + kRetreatMm) {
      retreated_ = true;
      withdraw_to_mm_ = inserted_mm_ - kRetreatMm;
      enter(Phase::retreat);
    } else {
      creep_to_mm_ = inserted_mm_ + kCreepMm;
    }
    return;
  }
  // The aim is checked once before the organ, unless that lies right under the skin.
  if (!checked_ && inserted_mm_ >= plan_.organ_from_mm - kBeforeOrganMm) {
    checked_ = true;
    if (plan_.organ_from_mm > 2.0 * kBeforeOrganMm && chance(profile_.checks_aim_share)) {
      enter(Phase::check);
      return;
    }
  }
  if (inserted_mm_ >= goal_mm()) enter(Phase::look);
}

void ScriptedOperator::decide_at_target(const cases::State& state) {
  if (!looked()) return;
  // A tip that is not seen is searched for before the trigger.
  if (!tip_seen() && !going_blind_ && t_s_ - lost_since_s_ <= kPatienceSeconds) return;
  enter_or_redirect(breathes_ && asks_early_ ? Phase::fire : Phase::hold_breath, state);
}

void ScriptedOperator::decide_in_held_breath() {
  if (breathes_ && waits_ && conduct_.over() && !seen_still_) {
    if (t_s_ - std::max(asked_s_, phase_since_s_) >= kGrantSeconds) ask_for_breath();
    return;
  }
  // Fires only once the tip is seen again, wherever it went while the breath was being held.
  if (conduct_.over() && (!lost_ || going_blind_ || t_s_ - lost_since_s_ > kPatienceSeconds)) enter(Phase::fire);
}

// Where the hand means to put the plane, and by how much it misses.
void ScriptedOperator::put_plane_at(double inserted_mm) {
  plane_at_mm_ = inserted_mm;
  plane_error_mm_ = rng_.normal() * profile_.follow_error_mm;
}

// Whether a tip that should be in the picture is missing, and whether the operator goes on all the same.
void ScriptedOperator::judge_sight() {
  const bool expected = phase_ == Phase::look || phase_ == Phase::check || phase_ == Phase::hold_breath ||
                        (phase_ == Phase::advance && (across_ ? inserted_mm_ >= plane_at_mm_
                                                              : inserted_mm_ > plan_.tip_shows_from_mm + kLostMm));
  const bool lost = expected && !tip_seen();
  if (lost && !lost_) {
    going_blind_ = chance(profile_.blind_advance_share);
    lost_since_s_ = t_s_;
  }
  if (!lost) going_blind_ = false;
  if (tip_seen()) {
    retreated_ = false;
    creep_to_mm_ = -1.0;
  }
  lost_ = lost;
}

void ScriptedOperator::move(double dt_s) {
  // No hand jumps back to a target that came nearer; a target that became better known has not moved.
  const double back_mm = target_moved_mm_ == glm::dvec3(0.0) ? -1e300 : inserted_mm_ - profile_.advance_mm_s * dt_s;
  switch (phase_) {
    case Phase::approach:
      if (waits_ && !asks_early_ && !pauses_ && inserted_mm_ >= -kPauseMm)
        break;  // the skin is marked as it lies between breaths
      inserted_mm_ = std::min(0.0, inserted_mm_ + profile_.approach_mm_s * dt_s);
      break;
    case Phase::advance:
      // Out of plane the tip follows into a plane ahead of it; then the plane moves on.
      if (across_ && tip_seen() && inserted_mm_ >= plane_at_mm_) put_plane_at(inserted_mm_ + kPlaneStepMm);
      if (lost_ ? going_blind_ || inserted_mm_ < creep_to_mm_
                : !across_ || std::abs(plane_at_mm_ - plane_now_mm_) < kPlaneThereMm)
        inserted_mm_ = std::max(std::min(goal_mm(), inserted_mm_ + profile_.advance_mm_s * dt_s), back_mm);
      break;
    case Phase::withdraw:
    case Phase::retreat:
      inserted_mm_ -= 2.0 * profile_.advance_mm_s * dt_s;
      break;
    case Phase::leave:
      inserted_mm_ -= kLeaveMmS * dt_s;
      break;
    default:
      break;
  }
}

// When the tip is lost, the operator moves the probe over the needle, guided by the visible shaft and the depth
// marks, and back to the target once the tip is found.
void ScriptedOperator::hold_probe(cases::ToolPose& probe, double dt_s) {
  const bool searching = lost_ && !going_blind_;
  const double share = std::min(1.0, dt_s / profile_.realign_s), back = share / kBackTimes;
  alignment_ += ((searching ? 0.0 : 1.0) - alignment_) * (searching ? share : back);
  probe = probe_over(plan_, inserted_mm_);
  if (across_) {
    PuncturePlan as_held = plan_;
    as_held.entry_lps_mm = entry_;
    as_held.direction = direction_;
    // The plane waits ahead of an advancing tip, and goes back to one that is not found.
    const double wanted_mm = phase_ == Phase::advance && !searching ? plane_at_mm_ : std::max(inserted_mm_, 0.0);
    const bool before =
        phase_ == Phase::sign_in || phase_ == Phase::scan || phase_ == Phase::prepare || phase_ == Phase::approach;
    plane_now_mm_ += ((before ? plane_at_mm_ : wanted_mm) - plane_now_mm_) * share;
    if (searching) plane_error_mm_ -= plane_error_mm_ * share;
    // Who measures looks over the target first, and comes back to where the tip will be.
    const double over_share = phase_ == Phase::scan && looks_over_target_
                                  ? 0.5 - 0.5 * base::exact_cos(2.0 * std::numbers::pi * scanned_share())
                                  : 0.0;
    probe = probe_over(as_held, plane_now_mm_ + over_share * (plan_.depth_mm - plane_now_mm_));
    probe.position_lps_mm += plane_normal(probe) * plane_error_mm_;
  } else {
    const double tip_off_mm = glm::dot(hands_tip() - plan_.target_lps_mm, plane_normal(plan_.probe));
    follow_mm_ += ((searching ? tip_off_mm : 0.0) - follow_mm_) * (searching ? share : back);
  }
  const glm::dvec3 normal = plane_normal(probe);
  const double sweep = phase_ == Phase::scan && !(across_ && looks_over_target_)
                           ? kSweepMm * (1.0 - scanned_share()) * base::exact_sin(2.5 * t_s_)
                           : 0.0;
  if (phase_ == Phase::scan && tests_side_)
    probe.position_lps_mm += probe.side * (kSideMm * base::exact_sin(2.0 * std::numbers::pi * scanned_share()));
  const auto [drift, tilt] = wanders_at<2>({&drift_, &tilt_}, t_s_);
  probe.position_lps_mm += normal * (sweep + follow_mm_ + drift * profile_.probe_drift_mm * alignment_);
  // A drifting hand also tilts: about 1° for each millimetre.
  const double tilt_rad = tilt * profile_.probe_drift_mm * alignment_ * std::numbers::pi / 180.0;
  probe.axis = glm::normalize(probe.axis + normal * tilt_rad);
}

// Before the puncture: how deep the target lies, off the first picture that shows it; and how far the needle is to
// go in. What is measured is recorded from the first tick on.
void ScriptedOperator::show_deeds(const cases::State& state, cases::Inputs& inputs) {
  if (inputs.event == cases::EventKind::note_plan) inputs.event_tenths_mm = cases::tenths_of(goal_mm());
  if (inputs.event != cases::EventKind::none) return;
  if (!begun_) {
    begun_ = true;
    inputs.event = cases::EventKind::calipers_recorded;
  } else if (phase_ == Phase::scan && measures_ && picture() != nullptr && picture()->live && picture()->target) {
    measures_ = false;
    inputs.event = cases::EventKind::depth_measured;
    inputs.event_tenths_mm =
        cases::tenths_of(glm::dot(target_now() - state.probe.origin_lps_mm, state.probe.axial));
  }
}

cases::Inputs ScriptedOperator::act(const cases::State& state, const cases::FrameTruth* frame, double dt_s,
                                    const glm::dvec3& target_moved_mm) {
  t_s_ += dt_s;
  if (frame != nullptr) seen_.push_back({*frame, target_moved_mm});
  while (seen_.size() > 1 && seen_[1].frame.t_s <= t_s_ - profile_.reaction_delay_s) seen_.pop_front();
  if (picture() != nullptr && picture()->live && picture()->target)
    target_moved_mm_ = seen_.front().target_moved_mm;
  watch_breath(state.breath);
  cases::Inputs inputs;
  // The skin is marked and numbed between two breaths.
  if (!(phase_ == Phase::prepare && waits_ && !pauses_)) inputs.event = conduct_.advance(dt_s);
  show_deeds(state, inputs);
  decide(state);
  judge_sight();
  if (!conduct_.stopped() || phase_ == Phase::leave) move(dt_s);

  inputs.needle.position_lps_mm =
      hands_tip() + direction_ * jiggle_mm() +
      hand_.offset_mm(t_s_, direction_, profile_.tremor_mm, profile_.sway_mm, inserted_mm_ > 0.0);
  inputs.needle.axis = direction_;
  inputs.needle.side = base::perpendiculars(direction_).u;
  inputs.fire = phase_ == Phase::fire;
  hold_probe(inputs.probe, dt_s);
  return inputs;
}

}  // namespace seldinger::assessment
