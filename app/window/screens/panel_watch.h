// An attempt that is watched: the room and the guidance as they were, what was said, and how fast it goes.
#pragma once

#include <memory>

#include "app/window/screens/panel_monitor.h"
#include "app/window/screens/panel_room.h"
#include "app/window/sound/speaker.h"
#include "app/window/surface/trace.h"
#include "app/window/trainer/trainer.h"

namespace seldinger::app {

class WatchPanel {
 public:
  WatchPanel(gpu::Context& context, Speaker& speaker) : speaker_(speaker), room_(context), monitor_(context) {}

  void draw(Trainer& trainer, const Keys& keys);
  void tell(TraceLine& line) const { line.watched_s = seen_.moment.state.t_s; }
  MonitorPanel& guidance() noexcept { return monitor_; }
  void end() noexcept {  // the next is another, or the same from elsewhere on
    if (shown_.empty()) return;
    room_.end();
    shown_.clear();
    seen_ = {};
  }

 private:
  void draw_course(Trainer& trainer, const Keys& keys);

  Speaker& speaker_;
  RoomPanel room_;
  MonitorPanel monitor_;
  std::string shown_;  // the attempt whose room is drawn
  Seen seen_;
  double drawn_s_ = 0.0;
};

}  // namespace seldinger::app
