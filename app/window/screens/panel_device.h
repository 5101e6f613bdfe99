// The hands at this desk: which there are, how they are, how they are set, and whether they are fit for an attempt.
#pragma once

#include <array>
#include <optional>

#include "app/hands/arms_seen.h"
#include "app/window/screens/panel_room.h"
#include "app/window/surface/trace.h"
#include "app/window/surface/window.h"
#include "app/window/trainer/trainer.h"

namespace seldinger::app {

// Two arms, live: where each is and what force it was asked for, over the last seconds. In the width there is, both
// hands beside each other; of so many pixels in height.
void draw_arm_traces(const ArmsSeen& arms, float height_px);

class DevicePanel {
 public:
  void draw(Trainer& trainer, const Keys& keys, const OtherHands& other);
  void tell(DevicePage& page, TraceLine& line) const;  // what there is to tell now

 private:
  void draw_hands(Trainer& trainer, const OtherHands& other);
  void draw_gains(Trainer& trainer);
  void lead_styli(const Keys& keys, LedArms& led, DevicePage& page);
  void draw_work(Trainer& trainer, const Keys& keys, DevicePage& page);
  void draw_check(const DevicePage::Seen& seen);
  void draw_calibration(Trainer& trainer, const Keys& keys, DevicePage& page);

  std::size_t side_ = 1;                       // whose arm the buttons are for
  const DevicePage* page_ = nullptr;           // for which the rest is
  std::optional<devices::DeviceGains> gains_;  // while they are moved
  std::array<LedStylus, 2> styli_;
  double led_s_ = 0.0;
  std::string kept_;  // what was done last, in words
};

}  // namespace seldinger::app
