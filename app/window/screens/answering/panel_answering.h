// A questionnaire, a heading's items at a time: what the page shows (reports/pages/answer_pages.h), worked by mouse
// or by keys alone.
#pragma once

#include "app/window/surface/window.h"
#include "app/window/trainer/trainer.h"

namespace seldinger::app {

class AnsweringPanel {
 public:
  void draw(Trainer& trainer, const Keys& keys);

 private:
  void draw_item(Answering& answering, const assessment::questionnaire::Item& item);
  void draw_last_look(Answering& answering);

  std::size_t shown_ = 0;     // the section of the frame before: another begins at its top
  float buttons_px_ = 80.0F;  // how high they were in the frame before
};

}  // namespace seldinger::app
