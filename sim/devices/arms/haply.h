// Client of the Haply Inverse service: one connection, on a thread of its own, for the arms of both hands. An arm
// is known by its id, whatever its place in a message.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sim/devices/arms/websocket.h"
#include "sim/devices/haptic_arm.h"

namespace seldinger::devices {

struct HaplyIds {
  std::string arm, grip;
};

struct HaplySettings {
  WebSocketPlace place{};
  // By hand: left, right. Where both hands' are empty, arms and grips are given out once, when the service first
  // tells of them: an arm that says whose hand it is for goes there, the rest in the order of their ids.
  std::array<HaplyIds, 2> ids{};
  double most_force_n = 10.0;  // whatever is asked for (as sim/haptics has it for an Inverse3: design)
};

struct HaplyStatus {
  bool connected = false;
  std::uint64_t messages = 0, unusable = 0, connections = 0;
  std::vector<std::string> arms, grips;  // the ids in the last message
  std::array<HaplyIds, 2> ids;           // by hand: what is used
};

class Haply {
 public:
  explicit Haply(const HaplySettings& settings);
  ~Haply();

  HapticArm& hand(std::size_t side);  // 0 left, 1 right
  HaplyStatus status() const;         // locks: for windows and commands, not for the servo

 private:
  struct Connection;
  std::unique_ptr<Connection> connection_;
};

}  // namespace seldinger::devices
