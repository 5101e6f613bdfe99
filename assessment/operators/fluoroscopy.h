// A simulated trainee who punctures under fluoroscopy: a bull's-eye view along the planned path to aim, advancing
// between exposures, a depth view to measure how far, then the trigger. It sees what a person at the machine sees:
// the machine's display, the needle outside the skin, and where a picture shows tip and target; never where they
// are. Deterministic: the same plan, profile and seed act the same on every machine.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

#include "assessment/operators/conduct.h"
#include "assessment/operators/plan.h"
#include "assessment/operators/profile.h"
#include "assessment/operators/wander.h"
#include "sim/base/rng.h"
#include "sim/case/c_arm.h"
#include "sim/case/case.h"
#include "sim/case/inputs.h"
#include "sim/case/state.h"

namespace seldinger::assessment {

// Where a picture shows tip and target: mm on the detector from the field's middle, along u and v.
struct PictureFix {
  bool tip = false, target = false;  // inside the collimated field
  bool target_clear = false;         // seen itself; otherwise found by what lies about it
  glm::dvec2 tip_mm{0.0}, target_mm{0.0};
  bool operator==(const PictureFix&) const = default;
};

class FluoroscopyOperator {
 public:
  FluoroscopyOperator(const OperatorProfile& profile, const PuncturePlan& plan, const cases::Instrument& instrument,
                      const cases::Fluoroscope& fluoroscope, cases::PatientPosition position, std::uint64_t seed);

  // What the hands and the foot want in this tick. `fix` is what the picture that appeared in it shows, if one did.
  cases::Inputs act(const cases::State& state, const PictureFix* fix, double dt_s);

  // What was said or happened in the last tick: who should stops when the patient is in trouble.
  void hear(cases::EventKind kind) { conduct_.hear(kind); }

  bool done() const noexcept { return phase_ == Phase::done; }

 private:
  enum class Phase {
    sign_in,
    align,
    prepare,
    approach,
    look,
    lift,
    advance,
    withdraw,
    turn,
    hold_breath,
    fire,
    leave,
    finish,
    done
  };
  enum class Stage { skin, bulls_eye, depth };  // what a look is for

  void enter(Phase phase);
  void begin_look();
  void decide(const cases::State& state);
  void move_hand(const cases::State& state, double dt_s);
  void drive(const cases::CArm& arm, cases::FluoroscopeInputs& asked) const;
  bool arm_in_place(const cases::CArm& arm) const noexcept;
  bool look_over() const noexcept;
  void judge(const cases::State& state);
  void judge_on_skin(const cases::BeamFrame& frame);
  void judge_aim(const cases::BeamFrame& frame);
  void judge_depth(const cases::BeamFrame& frame);
  void aim_along_beam(const cases::BeamFrame& frame);
  void steer(const glm::dvec3& seen_beside_mm);
  void redirect(const glm::dvec3& beside_mm);
  double aim_until_mm() const noexcept;
  void advance_towards(double goal_mm);
  void turn_to_depth_view(const cases::CArm& arm);
  glm::dvec3 beside(const cases::BeamFrame& frame, const glm::dvec2& offset_mm) const;
  glm::dvec3 believed_tip() const { return entry_ + direction_ * inserted_mm_; }
  bool chance(double share) { return rng_.uniform() < share; }

  OperatorProfile profile_;
  PuncturePlan plan_;
  cases::Fluoroscope machine_;
  cases::PatientPosition position_;
  double stop_short_mm_ = 0.0;  // core: the throw carries the notch the rest of the way
  double thrown_mm_ = 0.0;      // core: so far ahead of the hand the tip is once it has fired
  base::Rng rng_;
  Conduct conduct_;
  Phase phase_ = Phase::sign_in;
  Stage stage_ = Stage::skin;
  double t_s_ = 0.0, phase_since_s_ = 0.0;
  cases::CArm wanted_arm_;
  glm::dvec3 entry_{0.0}, direction_{0.0};
  double inserted_mm_ = 0.0;  // the hand's: from the entry along the direction, negative outside
  double expected_depth_mm_ = 0.0, advance_to_mm_ = 0.0, withdraw_to_mm_ = 0.0;
  glm::dvec3 shift_mm_{0.0};  // what the entry is moved by when the needle is lifted
  double told_mm2_ = 0.0;     // what looks have told of this way's direction: sum of squared depths
  int looks_ = 0, redirections_ = 0, last_looks_ = 0;
  double goals_mm_ = 0.0;  // what looks under the depth view have told of the depth: their sum …
  int goals_ = 0;          // … and their number
  bool depth_view_ = true, away_ = false, beam_with_motion_ = false, wide_open_ = false;
  bool fix_seen_ = false;
  PictureFix fix_;
  double fix_seen_s_ = 0.0;
  UnsteadyHand hand_;
};

}  // namespace seldinger::assessment
