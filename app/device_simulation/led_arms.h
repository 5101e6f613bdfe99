// Arms without hardware whose styli somebody leads, by mouse and keys or by a program: the simulated service within
// this one. Each is a virtual hand on a virtual device, so that it lags, gives way to forces, and is read through a
// socket as a real one is.
#pragma once

#include <array>
#include <memory>

#include "app/device_simulation/haply_simulation.h"
#include "sim/devices/arms/calibration.h"

namespace seldinger::app {

// Where a hand wants its stylus, in the arm's own axes.
struct LedStylus {
  glm::dvec3 at_mm{0.0, 100.0, 0.0};
  glm::dmat3 held{1.0};
  bool button = false;
};

class LedArms {
 public:
  // On a port of the system's choice. Refused as HaplySimulation.
  static base::Result<std::shared_ptr<LedArms>> start();

  devices::WebSocketPlace place() const noexcept;
  // Which of the two an arm's id names; no id of theirs: the hand's own, as the service gives them out.
  static std::size_t arm_of(const std::string& id, std::size_t side) noexcept;
  // By one thread at a time; waits for nothing.
  void lead(std::size_t arm, const LedStylus& stylus) noexcept;
  // And its device is there at once.
  void put(std::size_t arm, const LedStylus& stylus);
  // How it stands on the template, as two arms do on a desk: turned towards the user, to the left and to the right.
  static devices::Placement template_from_device(std::size_t arm) noexcept;

  HaplySimulation& service() noexcept { return *service_; }

 private:
  struct Led;
  LedArms() = default;
  std::array<std::shared_ptr<Led>, 2> led_;
  std::unique_ptr<HaplySimulation> service_;
};

}  // namespace seldinger::app
