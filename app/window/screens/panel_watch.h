// An attempt that is watched: the room and the guidance as they were, what was said and happened, and how fast it
// goes; or one's own beside an expert's, so that both needles go through the skin at once.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "app/window/screens/panel_monitor.h"
#include "app/window/screens/panel_room.h"
#include "app/window/sound/speaker.h"
#include "app/window/surface/attempt_layout.h"
#include "app/window/surface/trace.h"
#include "app/window/trainer/trainer.h"

namespace seldinger::app {

class WatchPanel {
 public:
  WatchPanel(gpu::Context& context, Speaker& speaker) : speaker_(speaker), one_(context), beside_(context) {}

  void draw(Trainer& trainer, const Keys& keys);
  void tell(TraceLine& line) const { line.watched_s = one_.seen.moment.state.t_s; }
  MonitorPanel& guidance() noexcept { return one_.monitor; }
  void end() noexcept {  // the next is another, or the same from elsewhere on
    one_.end();
    beside_.end();
  }

 private:
  // One attempt's part of the window.
  struct Side {
    explicit Side(gpu::Context& context) : room(context), monitor(context) {}
    void end() noexcept {
      if (shown.empty()) return;
      room.end();
      shown.clear();
      seen = {};
      rests = false;
    }
    RoomPanel room;
    MonitorPanel monitor;
    std::string shown;  // the attempt whose room is drawn
    Seen seen;
    double shift_s = 0.0;  // of its time against the common one
    bool rests = false;    // it is over, and stands where it was fired
  };
  void take(session::WatchedAttempt& watched, Side& side, bool sounds);
  void draw_alone(session::WatchedAttempt& watched, const Keys& keys);
  void draw_both(Trainer& trainer, const Keys& keys);
  void draw_side(session::WatchedAttempt& watched, Side& side, const Part& part, float left, float top,
                 const char* who, const Keys& keys);
  void lead(session::WatchedAttempt& watched, const Side& side);
  void begin_both(session::WatchedAttempt& one, session::WatchedAttempt& beside);
  void draw_course(Trainer& trainer, const Keys& keys);
  void draw_events(Trainer& trainer);
  void draw_marks(const session::WatchedAttempt& watched, double shift_s, double from_s, double to_s, float y,
                  float left, float width) const;
  void go_to(Trainer& trainer, double t_s);
  void set_speed(Trainer& trainer, double speed);
  bool over(Trainer& trainer) const;

  Speaker& speaker_;
  Side one_, beside_;
  double drawn_s_ = 0.0, elapsed_s_ = 0.0;
  // Of both together: where they are, how fast they go, and between which times.
  double at_s_ = 0.0, speed_ = 1.0, from_s_ = 0.0, to_s_ = 0.0;
};

}  // namespace seldinger::app
