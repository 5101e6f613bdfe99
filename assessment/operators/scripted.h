// A simulated trainee who punctures under a probe: sees snapshots and pictures with a delay, and returns where the
// hands want to be and what is said. It sees what a person would: the pictures, the needle outside the skin and its
// depth marks; of the tip only whether the picture shows it, and where while it does. Deterministic: the same plan,
// profile and seed act the same on every machine.
#pragma once

#include <cstdint>
#include <deque>

#include "assessment/operators/conduct.h"
#include "assessment/operators/plan.h"
#include "assessment/operators/profile.h"
#include "assessment/operators/wander.h"
#include "sim/base/rng.h"
#include "sim/case/case.h"
#include "sim/case/inputs.h"
#include "sim/case/record/recording.h"
#include "sim/case/state.h"

namespace seldinger::assessment {

class ScriptedOperator {
 public:
  ScriptedOperator(const OperatorProfile& profile, const PuncturePlan& plan, const cases::Instrument& instrument,
                   std::uint64_t seed);

  // What the hands want in this tick. `frame` is the picture that appeared in it, if one did; target_moved_mm: how
  // far from its place at rest that picture shows the target, if it does.
  cases::Inputs act(const cases::State& state, const cases::FrameTruth* frame, double dt_s,
                    const glm::dvec3& target_moved_mm = glm::dvec3(0.0));

  // What was said or happened in the last tick: an operator with that skill stops when the patient is in trouble.
  void hear(cases::EventKind kind) { conduct_.hear(kind); }

  bool done() const noexcept { return phase_ == Phase::done; }

 private:
  enum class Phase {
    sign_in,
    scan,
    prepare,
    approach,
    advance,
    check,  // of the aim, before the organ is entered
    look,   // at the target, before the trigger
    withdraw,
    retreat,  // a little, to find a tip that is not seen
    hold_breath,
    await_breath,  // asked for and waited for, before it goes on as before
    fire,
    leave,
    finish,
    done
  };

  void enter(Phase phase);
  void aim();
  struct Seen {
    cases::FrameTruth frame;
    glm::dvec3 target_moved_mm;
  };
  const cases::FrameTruth* picture() const noexcept { return seen_.empty() ? nullptr : &seen_.front().frame; }
  glm::dvec3 target_now() const;
  bool tip_seen() const noexcept;
  glm::dvec3 hands_tip() const { return entry_ + direction_ * inserted_mm_; }
  double seen_miss_mm(const cases::State& state);
  void redirect();
  void decide(const cases::State& state);
  bool stops_for_breath();
  bool looked() const noexcept;
  void enter_or_redirect(Phase next, const cases::State& state);
  void show_deeds(const cases::State& state, cases::Inputs& inputs);
  void decide_in_advance();
  void decide_at_target(const cases::State& state);
  void decide_in_held_breath();
  void watch_breath(const cases::PatientBreath& breath);
  bool wants_breath() const noexcept;
  void ask_for_breath();
  bool breath_will_do() const noexcept;
  void put_plane_at(double inserted_mm);
  void judge_sight();
  void move(double dt_s);
  void hold_probe(cases::ToolPose& probe, double dt_s);
  double goal_mm() const noexcept;
  double scanned_share() const noexcept { return (t_s_ - phase_since_s_) / scan_s_; }
  double jiggle_mm() const noexcept;
  bool chance(double share) { return rng_.uniform() < share; }

  OperatorProfile profile_;
  PuncturePlan plan_;
  bool across_ = false;         // out of plane
  double stop_short_mm_ = 0.0;  // core: the throw carries the notch the rest of the way
  double thrown_mm_ = 0.0;      // core: so far ahead of the hand the tip is once it has fired
  base::Rng rng_;
  Conduct conduct_;
  Phase phase_ = Phase::sign_in;
  double t_s_ = 0.0, phase_since_s_ = 0.0, scan_s_ = 0.0;
  glm::dvec3 believed_target_{0.0}, entry_{0.0}, direction_{0.0};
  glm::dvec3 target_moved_mm_{0.0};  // from its place at rest, when the target was seen last
  double inserted_mm_ = 0.0;         // the hand's: from the entry along the direction, negative outside
  double withdraw_to_mm_ = 0.0;
  int redirections_ = 0;
  bool checked_ = false;
  bool begun_ = false;
  bool tests_side_ = false, measures_ = false;  // by deed; else he only says so
  bool looks_over_target_ = false;
  // Of a patient who breathes: what he does about it, and what is seen of the belly.
  bool breathes_ = false, asks_early_ = false, waits_ = false;
  bool still_ = false, seen_still_ = false, pauses_ = false;
  double still_changed_s_ = 0.0, asked_s_ = -1.0;
  Phase before_breath_ = Phase::advance;
  // A tip that should be seen and is not.
  bool lost_ = false, going_blind_ = false, retreated_ = false;
  double lost_since_s_ = 0.0, creep_to_mm_ = -1.0;
  // In plane: the probe's way out of the planned plane after the tip, and the share of its drift not yet corrected.
  double follow_mm_ = 0.0, alignment_ = 1.0;
  // Out of plane: the insertion that the plane was put on, where it is by now, and by how much it misses.
  double plane_at_mm_ = 0.0, plane_now_mm_ = 0.0, plane_error_mm_ = 0.0;
  UnsteadyHand hand_;
  Wander drift_, tilt_;
  std::deque<Seen> seen_;  // pictures younger than the reaction delay, and the one acted upon
};

}  // namespace seldinger::assessment
