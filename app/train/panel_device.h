// The hands at this desk: which there are, how they are, how they are set, and whether they are fit for an attempt.
#pragma once

#include <array>
#include <optional>

#include "app/train/panel_room.h"
#include "app/train/trace.h"
#include "app/train/trainer.h"
#include "app/train/window.h"

namespace seldinger::app {

class DevicePanel {
 public:
  void draw(Trainer& trainer, const Keys& keys, const OtherHands& other);
  void tell(DeviceBench& bench, TraceLine& line) const;  // what there is to tell now

 private:
  void draw_hands(Trainer& trainer, const OtherHands& other);
  void draw_gains(Trainer& trainer);
  void lead_styli(const Keys& keys, LedArms& led, DeviceBench& bench);
  void draw_work(Trainer& trainer, const Keys& keys, DeviceBench& bench);
  void draw_check(const DeviceBench::Seen& seen);
  void draw_calibration(Trainer& trainer, const Keys& keys, DeviceBench& bench);

  std::size_t side_ = 1;                       // whose arm the buttons are for
  const DeviceBench* bench_ = nullptr;         // for which the rest is
  std::optional<devices::DeviceGains> gains_;  // while they are moved
  std::array<LedStylus, 2> styli_;
  double led_s_ = 0.0;
  std::string kept_;  // what was done last, in words
};

}  // namespace seldinger::app
