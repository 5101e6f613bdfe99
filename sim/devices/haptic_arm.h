// What a force-feedback device is to the servo: where it is, and the force that it is to give. Neither call waits,
// allocates or locks; what a device needs of sockets and time happens on a thread of its own.
#pragma once

#include <bitset>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace seldinger::devices {

struct ArmReading {
  glm::dvec3 position_mm{0.0};  // in the device's own axes
  glm::dmat3 orientation{1.0};  // device's own axes from the stylus'; a rotation
  std::bitset<8> buttons;
  std::uint64_t count = 0;    // of readings so far; 0: none yet
  double age_s = 0.0;         // since it came
  double round_trip_s = 0.0;  // from a force said to the state that answered it, as last measured
  bool healthy = false;       // it is young enough to be followed
};

class HapticArm {
 public:
  // By the servo's thread only.
  virtual ArmReading poll() noexcept = 0;
  virtual void send(const glm::dvec3& force_n) noexcept = 0;  // in the device's own axes

 protected:
  ~HapticArm() = default;
};

// A device that has been silent for kHoldS is lost: it is not followed, and its force goes to nothing evenly, by
// kGoneS. With a cycle of the link it is gone in 20 ms (docs/touch.md, S16).
inline constexpr double kHoldS = 0.008, kGoneS = 0.016;
inline double share_of_force(double silent_s) noexcept {
  if (silent_s <= kHoldS) return 1.0;
  return silent_s < kGoneS ? (kGoneS - silent_s) / (kGoneS - kHoldS) : 0.0;
}

// Whole servo ticks from encoder to motor, as a force law wants them told; at least one.
int delay_ticks(const ArmReading& reading, double tick_s) noexcept;

}  // namespace seldinger::devices
