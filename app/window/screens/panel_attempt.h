// The attempt: room, guidance, what is said, and how hard it pushes.
#pragma once

#include <optional>
#include <string>

#include "app/window/hands/condition_watch.h"
#include "app/window/screens/panel_acts.h"
#include "app/window/screens/panel_monitor.h"
#include "app/window/screens/panel_room.h"
#include "app/window/sound/speaker.h"
#include "app/window/surface/attempt_layout.h"
#include "app/window/surface/trace.h"
#include "app/window/trainer/trainer.h"

namespace seldinger::app {

struct DeskOptions {
  bool left_handed = false;
  Speaker::Settings sound{};
};

class AttemptPanel {
 public:
  AttemptPanel(gpu::Context& context, DeskOptions options, Speaker& speaker)
      : options_(options),
        speaker_(speaker),
        room_(context),
        monitor_(context),
        at_fire_(context, gpu::ScreenPicture::Pixels::grey) {}

  // From the briefing: hands are set up and the sign-in is said.
  void begin(Trainer& trainer);
  // The same, to go on with an interrupted attempt; and once a frame, whether that has got so far.
  void resume(Trainer& trainer);
  void look(Trainer& trainer);
  void draw(Trainer& trainer, const Keys& keys, const Pointer& pointer, const OtherHands& other);
  // Between frames, as often as one likes: what hands want goes on. `wheel`: notches, where it is the room's.
  void go_on(Trainer& trainer, const Keys& keys, const Pointer& pointer, double wheel, const OtherHands& other);
  bool wheel_is_its(const Keys& keys) const noexcept { return room_.under_pointer() && !keys.alt; }
  // Once a frame that began then is said: whether all that belongs to it is drawn; waits no longer than told. The
  // guidance's picture belongs to it if it comes in time (frame_plan.h).
  bool finished(Trainer& trainer, double began_s, double most_s);
  void end() noexcept { room_.end(); }

  // Just before it is shown: what came last.
  void take_late(Trainer& trainer);
  // Once what was drawn is on the screen, of a window of that size: how long after the hands that is.
  void shown(Trainer& trainer, int width_px, int height_px);
  // What there is to tell since it was told last.
  void tell(TraceLine& line);
  bool first_picture() const noexcept { return pictures_ > 0 && pictures_told_ == 0; }  // not told of yet

  MonitorPanel& guidance() noexcept { return monitor_; }

  // What the guidance showed when the trigger fell, or last.
  const gpu::ScreenPicture& picture_at_fire() const noexcept { return at_fire_; }

 private:
  void set_up(Trainer& trainer);
  void draw_top(Trainer& trainer);
  AttemptLayout lay_out();
  void draw_choices();
  void draw_reaction();
  void draw_hands(const session::Task& task);
  void draw_depth(const cases::Instrument& instrument);
  void draw_arms();
  void draw_arms_live(PersonAttempt& attempt);
  void read_keys(Trainer& trainer, const Keys& keys);
  void keep_picture();
  bool flipped() const { return monitor_.knobs().screen.flip; }
  void tell_conditions(PersonAttempt& attempt, ConditionWatch::Frame& frame);
  void see(PersonAttempt& attempt);
  void see_told(PersonAttempt& attempt);
  void read_hands(PersonAttempt& attempt, const Keys& keys, const Pointer& pointer, double wheel,
                  const OtherHands& other);
  void draw_rates();
  void draw_pause(Trainer& trainer);

  DeskOptions options_;
  Speaker& speaker_;
  RoomPanel room_;
  MonitorPanel monitor_;
  ActsPanel acts_;
  float acts_px_ = 0.0F, acts_for_px_ = 0.0F;  // how high what is said stands, in a part so wide
  bool picture_first_ = true;                  // the guidance's picture is the larger part, else the room
  std::optional<bool> console_asked_;          // to be open or folded; nothing: as there is room
  bool console_shown_ = true;
  gpu::ScreenPicture at_fire_;
  Seen seen_;
  ArmsSeen arms_;
  bool arms_live_ = false;  // F10: their places and forces over the steps
  HandsTold told_;
  double told_s_ = 0.0, drawn_s_ = 0.0;
  bool by_led_arms_ = false;  // arms that the mouse leads
  bool fired_ = false, leaving_ = false, resuming_ = false;
  double frames_s_ = 0.0;                                                          // the window's rate, lately
  double room_lag_s_ = 0.0, picture_lag_s_ = 0.0;                                  // lately
  double hand_to_force_s_ = 0.0, hand_to_room_s_ = 0.0, hand_to_picture_s_ = 0.0;  // the longest since tell
  ConditionWatch watch_;
  std::uint64_t pictures_ = 0, pictures_told_ = 0;
  double room_told_s_ = 0.0;
  std::string method_;
};

}  // namespace seldinger::app
