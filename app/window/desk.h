// The workstation: window, screens and trainer together, frame after frame.
#pragma once

#include <filesystem>

#include "app/window/screens/answering/panel_answering.h"
#include "app/window/screens/editing/panel_editor.h"
#include "app/window/screens/panel_attempt.h"
#include "app/window/screens/panel_debrief.h"
#include "app/window/screens/panel_device.h"
#include "app/window/screens/panel_watch.h"
#include "app/window/screens/panels.h"
#include "app/window/sound/speaker.h"
#include "app/window/surface/screen_words.h"
#include "app/window/surface/trace.h"
#include "app/window/surface/window.h"
#include "app/window/trainer/trainer.h"

namespace seldinger::app {

class Desk {
 public:
  // F12 keeps a picture of the window in `pictures`; so does the guidance's console one of its picture alone. The
  // trace gets four lines a second, and one once the screen shows what a key did.
  Desk(Window& window, Trainer& trainer, DeskOptions options, std::filesystem::path pictures, Trace& trace,
       ScreenWords& words);

  void frame();

 private:
  void draw_screen();
  OtherHands other_hands();
  void look_for_space_mouse();
  bool moves() const noexcept;  // the screen shows what goes on by itself, or hands are read between frames
  bool rests(double now_s) const noexcept;
  void await_frame();
  void go_on();                 // of hands between frames
  void finish(double began_s);  // what is being drawn for the frame that began then
  bool settles();               // whether this frame is the first that shows what the last keys did
  void tell(const std::string& screen);
  // As `name`-1.png or the next that is free; what there is to say of it.
  std::string keep(const std::string& name, const std::vector<unsigned char>& rgb, int width_px, int height_px);
  void keep_guidance(MonitorPanel& guidance);
  void turn_sound(const Keys& keys);

  Window& window_;
  Trainer& trainer_;
  Speaker speaker_;
  LogInPanel log_in_;
  ChoosePanel choose_;
  BriefingPanel briefing_;
  AttemptPanel attempt_;
  DebriefPanel debrief_;
  AnsweringPanel answering_;
  WatchPanel watch_;
  EditorPanel editor_;
  DevicePanel devices_;
  std::optional<devices::SpaceMouse> space_mouse_;  // if one is there
  std::filesystem::path pictures_;
  Trace& trace_;
  ScreenWords& words_;
  double words_s_ = 0.0;  // when they were gathered last
  double opened_s_, told_s_, due_s_ = 0.0, stirred_s_ = 0.0,
                             between_s_;  // stirred: when somebody did something last
  int frames_ = 0, frames_told_ = 0, keys_ = 0, keys_shown_ = 0, since_key_ = 0;  // since_key_: frames
  std::string told_, notice_;                                                     // told: the screen that was up
  double notice_until_s_ = 0.0;
  Speaker::State sound_ = Speaker::State::unasked;
};

}  // namespace seldinger::app
