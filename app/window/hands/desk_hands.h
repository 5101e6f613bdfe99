// The hands at the workstation, tick by tick: two arms where there are any and they answer, mouse, keys and their
// like for what no arm holds. Everything but the constructor is the servo's: it allocates and waits for nothing.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "app/hands/desk_arms.h"
#include "app/window/hands/braced_hand.h"
#include "sim/devices/hands/hands.h"
#include "sim/engine/tick.h"
#include "sim/haptics/two_hands.h"

namespace seldinger::app {

// A stall of the machine is no news; who is silent for so long is said to be lost (design). What it holds stays at
// once. Who answers now and then is silent, too: a moment of answers is worth kForgivenTimes as much silence.
inline constexpr double kSaidLostS = 0.1, kForgivenTimes = 3.0;

// One answer too late takes the force, which comes back over haptics::kReturnS: some ten of them a second take
// nearly all of it. An arm is late that has been without a third of its force for so long (design), a moment of it
// counted as above.
inline constexpr double kSaidLateS = 1.0;

// What is held back comes and goes with each layer; so long it is said (design), and what is less nobody feels:
// some 7 % of 1.5 N (Jones 1989, recalled).
inline constexpr double kSaidLimitS = 1.0, kFeltLessN = 0.1;

// Whether a limit is said in this tick, after which left_s says how much longer; `held_back_n` of what was asked
// for.
bool limit_is_said(double held_back_n, double elapsed_s, double& left_s) noexcept;

struct LateWatch {
  double returning_s = 0.0;  // until a third of the force that the last answer too late took is back
  double lasted_s = 0.0;     // without that
};
// Whether an arm is said to be late in this tick; `too_late`: it answers, but not in time to give force.
bool late_is_said(bool too_late, double elapsed_s, LateWatch& watch) noexcept;

// By haptics::Side.
struct ArmsHeld {
  bool used = false;                     // else there are none
  std::array<bool, 2> lost{true, true};  // nothing was heard for kSaidLostS, or ever
  std::array<bool, 2> late{};            // it is followed, but answers too late, too often, to give force
  std::array<bool, 2> at_limit{};        // within kSaidLimitS, tissue resisted with more than its motors give
  std::array<haptics::Tool, 2> tools{haptics::Tool::none, haptics::Tool::none};
};

class DeskHands {
 public:
  // Scene and skin must outlive it. arms: nullptr: none. They are connected to at once.
  DeskHands(const cases::Case& scene, const devices::HandsStart& start, const devices::HandsSettings& settings,
            haptics::Handedness handedness, const Arms* arms);

  // Before the first tick, where an attempt goes on: tools are where they were left, and arms are re-gripped there.
  void take_over(const cases::Inputs& left, const cases::State& state) noexcept;

  // One tick: poses, trigger and frozen picture into `inputs`, whose fluoroscope is told already: with the hand
  // away what it held stays where it is, and is taken up there. The tool of a lost arm stays until mouse or keys
  // move it; an arm that comes back goes on from where its tool is then.
  void advance(const devices::HandIntent& intent, const cases::State& state, const devices::AxialForces& forces,
               double elapsed_s, cases::Inputs& inputs) noexcept;
  // What the arms feel of the tick that was done goes to their motors.
  void feel(const engine::Tick& tick, const engine::TickState& now, double elapsed_s) noexcept;
  // Instead of both while no time goes by, and before the tick that follows a stall.
  void let_go() noexcept;

  const devices::Hands& mouse() const noexcept { return mouse_; }
  // The tool is where mouse and keys led it last.
  bool mouse_leads(haptics::Tool tool) const noexcept;
  // What of the last tick's poses an arm said.
  engine::ToolsRead read() const noexcept;
  // How far the probe's face is below the skin at rest, whoever holds it; negative: above. At most kLookMm.
  double press_mm(const cases::State& state) const noexcept;
  // None: there are no arms.
  ArmsWatch* watch() noexcept { return desk_ ? &desk_->watch() : nullptr; }
  // What the arms are, for the attempt's conditions: "inverse3", "simulated inverse3"; nothing: there are none.
  std::optional<std::string> arm_model() const;
  bool frozen() const noexcept { return last_.freeze; }
  const ArmsHeld& arms() const noexcept { return arms_; }

 private:
  cases::ToolPose& pose_in(cases::Inputs& inputs, std::size_t side) const noexcept;
  void lead(const cases::Inputs& wanted) noexcept;
  void read_arms(const cases::State& state, const devices::AxialForces& forces, double elapsed_s,
                 cases::Inputs& inputs) noexcept;
  static constexpr double kLookMm = 60.0;

  const cases::Case& scene_;
  std::shared_ptr<LedArms> led_;              // whose styli the mouse leads,
  std::array<std::size_t, 2> led_arm_{0, 1};  // by side

  devices::Hands mouse_;
  BracedHand braced_;
  cases::Inputs last_;
  ArmsHeld arms_;
  std::array<double, 2> silent_s_{kSaidLostS, kSaidLostS}, limit_s_{};
  std::array<LateWatch, 2> late_{};
  bool away_ = false;              // the hand was, in the last tick
  bool pulled_away_ = false;       // and its arm's trigger was pulled meanwhile, and is still
  std::array<bool, 2> arm_led_{};  // last, and so the mouse's own pose of it is old
  haptics::HandInputs held_;
  haptics::HandStates felt_;
  std::optional<haptics::TwoHands> forces_;
  std::unique_ptr<DeskArms> desk_;
};

}  // namespace seldinger::app
