// An attempt, tick by tick: hands through the arms into step, what they feel, and what a recording keeps of it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "assessment/recorder.h"
#include "sim/case/case.h"
#include "sim/case/state.h"
#include "sim/devices/virtual_device.h"
#include "sim/engine/moving_tissue.h"
#include "sim/engine/patient.h"
#include "sim/haptics/two_hands.h"

namespace seldinger::app {

// Poses and forces are kept at 100 Hz.
constexpr std::uint64_t kPoseTicks = 10;

cases::PoseSample pose_of(const cases::State& state);

// What is shown of a tick, by whoever draws: where everything is, and what the hands feel.
struct Moment {
  cases::State state;
  tissue::Displacement displacement{};
  std::optional<cases::ForceSample> force{};           // none: nothing is felt in this case
  cases::EventKind reaction = cases::EventKind::none;  // the patient's last
  double reaction_t_s = 0.0;
  cases::EventKind event = cases::EventKind::none;  // what was said, or a mentor let happen, last
  double event_t_s = 0.0;
  std::uint32_t capsules = 0;  // that the needle opened since the beginning,
  double capsule_n = 0.0;      // and the force that the last one took
  double told_s = 0.0;  // when what the hands wanted last was told, by whoever's clock told it; 0: it was not
};

// The room, tick by tick: the step, the tissue that moves, what it asks of the hands, and how the patient reacts.
// The same for an attempt and for its replay.
class Room {
 public:
  // The scene must outlive it. Without classes in it nothing is felt, and hands move no tissue.
  explicit Room(const cases::Case& scene);
  const cases::State& state() const noexcept { return state_; }
  // Of the tick that was done: where what pictures show is.
  const tissue::Displacement& displacement() const noexcept { return displacement_; }
  Moment moment() const noexcept {
    return {state_, displacement_, force_, reaction_, reaction_t_s_, event_, event_t_s_, capsules_, capsule_n_};
  }
  // From where a hand holds its tool to where that is in tissue at rest, by which forces are told.
  void bring_to_rest(haptics::HandInput& hand) const noexcept;

  // One tick, and what it leaves behind. Allocates nothing.
  assessment::RecordedTick advance(const cases::Inputs& inputs, double dt_s) noexcept;

 private:
  std::optional<cases::ForceSample> feel(double elapsed_s) noexcept;
  void note_capsule(const haptics::HeldNeedleState& needle) noexcept;
  std::optional<glm::dvec3> rest_of(const glm::dvec3& tip_lps_mm) const noexcept;

  const cases::Case& scene_;
  engine::MovingTissue tissue_;
  std::optional<haptics::TwoHands> hands_;
  haptics::HandStates hand_states_{};
  engine::Patient patient_;
  tissue::Displacement displacement_{};
  std::optional<cases::ForceSample> force_;
  cases::EventKind reaction_ = cases::EventKind::none;
  double reaction_t_s_ = 0.0;
  cases::EventKind event_ = cases::EventKind::none;
  double event_t_s_ = 0.0;
  std::uint32_t capsules_ = 0;
  double capsule_n_ = 0.0;
  cases::State state_;
  std::uint64_t hash_ = 0;
};

// A mentor's events, each put into the first tick from its time on in which nobody else says anything.
class Scenario {
 public:
  // By rising time; what they lie in outlives it.
  explicit Scenario(std::span<const cases::Event> events) : events_(events) {}
  void add_to(cases::Inputs& inputs, double t_s) noexcept {
    if (events_.empty() || t_s < events_.front().t_s || inputs.event != cases::EventKind::none) return;
    inputs.event = events_.front().kind;
    events_ = events_.subspan(1);
  }

 private:
  std::span<const cases::Event> events_;
};

// Which tools an arm says the place of; a hand's wish passes the virtual arm first.
struct ToolsRead {
  bool needle = false, probe = false;
};

// An attempt: hands through the arms into the room.
class AttemptTicks {
 public:
  // The scene must outlive it.
  explicit AttemptTicks(const cases::Case& scene) : room_(scene) {}
  const cases::State& state() const noexcept { return room_.state(); }
  const tissue::Displacement& displacement() const noexcept { return room_.displacement(); }
  Moment moment() const noexcept { return room_.moment(); }
  const Room& room() const noexcept { return room_; }

  // One tick of where hands want to be, and what it leaves behind. Allocates nothing.
  assessment::RecordedTick advance(const cases::Inputs& hands, ToolsRead read = {}) noexcept;

 private:
  Room room_;
  devices::VirtualDevice needle_arm_, probe_arm_;
};

}  // namespace seldinger::app
