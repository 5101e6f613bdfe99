#include "assessment/operators/fluoroscopy.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "sim/base/exact_math.h"
#include "sim/base/vectors.h"

namespace seldinger::assessment {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;
constexpr double kBeamStartMm = 60.0;    // the needle waits this far outside the entry
constexpr double kTouchMm = 2.0;         // held so near before the skin is punctured
constexpr double kLiftMm = 12.0;         // outside while the entry is moved
constexpr double kBeamOutsideMm = 10.0;  // a full withdrawal ends this far outside
constexpr double kLetGoSeconds = 0.3;    // to put the needle into its holder, or to take it again
constexpr double kAngleDoneDeg = 0.3;    // nearer, an angle is what was wanted
constexpr double kTableDoneMm = 1.0;
constexpr double kEaseSeconds = 0.25;  // a machine is slowed down this long before it stands
constexpr double kAimShare = 0.6;      // of the expected depth, under the bull's-eye view
constexpr double kUnclearTimes = 2.0;  // a target that is not seen itself is found so much worse
constexpr int kMaxLooksOnSkin = 5, kMaxLastLooks = 6;
constexpr double kMaxSteerDeg = 6.0;  // in one go, in tissue

double eased(double now, double wanted, double speed, double near_enough) {
  const double gap = wanted - now;
  if (std::abs(gap) < near_enough) return 0.0;
  return std::clamp(gap / (speed * kEaseSeconds), -1.0, 1.0);
}

int rate_index(double rate_hz) {
  int best = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(cases::kPulseRateHz[static_cast<std::size_t>(i)] - rate_hz) <
        std::abs(cases::kPulseRateHz[static_cast<std::size_t>(best)] - rate_hz))
      best = i;
  return best;
}

}  // namespace

FluoroscopyOperator::FluoroscopyOperator(const OperatorProfile& profile, const PuncturePlan& plan,
                                         const cases::Instrument& instrument, const cases::Fluoroscope& fluoroscope,
                                         cases::PatientPosition position, std::uint64_t seed)
    : profile_(profile),
      plan_(plan),
      machine_(fluoroscope),
      position_(position),
      rng_(seed),
      conduct_(profile, plan.brief, false, seed) {
  if (instrument.kind == cases::InstrumentKind::core) {
    stop_short_mm_ = instrument.throw_mm - instrument.dead_tip_mm - instrument.notch_mm / 2;
    thrown_mm_ = instrument.throw_mm;
  }
  // Drawn one by one: the order of arguments' evaluation is the compiler's.
  const auto error = [this](double sd) {
    glm::dvec3 v(0.0);
    for (int axis = 0; axis < 3; ++axis) v[axis] = rng_.normal() * sd;
    return v;
  };
  // What was read off the CT before: good enough to set up the machine, not to puncture by.
  wanted_arm_ = machine_.start;
  wanted_arm_.isocentre_lps_mm = plan.target_lps_mm + error(2.0 * profile.target_error_mm);
  const cases::BeamAngles angles = cases::angles_of_beam(-plan.direction, position);
  wanted_arm_.lao_deg = angles.lao_deg + rng_.normal() * profile.arm_error_deg;
  wanted_arm_.cranial_deg = angles.cranial_deg + rng_.normal() * profile.arm_error_deg;
  wanted_arm_.lao_deg = std::clamp(wanted_arm_.lao_deg, -machine_.angle_max_deg, machine_.angle_max_deg);
  wanted_arm_.cranial_deg =
      std::clamp(wanted_arm_.cranial_deg, -machine_.cranial_max_deg, machine_.cranial_max_deg);
  const glm::dvec3 beside_entry = error(2.0 * profile.target_error_mm);
  entry_ = plan.entry_lps_mm + beside_entry - plan.direction * glm::dot(beside_entry, plan.direction);
  expected_depth_mm_ = std::max(15.0, plan.depth_mm + rng_.normal() * profile.depth_error_mm);
  depth_view_ = !chance(profile.skip_depth_view_share);
  beam_with_motion_ = chance(profile.beam_while_moving_share);
  hand_ = UnsteadyHand(rng_);
  direction_ = plan.direction;
  inserted_mm_ = -kBeamStartMm;
  enter(Phase::sign_in);
}

void FluoroscopyOperator::enter(Phase phase) {
  phase_ = phase;
  phase_since_s_ = t_s_;
  if (phase == Phase::sign_in) conduct_.begin(Conduct::Part::sign_in);
  if (phase == Phase::prepare) conduct_.begin(Conduct::Part::prepare);
  if (phase == Phase::hold_breath) conduct_.begin(Conduct::Part::hold_breath);
  if (phase == Phase::finish) conduct_.begin(Conduct::Part::finish);
  if (phase == Phase::turn || phase == Phase::align) beam_with_motion_ = chance(profile_.beam_while_moving_share);
  if (phase == Phase::advance) beam_with_motion_ = chance(profile_.beam_while_advancing_share);
}

void FluoroscopyOperator::begin_look() {
  enter(Phase::look);
  ++looks_;
  away_ = !chance(profile_.hand_in_beam_share);
  fix_seen_ = false;
}

// The pedal was down long enough, a picture came, and there was time to take it in.
bool FluoroscopyOperator::look_over() const noexcept {
  const double pedal_since_s = phase_since_s_ + (away_ ? kLetGoSeconds : 0.0);
  return fix_seen_ && t_s_ - pedal_since_s >= profile_.look_s &&
         t_s_ - fix_seen_s_ >= profile_.reaction_delay_s + (away_ ? kLetGoSeconds : 0.0);
}

bool FluoroscopyOperator::arm_in_place(const cases::CArm& arm) const noexcept {
  const glm::dvec3 gap = wanted_arm_.isocentre_lps_mm - arm.isocentre_lps_mm;
  return std::abs(wanted_arm_.lao_deg - arm.lao_deg) < kAngleDoneDeg &&
         std::abs(wanted_arm_.cranial_deg - arm.cranial_deg) < kAngleDoneDeg && std::abs(gap.x) < kTableDoneMm &&
         std::abs(gap.y) < kTableDoneMm && std::abs(gap.z) < kTableDoneMm;
}

void FluoroscopyOperator::drive(const cases::CArm& arm, cases::FluoroscopeInputs& asked) const {
  asked.lao_speed = eased(arm.lao_deg, wanted_arm_.lao_deg, machine_.arm_speed_deg_s, kAngleDoneDeg);
  asked.cranial_speed = eased(arm.cranial_deg, wanted_arm_.cranial_deg, machine_.arm_speed_deg_s, kAngleDoneDeg);
  for (int axis = 0; axis < 3; ++axis)
    asked.table_speed[axis] = eased(arm.isocentre_lps_mm[axis], wanted_arm_.isocentre_lps_mm[axis],
                                    machine_.table_speed_mm_s, kTableDoneMm);
}

// The hub over the tip: the needle stands along the ray through its tip. The longer one has looked, the better.
void FluoroscopyOperator::aim_along_beam(const cases::BeamFrame& frame) {
  const glm::dvec3 wanted = glm::normalize(frame.source_lps_mm - believed_tip());
  const auto [u, v] = base::perpendiculars(wanted);
  const double sd_rad = profile_.aim_error_deg * kRadPerDeg / (1 + looks_);
  const double off_u = rng_.normal() * sd_rad, off_v = rng_.normal() * sd_rad;
  direction_ = glm::normalize(wanted + u * off_u + v * off_v);
}

// A way on the detector as a way across the needle, at the depth at which the tip is believed to be.
glm::dvec3 FluoroscopyOperator::beside(const cases::BeamFrame& frame, const glm::dvec2& offset_mm) const {
  const auto shadow = cases::shadow_of(frame, believed_tip());
  const double magnification = shadow ? shadow->magnification : frame.sid_mm / machine_.source_isocentre_mm;
  const glm::dvec3 way = (frame.u * offset_mm.x + frame.v * offset_mm.y) / magnification;
  return way - direction_ * glm::dot(way, direction_);
}

// Turns the needle about its entry so that the tip goes `beside_mm`; less after many looks: the line through the
// entry that fits all of them by least squares, in which a deep tip tells more than a shallow one.
void FluoroscopyOperator::steer(const glm::dvec3& seen_beside_mm) {
  const double lever_mm = std::max(inserted_mm_, 15.0);
  told_mm2_ += lever_mm * lever_mm;
  const glm::dvec3 beside_mm = seen_beside_mm * (lever_mm * lever_mm / told_mm2_);
  const double most = kMaxSteerDeg * kRadPerDeg, asked = glm::length(beside_mm) / lever_mm;
  direction_ = glm::normalize(direction_ + beside_mm / lever_mm * std::min(1.0, asked > 0.0 ? most / asked : 1.0));
}

// Too far beside to be steered: back, partly or out, and again.
void FluoroscopyOperator::redirect(const glm::dvec3& beside_mm) {
  ++redirections_;
  told_mm2_ = 0.0;  // what was seen of the old way says nothing of the new one
  const bool full = chance(profile_.full_withdrawal_share);
  if (full) {
    withdraw_to_mm_ = -kBeamOutsideMm;
    shift_mm_ = beside_mm;
    stage_ = Stage::skin;
  } else {
    withdraw_to_mm_ = inserted_mm_ * profile_.redirect_depth_share;
    steer(beside_mm);
  }
  enter(Phase::withdraw);
}

// How far the bull's-eye view is for; who wants no depth view goes all the way.
double FluoroscopyOperator::aim_until_mm() const noexcept {
  return (depth_view_ ? kAimShare : 1.0) * (expected_depth_mm_ - stop_short_mm_);
}

void FluoroscopyOperator::advance_towards(double goal_mm) {
  advance_to_mm_ = std::min(goal_mm, inserted_mm_ + profile_.exposure_step_mm);
  enter(Phase::advance);
}

void FluoroscopyOperator::turn_to_depth_view(const cases::CArm& arm) {
  // Turning about the long axis changes the view by less where the arm is tilted to head or feet.
  const double level = std::max(0.5, base::exact_cos(arm.cranial_deg * kRadPerDeg));
  const double turn_deg = std::min(90.0, profile_.depth_turn_deg / level);
  wanted_arm_.lao_deg = std::clamp(arm.lao_deg + (arm.lao_deg > 0.0 ? -turn_deg : turn_deg),
                                   -machine_.angle_max_deg, machine_.angle_max_deg);
  stage_ = Stage::depth;
  enter(Phase::turn);
}

void FluoroscopyOperator::judge(const cases::State& state) {
  if (!(fix_.tip && fix_.target) && !wide_open_) {
    wide_open_ = true;  // what one looks for is behind the blades
    begin_look();
    return;
  }
  const double target_error_mm = profile_.fix_error_mm * (fix_.target_clear ? 1.0 : kUnclearTimes);
  for (int axis = 0; axis < 2; ++axis) fix_.tip_mm[axis] += rng_.normal() * profile_.fix_error_mm;
  for (int axis = 0; axis < 2; ++axis) fix_.target_mm[axis] += rng_.normal() * target_error_mm;
  const cases::BeamFrame frame = cases::beam_frame(machine_, state.fluoroscopy.arm, position_);
  switch (stage_) {
    case Stage::skin:
      judge_on_skin(frame);
      break;
    case Stage::bulls_eye:
      judge_aim(frame);
      if (phase_ != Phase::look) break;
      if (inserted_mm_ < aim_until_mm() - 0.5)
        advance_towards(aim_until_mm());
      else if (depth_view_)
        turn_to_depth_view(state.fluoroscopy.arm);
      else
        enter(Phase::hold_breath);
      break;
    case Stage::depth:
      judge_depth(frame);
      break;
  }
}

void FluoroscopyOperator::judge_on_skin(const cases::BeamFrame& frame) {
  const glm::dvec3 off_mm = beside(frame, fix_.target_mm - fix_.tip_mm);
  if (glm::length(off_mm) > profile_.accept_miss_mm / 2.0 && looks_ < kMaxLooksOnSkin * (1 + redirections_)) {
    shift_mm_ = off_mm;
    enter(Phase::lift);
    return;
  }
  aim_along_beam(frame);
  stage_ = Stage::bulls_eye;
  advance_towards(aim_until_mm());
}

void FluoroscopyOperator::judge_aim(const cases::BeamFrame& frame) {
  const glm::dvec3 off_mm = beside(frame, fix_.target_mm - fix_.tip_mm);
  if (glm::length(off_mm) > 1.5 * profile_.accept_miss_mm &&
      redirections_ < static_cast<int>(std::lround(profile_.max_redirections)))
    redirect(off_mm);
  else
    steer(off_mm);
}

void FluoroscopyOperator::judge_depth(const cases::BeamFrame& frame) {
  const auto here = cases::shadow_of(frame, believed_tip());
  const auto ahead = cases::shadow_of(frame, believed_tip() + direction_);
  if (!here || !ahead) {
    enter(Phase::hold_breath);
    return;
  }
  // How the shadow of the tip goes for each mm of advance, and how much of that the target is away.
  const glm::dvec2 along = ahead->detector_mm - here->detector_mm, offset_mm = fix_.target_mm - fix_.tip_mm;
  const double along2 = std::max(glm::dot(along, along), 0.01);
  const double left_mm = glm::dot(offset_mm, along) / along2;
  // The hand knows how far it went between looks, so that all of them tell of the same depth.
  goals_mm_ += inserted_mm_ + left_mm - stop_short_mm_;
  const double goal_mm = goals_mm_ / ++goals_;
  if (std::abs(goal_mm - inserted_mm_) <= profile_.exposure_step_mm) ++last_looks_;
  steer(beside(frame, offset_mm - along * left_mm));
  if (std::abs(goal_mm - inserted_mm_) <= profile_.accept_miss_mm / 2.0 || last_looks_ >= kMaxLastLooks) {
    enter(Phase::hold_breath);
  } else if (goal_mm < inserted_mm_) {
    withdraw_to_mm_ = std::max(5.0, goal_mm);
    enter(Phase::withdraw);
  } else {
    advance_towards(goal_mm);
  }
}

void FluoroscopyOperator::decide(const cases::State& state) {
  const cases::CArm& arm = state.fluoroscopy.arm;
  switch (phase_) {
    case Phase::sign_in:
      if (conduct_.over()) enter(conduct_.deferred() ? Phase::finish : Phase::align);
      break;
    case Phase::prepare:
      if (conduct_.over()) enter(Phase::approach);
      break;
    case Phase::hold_breath:
      if (conduct_.over()) enter(Phase::fire);
      break;
    case Phase::leave:
      if (inserted_mm_ <= -kBeamOutsideMm - thrown_mm_) enter(Phase::finish);
      break;
    case Phase::finish:
      if (conduct_.over()) enter(Phase::done);
      break;
    case Phase::align:
      if (t_s_ < 0.1 || !arm_in_place(arm)) break;  // the first ticks tell nothing yet
      aim_along_beam(cases::beam_frame(machine_, arm, position_));
      enter(Phase::prepare);
      break;
    case Phase::approach:
      if (state.needle.skin.depth_mm <= -kTouchMm && inserted_mm_ < kBeamStartMm) break;
      entry_ = believed_tip();
      inserted_mm_ = 0.0;
      begin_look();
      break;
    case Phase::look:
      if (look_over()) judge(state);
      break;
    case Phase::lift:
      if (inserted_mm_ > -kLiftMm) break;
      entry_ += shift_mm_;
      aim_along_beam(cases::beam_frame(machine_, arm, position_));
      enter(Phase::approach);
      break;
    case Phase::advance:
      if (inserted_mm_ >= advance_to_mm_) begin_look();
      break;
    case Phase::withdraw:
      if (inserted_mm_ > withdraw_to_mm_) break;
      if (withdraw_to_mm_ < 0.0)
        enter(Phase::lift);
      else if (stage_ == Stage::bulls_eye)
        advance_towards(aim_until_mm());
      else
        begin_look();
      break;
    case Phase::turn:
      if (arm_in_place(arm)) begin_look();
      break;
    case Phase::fire:
      if (t_s_ - phase_since_s_ >= kTriggerHoldSeconds) enter(Phase::leave);
      break;
    case Phase::done:
      break;
  }
}

void FluoroscopyOperator::move_hand(const cases::State& state, double dt_s) {
  switch (phase_) {
    case Phase::approach:
      // Slower near the skin, so as not to fall into it.
      inserted_mm_ += (state.needle.skin.depth_mm > -15.0 ? 0.3 : 1.0) * profile_.approach_mm_s * dt_s;
      break;
    case Phase::lift:
    case Phase::leave:
      inserted_mm_ -= profile_.approach_mm_s * dt_s;
      break;
    case Phase::advance:
      inserted_mm_ = std::min(advance_to_mm_, inserted_mm_ + profile_.advance_mm_s * dt_s);
      break;
    case Phase::withdraw:
      inserted_mm_ -= 2.0 * profile_.advance_mm_s * dt_s;
      break;
    default:
      break;
  }
}

cases::Inputs FluoroscopyOperator::act(const cases::State& state, const PictureFix* fix, double dt_s) {
  t_s_ += dt_s;
  if (fix != nullptr) {
    if (!fix_seen_) fix_seen_s_ = t_s_;
    fix_seen_ = true;
    fix_ = *fix;
  }
  cases::Inputs inputs;
  inputs.event = conduct_.advance(dt_s);
  decide(state);
  if (!conduct_.stopped() || phase_ == Phase::leave) move_hand(state, dt_s);

  inputs.needle.position_lps_mm =
      believed_tip() + hand_.offset_mm(t_s_, direction_, profile_.tremor_mm, profile_.sway_mm, inserted_mm_ > 0.0);
  inputs.needle.axis = direction_;
  inputs.needle.side = base::perpendiculars(direction_).u;
  inputs.probe = plan_.probe;  // stands aside
  inputs.fire = phase_ == Phase::fire;

  cases::FluoroscopeInputs& asked = inputs.fluoroscope;
  asked.pulse_rate = rate_index(profile_.pulse_rate_hz);
  asked.collimator.open_u = asked.collimator.open_v = wide_open_ ? 1.0 : profile_.collimator_open;
  const double since_s = t_s_ - phase_since_s_;
  switch (phase_) {
    case Phase::align:
    case Phase::turn:
      drive(state.fluoroscopy.arm, asked);
      asked.hand_away = phase_ == Phase::turn;
      asked.pedal = beam_with_motion_;
      break;
    case Phase::look: {
      asked.hand_away = away_;
      const double pedal_s = since_s - (away_ ? kLetGoSeconds : 0.0);
      asked.pedal = pedal_s >= 0.0 && (pedal_s < profile_.look_s || !fix_seen_);
      break;
    }
    case Phase::advance:
      asked.pedal = beam_with_motion_;
      break;
    default:
      break;
  }
  return inputs;
}

}  // namespace seldinger::assessment
