// One tick of two hands: from where the devices are and which tool each holds to the force that goes to their
// motors. Pure: no clock, allocation, lock or global; what must be remembered is one plain value. A tissue that one
// hand moves is not yet felt by the other.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "sim/haptics/arm_model.h"
#include "sim/haptics/force_limiter.h"
#include "sim/haptics/needle/held_needle.h"
#include "sim/haptics/probe/held_probe.h"
#include "sim/haptics/proxy/surface_proxy.h"
#include "sim/haptics/proxy/volume_proxy.h"

namespace seldinger::haptics {

// A finger palpates the skin where there is no probe; a pointer touches the bone in the CT, as if nothing lay over
// it.
enum class Tool { none, needle, probe, finger, pointer };
inline constexpr int kTools = 5;
enum class Side { left, right };
enum class Handedness { right, left };

// A right-handed user punctures with the right hand, and the other way round.
constexpr Tool tool_of(Handedness handedness, Side side) noexcept {
  return (handedness == Handedness::right) == (side == Side::right) ? Tool::needle : Tool::probe;
}

struct HandSettings {
  ArmModel device;
  double carried_kg = 0.0;  // of tool and stylus, that the device does not bear by itself (design: none)
};

// What one device says in a tick. A pose that is none (not finite, no direction) is a fault.
struct HandInput {
  cases::ToolPose pose;
  Tool tool = Tool::none;
  bool healthy = true;                         // the device answers
  int delay_ticks = 1;                         // from encoder to motor as it is now; above kMostDelayTicks: a fault
  std::span<const glm::dvec3> nicks_lps_mm{};  // where the skin is cut, at rest
  Introducer introducer = Introducer::none;    // of a needle
};

// What must be kept of one hand. A new one: nothing is held.
struct HandState {
  Tool tool = Tool::none;
  HeldNeedleState needle;
  HeldProbeState probe;
  SurfaceTrack finger;
  VolumeProxyTrack pointer;
  ForceLimiterState limiter;
  glm::dvec3 last_lps_mm{0.0};  // where it was last followed
  int delay_ticks = 0;          // for which the laws are as stiff as they are
  bool interrupted = false;     // it could not be followed
};

struct HandForce {
  glm::dvec3 motor_n{0.0};   // what goes to the motors
  glm::dvec3 wanted_n{0.0};  // what tissue and gravity ask for
  bool ruptured = false;     // the needle entered a layer: the declared event
};

// By Side.
using HandInputs = std::array<HandInput, 2>;
using HandStates = std::array<HandState, 2>;
using HandForces = std::array<HandForce, 2>;

// Two arms without hardware, as stiff as a Phantom Omni bears.
std::array<HandSettings, 2> two_virtual_arms();

class TwoHands {
 public:
  // The scene has a class per voxel (CHECKed) and must outlive this; its instrument is the needle.
  TwoHands(const cases::Case& scene, const std::array<HandSettings, 2>& settings);

  // One tick, `elapsed_s` after the last. Laws are as stiff as bound / 1.4 allows for the delay; a longer delay
  // softens them at once, a shorter one stiffens them once nothing is touched. Taking up another tool lets its
  // force in slowly.
  HandForces advance(const HandInputs& inputs, double elapsed_s, HandStates& states) const noexcept;

 private:
  struct Laws {
    NeedleLaw needle;
    NeedleSideLaw side;
    ProbeLaw probe;
    SurfaceProxy finger;
    VolumeProxy pointer;
  };
  struct Station {
    std::vector<Laws> laws;  // by ticks of delay
    ForceLimiter limiter;
    glm::dvec3 bear_n;  // against gravity
  };
  Station station(const HandSettings& settings, cases::TouchLaw law) const;
  HandForce advance(const Station& station, const HandInput& input, double elapsed_s,
                    HandState& state) const noexcept;

  const cases::MeshIndex* skin_;
  IsoSurface bone_;
  HeldNeedle needle_;
  HeldProbe probe_;
  glm::dvec3 up_;
  std::array<Station, 2> stations_;
};

}  // namespace seldinger::haptics
