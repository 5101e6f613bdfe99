// The workstation: window, screens and trainer together, frame after frame.
#pragma once

#include "app/train/panel_attempt.h"
#include "app/train/panels.h"
#include "app/train/trainer.h"
#include "app/train/window.h"

namespace seldinger::app {

class Desk {
 public:
  Desk(Window& window, Trainer& trainer, DeskOptions options)
      : window_(window), trainer_(trainer), attempt_(window.context(), options) {}

  void frame();

 private:
  Window& window_;
  Trainer& trainer_;
  LogInPanel log_in_;
  ChoosePanel choose_;
  BriefingPanel briefing_;
  AttemptPanel attempt_;
  DebriefPanel debrief_;
};

}  // namespace seldinger::app
