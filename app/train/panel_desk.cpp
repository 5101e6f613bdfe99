#include <imgui.h>

#include "app/train/desk.h"

namespace seldinger::app {

void Desk::frame() {
  window_.begin_frame();
  trainer_.look();
  switch (trainer_.screen()) {
    case TrainerScreen::log_in:
      log_in_.draw(trainer_);
      break;
    case TrainerScreen::choose:
      choose_.draw(trainer_);
      break;
    case TrainerScreen::briefing:
      if (briefing_.draw(trainer_, window_.keys()) || trainer_.restarting()) attempt_.begin(trainer_);
      break;
    case TrainerScreen::attempt:
      attempt_.draw(trainer_, window_.keys());
      break;
    case TrainerScreen::debrief:
      attempt_.end();
      debrief_.draw(trainer_, window_.keys(), &attempt_.picture_at_fire());
      break;
  }
  window_.end_frame();
}

}  // namespace seldinger::app
