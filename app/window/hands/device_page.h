// The arms at the desk without a patient: looked at, checked and calibrated. A servo of its own reads and drives
// them; no force is asked for but by a check. A service speaks with one program at a time, so this is not beside an
// attempt's hands.
#pragma once

#include <cstdint>
#include <memory>

#include "app/hands/desk_arms.h"
#include "sim/base/snapshot.h"
#include "sim/devices/arms/arm_check.h"
#include "sim/devices/arms/point_taking.h"
#include "sim/engine/servo_loop.h"

namespace seldinger::app {

class DevicePage {
 public:
  enum class Work { look, check, calibrate };
  struct Seen {
    ArmsSeen arms;
    Work work = Work::look;
    std::size_t side = 1;  // of whose arm it is
    devices::ArmCheck check;
    devices::PointTaking taking;
  };

  // Connects at once, and again whenever it has to.
  explicit DevicePage(const Arms& arms);

  // All by the window's thread; what is told is done in the next tick.
  void look();                   // and nothing else
  void check(std::size_t side);  // from its beginning
  void calibrate(std::size_t side);
  void go_on();  // a check: it reached far enough; a calibration: the stylus stands on the point
  void take_again(std::size_t point);
  void leave_out();    // the point that is asked for
  const Seen& seen();  // the newest
  devices::HaplyStatus status() const { return haply_.status(); }

 private:
  // The newest counts; presses add up, so that none is lost.
  struct Told {
    Work work = Work::look;
    std::size_t side = 1;
    std::uint32_t begun = 0, gone_on = 0, left_out = 0;
    std::array<std::uint32_t, devices::kTemplatePoints> again{};
  };
  void tell(Work work, std::size_t side);
  void tick(double elapsed_s) noexcept;
  void hear() noexcept;

  devices::Haply haply_;
  Told telling_;  // the window's
  base::Snapshot<Told> told_;
  Told heard_;  // the servo's, from here …
  bool going_on_ = false;
  Seen now_;
  ArmsWatch watch_;  // … to here
  base::Snapshot<Seen> seen_;
  Seen shown_;               // the window's
  engine::ServoLoop servo_;  // last: it uses the rest
};

}  // namespace seldinger::app
