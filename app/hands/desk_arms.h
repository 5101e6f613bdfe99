// Two force-feedback arms at the desk: what the servo reads of them and says to them, for one case. Readings become
// poses of needle and probe in the patient, forces go back to the motors.
#pragma once

#include <array>

#include "app/device_simulation/led_arms.h"
#include "app/hands/arms_seen.h"
#include "app/hands/station.h"
#include "sim/case/case.h"
#include "sim/devices/arms/arm_mapping.h"
#include "sim/haptics/two_hands.h"

namespace seldinger::app {

// How both arms stand to a case: the template lies in the patient as his position and the planned entry say
// (without one, the skin above the target; without a lesion, the volume's middle), the user on the entry's side. A
// side that the station does not know stands as if its arm's axes were the template's.
std::array<devices::ArmMapping, 2> arm_mappings(const Station& station, const cases::Case& scene);

devices::HaplySettings haply_settings(const Station& station, const devices::WebSocketPlace& place);

// Which arms there are, and where their service is.
struct Arms {
  Station station{};
  devices::WebSocketPlace place{};
  std::filesystem::path station_file{};  // where what is changed of the station is kept; empty: in here only
  std::shared_ptr<LedArms> led{};        // there is no hardware: mouse and keys lead the arms
};

class DeskArms {
 public:
  // Connects at once, and again whenever it has to.
  DeskArms(const Station& station, const cases::Case& scene, haptics::Handedness handedness,
           const devices::WebSocketPlace& place = {});

  // By the servo's thread, once a tick; allocates and waits for nothing. Poses and trigger go into `inputs` (an arm
  // that is lost leaves its tool where it stayed), both hands into `hands` for TwoHands. The needle's first button
  // fires; the probe's freezes the picture and lets it go. needle_outside, probe_off: so far from the body that a
  // re-gripped tool may go back to its hand.
  void read(bool needle_outside, bool probe_off, double elapsed_s, cases::Inputs& inputs,
            haptics::HandInputs& hands) noexcept;
  void send(const haptics::HandForces& forces, double elapsed_s) noexcept;
  ArmsWatch& watch() noexcept { return watch_; }  // of what was read and sent
  // Where an arm's stylus is to be so that its tool is there.
  LedStylus stylus_for(haptics::Side side, const cases::ToolPose& pose) const noexcept;

  // By the servo's thread, too: a lost arm's tool is held by something else, and is here.
  void leave_at(haptics::Side side, const cases::ToolPose& pose) noexcept {
    hands_[static_cast<std::size_t>(side)].leave_at(pose);
  }
  // An arm that answers now and then is not followed: as if it were lost.
  void let_go(haptics::Side side) noexcept { hands_[static_cast<std::size_t>(side)].let_go(); }
  // No time goes by: whatever the arms do meanwhile, the tools stay, and are re-gripped afterwards.
  void let_go() noexcept {
    for (devices::ArmMapping& hand : hands_) hand.let_go();
  }

  bool healthy(haptics::Side side) const noexcept { return hands_[static_cast<std::size_t>(side)].healthy(); }
  devices::HaplyStatus status() const { return haply_.status(); }  // locks: not for the servo

 private:
  haptics::Handedness handedness_;
  std::array<devices::ArmMapping, 2> hands_;
  std::array<bool, 2> pressed_{};  // as each arm last said
  bool frozen_ = false;
  std::array<devices::ArmReading, 2> readings_{};
  ArmsWatch watch_;
  devices::Haply haply_;
};

}  // namespace seldinger::app
