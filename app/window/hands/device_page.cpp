#include "app/window/hands/device_page.h"

namespace seldinger::app {

DevicePage::DevicePage(const Arms& arms)
    : haply_(haply_settings(arms.station, arms.place)), servo_({}, [this](double elapsed_s) { tick(elapsed_s); }) {}

void DevicePage::tell(Work work, std::size_t side) {
  telling_.work = work;
  telling_.side = side;
  ++telling_.begun;
  told_.put(telling_);
}
void DevicePage::look() {
  tell(Work::look, telling_.side);
}
void DevicePage::check(std::size_t side) {
  tell(Work::check, side);
}
void DevicePage::calibrate(std::size_t side) {
  tell(Work::calibrate, side);
}
void DevicePage::go_on() {
  ++telling_.gone_on;
  told_.put(telling_);
}
void DevicePage::take_again(std::size_t point) {
  ++telling_.again.at(point);
  told_.put(telling_);
}
void DevicePage::leave_out() {
  ++telling_.left_out;
  told_.put(telling_);
}

const DevicePage::Seen& DevicePage::seen() {
  if (const auto newest = seen_.take()) shown_ = *newest;
  return shown_;
}

void DevicePage::hear() noexcept {
  const auto told = told_.take();
  if (!told) return;
  if (told->begun != heard_.begun) {
    now_.work = told->work;
    now_.side = told->side;
    now_.check = {};
    now_.taking = {};
  }
  going_on_ = going_on_ || told->gone_on != heard_.gone_on;
  for (std::size_t point = 0; point < told->again.size(); ++point)
    if (told->again[point] != heard_.again[point]) now_.taking.again(point);
  if (told->left_out != heard_.left_out) now_.taking.leave_out();
  heard_ = *told;
}

void DevicePage::tick(double elapsed_s) noexcept {
  hear();
  for (std::size_t side = 0; side < 2; ++side) {
    devices::HapticArm& hand = haply_.hand(side);
    const devices::ArmReading reading = hand.poll();
    glm::dvec3 force_n(0.0);
    if (side == now_.side && now_.work == Work::check) {
      if (going_on_) now_.check.enough_reach();
      force_n = now_.check.advance(reading, elapsed_s);
    } else if (side == now_.side && now_.work == Work::calibrate) {
      now_.taking.advance(reading, going_on_, elapsed_s);
    }
    hand.send(force_n);
    watch_.see(side, reading, force_n, elapsed_s);
  }
  going_on_ = false;
  if (!watch_.due(elapsed_s)) return;
  now_.arms = watch_.seen();
  seen_.put(now_);
}

}  // namespace seldinger::app
