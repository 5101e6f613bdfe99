#include "app/device_simulation/led_arms.h"

#include <cmath>

#include "sim/base/check.h"
#include "sim/base/snapshot.h"

namespace seldinger::app {
namespace {

// As circling_arms names them.
constexpr const char *kLeftId = "sim-left", *kRightId = "sim-right";

}  // namespace

struct LedArms::Led {
  base::Snapshot<LedStylus> told;
  LedStylus now;  // the service's
};

base::Result<std::shared_ptr<LedArms>> LedArms::start() {
  std::shared_ptr<LedArms> arms(new LedArms);
  std::array<SimulatedArm, 2> simulated = circling_arms();
  for (std::size_t side = 0; side < 2; ++side) {
    auto led = arms->led_[side] = std::make_shared<Led>();
    simulated[side].at_mm = [led](double) {
      if (const auto newest = led->told.take()) led->now = *newest;
      return led->now.at_mm;
    };
    simulated[side].held = [led](double) { return led->now.held; };
    simulated[side].buttons = [led](double) { return std::bitset<8>(led->now.button ? 1U : 0U); };
  }
  devices::WebSocketPlace any;
  any.port = 0;
  auto service = HaplySimulation::start(any, simulated);
  if (!service) return service.error();
  arms->service_ = std::move(*service);
  return arms;
}

devices::WebSocketPlace LedArms::place() const noexcept {
  devices::WebSocketPlace place;
  place.port = service_->port();
  return place;
}

std::size_t LedArms::arm_of(const std::string& id, std::size_t side) noexcept {
  return id == kLeftId ? 0 : id == kRightId ? 1 : side;
}

void LedArms::lead(std::size_t arm, const LedStylus& stylus) noexcept {
  CHECK(arm < 2);
  led_[arm]->told.put(stylus);
}

void LedArms::put(std::size_t arm, const LedStylus& stylus) {
  lead(arm, stylus);
  service_->put(arm, stylus.at_mm);
}

devices::Placement LedArms::template_from_device(std::size_t arm) noexcept {
  constexpr double kTurnedRad = 0.35, kAsideMm = 120.0, kBehindMm = -60.0;
  const double sign = arm == 0 ? 1.0 : -1.0, sine = std::sin(sign * kTurnedRad), cosine = std::cos(kTurnedRad);
  devices::Placement placement;
  placement.rotation = {{cosine, 0.0, -sine}, {0.0, 1.0, 0.0}, {sine, 0.0, cosine}};
  placement.translation_mm = {-sign * kAsideMm, 0.0, kBehindMm};
  return placement;
}

}  // namespace seldinger::app
