// What two arms say and are told, as somebody beside them sees it: the newest reading, how often readings come, and
// the last seconds of places and forces.
#pragma once

#include <array>

#include "sim/devices/arms/live_trace.h"
#include "sim/devices/haptic_arm.h"

namespace seldinger::app {

struct ArmSeen {
  devices::ArmReading reading;
  double readings_per_s = 0.0;  // lately
  glm::dvec3 asked_n{0.0};      // of the motors, in the arm's own axes
  std::array<devices::LiveTrace, 3> at_mm;
  devices::LiveTrace force_n;  // as long as that is
};
using ArmsSeen = std::array<ArmSeen, 2>;  // by haptics::Side

// By the servo, which polls and sends; allocates nothing.
class ArmsWatch {
 public:
  void see(std::size_t side, const devices::ArmReading& reading, const glm::dvec3& asked_n,
           double elapsed_s) noexcept;
  // Once a tick: whether it is time to show what was seen (50 times a second).
  bool due(double elapsed_s) noexcept;
  const ArmsSeen& seen() const noexcept { return seen_; }

 private:
  ArmsSeen seen_;
  std::array<std::uint64_t, 2> counted_{};
  std::array<double, 2> counted_for_s_{};
  double shown_for_s_ = 0.0;
};

}  // namespace seldinger::app
