// An attempt, tick by tick: hands through the arms into step, what they feel, and what a recording keeps of it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "assessment/recorder.h"
#include "sim/case/case.h"
#include "sim/case/state.h"
#include "sim/devices/virtual_device.h"
#include "sim/engine/patient.h"
#include "sim/haptics/two_hands.h"

namespace seldinger::app {

// Poses and forces are kept at 100 Hz.
constexpr std::uint64_t kPoseTicks = 10;

cases::PoseSample pose_of(const cases::State& state);

// What tissue asks of hands that hold needle and probe where `state` says. Without classes in the scene: nothing.
class ModelForces {
 public:
  explicit ModelForces(const cases::Case& scene);
  std::optional<cases::ForceSample> advance(const cases::State& state, double elapsed_s) noexcept;

 private:
  std::optional<haptics::TwoHands> hands_;
  haptics::HandStates states_{};
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

class AttemptTicks {
 public:
  // The scene must outlive it.
  explicit AttemptTicks(const cases::Case& scene) : scene_(scene), forces_(scene), patient_(scene) {}
  const cases::State& state() const noexcept { return state_; }

  // One tick of where hands want to be, and what it leaves behind. Allocates nothing.
  assessment::RecordedTick advance(const cases::Inputs& hands) noexcept;

 private:
  const cases::Case& scene_;
  ModelForces forces_;
  engine::Patient patient_;
  devices::VirtualDevice needle_arm_, probe_arm_;
  cases::State state_;
  std::uint64_t hash_ = 0;
};

}  // namespace seldinger::app
