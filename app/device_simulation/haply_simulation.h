// A Haply Inverse service without hardware, on loopback: two arms, each a virtual hand on a virtual device along
// three axes (haptics/hand_rig), stepped at 1 kHz, that tell their state in answer to forces as the service
// does. It can be made to fail as services do.
#pragma once

#include <array>
#include <bitset>
#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <string>

#include "sim/base/result.h"
#include "sim/devices/arms/websocket.h"
#include "sim/haptics/arm_model.h"

namespace seldinger::app {

struct SimulatedArm {
  std::string id, grip, handedness;
  // Where the hand wants it, mm in the arm's axes, and how it holds the stylus, after t_s.
  std::function<glm::dvec3(double t_s)> at_mm;
  std::function<glm::dmat3(double t_s)> held;
  haptics::Hand hand;
  std::function<std::bitset<8>(double t_s)> buttons{};  // of the stylus; none: nobody presses any
};

// Two arms that go slowly round a circle of 20 mm.
std::array<SimulatedArm, 2> circling_arms();

struct SimulatedFaults {
  bool silent = false;              // hears, and says nothing
  bool away = false;                // nobody is let in, and who is in has to go
  double delay_s = 0.0;             // of what it says
  bool swapped = false;             // tells of the second arm first
  std::array<bool, 2> unplugged{};  // arms that it does not tell of
};

// What the simulation knows of an arm that a client does not.
struct SimulatedArmState {
  glm::dvec3 at_mm{0.0};
  glm::dvec3 asked_n{0.0};  // by the last command
  glm::dvec3 motor_n{0.0};  // as it acts
  std::uint64_t commands = 0;
  double silent_s = 0.0;  // between the last state that was told and the last command
};

class HaplySimulation {
 public:
  // The motors let go when no command came for this long (design: what the real service does is not known to us).
  static constexpr double kWatchdogS = 0.02;

  static base::Result<std::unique_ptr<HaplySimulation>> start(const devices::WebSocketPlace& place,
                                                              const std::array<SimulatedArm, 2>& arms);
  ~HaplySimulation();

  int port() const noexcept;
  void set(const SimulatedFaults& faults);
  void say_once(const std::string& text, bool raw);  // beside its answers: in a message, or as bytes of TCP
  void hang_up();
  void put(std::size_t i, const glm::dvec3& at_mm);  // the device is there now, at rest
  SimulatedArmState arm(std::size_t i) const;
  std::uint64_t connections() const;
  std::string message() const;  // as it would say it now

 private:
  HaplySimulation();
  struct Service;
  std::unique_ptr<Service> service_;
};

}  // namespace seldinger::app
