#include "app/device_simulation/haply_simulation.h"

#include <chrono>
#include <cmath>
#include <deque>
#include <mutex>
#include <vector>

#include "sim/devices/arms/haply_json.h"
#include "sim/haptics/hand_rig.h"

namespace seldinger::app {
namespace {

constexpr double kMPerMm = 0.001;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point then) {
  return std::chrono::duration<double>(Clock::now() - then).count();
}

struct Arm {
  Arm(const SimulatedArm& what, const haptics::ArmModel& row) : arm(what), device(row) { stand(arm.at_mm(0.0)); }
  void stand(const glm::dvec3& at_mm) {
    axes.clear();
    for (int i = 0; i < 3; ++i) axes.emplace_back(device, arm.hand, at_mm[i], 0.0);
  }
  SimulatedArm arm;
  haptics::ArmModel device;
  std::vector<haptics::HandRig> axes;
  glm::dvec3 asked_n{0.0};
  Clock::time_point asked{};
  std::uint64_t commands = 0;
};

}  // namespace

std::array<SimulatedArm, 2> circling_arms() {
  const auto circle = [](double phase) {
    return [phase](double t_s) {
      const double angle = 2.0 * t_s + phase;
      return glm::dvec3(20.0 * std::cos(angle), 100.0 + 20.0 * std::sin(angle), 10.0 * std::sin(0.5 * angle));
    };
  };
  const auto upright = [](double) { return glm::dmat3(1.0); };
  const haptics::Hand hand = *haptics::find_hand("medium");
  return {SimulatedArm{"sim-left", "sim-grip-left", "left", circle(0.0), upright, hand},
          SimulatedArm{"sim-right", "sim-grip-right", "right", circle(3.0), upright, hand}};
}

struct HaplySimulation::Service final : devices::WebSocketPeer {
  Service(const std::array<SimulatedArm, 2>& what) {
    for (const SimulatedArm& arm : what) arms.emplace_back(arm, *haptics::find_arm_model("inverse3"));
  }

  void opened(devices::WebSocketLink& link) override {
    const std::lock_guard lock(mutex);
    if (faults.away) return link.hang_up();
    ++connections;
    later.clear();
    tell(link);
  }
  void closed() override {
    const std::lock_guard lock(mutex);
    owed = false;
  }
  void heard(devices::WebSocketLink&, std::string_view text) override {
    const auto forces = devices::haply_forces(text);
    if (!forces) return;
    const std::lock_guard lock(mutex);
    for (const devices::HaplyForce& force : *forces)
      for (Arm& arm : arms)
        if (arm.arm.id == force.id) {
          arm.asked_n = force.force_n;
          arm.asked = Clock::now();
          ++arm.commands;
        }
    owed = true;
  }
  void ticked(devices::WebSocketLink* link) override {
    const std::lock_guard lock(mutex);
    move();
    if (link == nullptr) return;
    if (hangs_up || faults.away) {
      hangs_up = false;
      return link->hang_up();
    }
    if (!once.empty()) {
      if (once_raw)
        link->say_raw(once);
      else
        link->say(once);
      once.clear();
    } else if (owed && !faults.silent) {
      owed = false;
      tell(*link);
    }
    if (!later.empty() && later.front().first <= Clock::now()) {
      link->say(later.front().second);
      later.pop_front();
    }
  }

  void move() {
    const double t_s = seconds_since(start);
    for (Arm& arm : arms) {
      const glm::dvec3 now = arm.arm.at_mm(t_s), next = arm.arm.at_mm(t_s + haptics::kTickS);
      const glm::dvec3 force_n = seconds_since(arm.asked) > kWatchdogS ? glm::dvec3(0.0) : arm.asked_n;
      // A force on an axis moves it that way; the rig counts one that pushes back.
      for (int i = 0; i < 3; ++i)
        arm.axes[static_cast<std::size_t>(i)].hold(-force_n[i],
                                                   {now[i], (next[i] - now[i]) / haptics::kTickS, 0.0});
    }
  }

  std::size_t place_of(const Arm& arm) const { return static_cast<std::size_t>(&arm - arms.data()); }

  devices::HaplyMessage state() const {
    devices::HaplyMessage message;
    const double t_s = seconds_since(start);
    for (const Arm& arm : arms) {
      if (faults.unplugged[place_of(arm)]) continue;
      const glm::dvec3 at_mm(arm.axes[0].encoder_mm(), arm.axes[1].encoder_mm(), arm.axes[2].encoder_mm());
      message.arms.push_back({arm.arm.id, arm.arm.handedness, at_mm * kMPerMm});
      message.grips.push_back(
          {arm.arm.grip, arm.arm.held(t_s), arm.arm.buttons ? arm.arm.buttons(t_s) : std::bitset<8>()});
    }
    if (faults.swapped && message.arms.size() == 2) {
      std::swap(message.arms[0], message.arms[1]);
      std::swap(message.grips[0], message.grips[1]);
    }
    return message;
  }

  void tell(devices::WebSocketLink& link) {
    const std::string text = text_of(state());
    if (faults.delay_s > 0.0)
      later.emplace_back(
          Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(faults.delay_s)),
          text);
    else
      link.say(text);
    told = Clock::now();
  }

  mutable std::mutex mutex;
  std::vector<Arm> arms;
  SimulatedFaults faults;
  Clock::time_point start = Clock::now(), told = start;
  std::deque<std::pair<Clock::time_point, std::string>> later;
  std::string once;
  bool once_raw = false, owed = false, hangs_up = false;
  std::uint64_t connections = 0;
  std::unique_ptr<devices::WebSocketServer> server;  // last: its thread uses the rest
};

HaplySimulation::HaplySimulation() = default;
HaplySimulation::~HaplySimulation() = default;

base::Result<std::unique_ptr<HaplySimulation>> HaplySimulation::start(const devices::WebSocketPlace& place,
                                                                      const std::array<SimulatedArm, 2>& arms) {
  std::unique_ptr<HaplySimulation> simulation(new HaplySimulation);
  simulation->service_ = std::make_unique<Service>(arms);
  auto server = devices::WebSocketServer::listen(place, *simulation->service_);
  if (!server) return server.error();
  simulation->service_->server = std::move(*server);
  return simulation;
}

int HaplySimulation::port() const noexcept {
  return service_->server->port();
}

void HaplySimulation::set(const SimulatedFaults& faults) {
  const std::lock_guard lock(service_->mutex);
  service_->faults = faults;
}

void HaplySimulation::say_once(const std::string& text, bool raw) {
  const std::lock_guard lock(service_->mutex);
  service_->once = text;
  service_->once_raw = raw;
}

void HaplySimulation::hang_up() {
  const std::lock_guard lock(service_->mutex);
  service_->hangs_up = true;
}

void HaplySimulation::put(std::size_t i, const glm::dvec3& at_mm) {
  const std::lock_guard lock(service_->mutex);
  service_->arms.at(i).stand(at_mm);
}

SimulatedArmState HaplySimulation::arm(std::size_t i) const {
  const std::lock_guard lock(service_->mutex);
  const Arm& arm = service_->arms.at(i);
  SimulatedArmState state;
  for (int axis = 0; axis < 3; ++axis) {
    state.at_mm[axis] = arm.axes[static_cast<std::size_t>(axis)].at_mm();
    state.motor_n[axis] = -arm.axes[static_cast<std::size_t>(axis)].motor_n();
  }
  state.asked_n = arm.asked_n;
  state.commands = arm.commands;
  state.silent_s = std::chrono::duration<double>(arm.asked - service_->told).count();
  return state;
}

std::uint64_t HaplySimulation::connections() const {
  const std::lock_guard lock(service_->mutex);
  return service_->connections;
}

std::string HaplySimulation::message() const {
  const std::lock_guard lock(service_->mutex);
  return text_of(service_->state());
}

}  // namespace seldinger::app
