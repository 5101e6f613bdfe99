// After an attempt: three sentences first, then what was asked, what was measured, and the steps. A click on any
// number, or Down, opens what it measures in the place of the steps.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/window/surface/window.h"
#include "app/window/trainer/trainer.h"
#include "reports/words/metric_card.h"
#include "sim/gpu/screen_picture.h"

namespace seldinger::app {

class DebriefPanel {
 public:
  // `picture`: when the trigger fell; may be null.
  void draw(Trainer& trainer, const Keys& keys, const gpu::ScreenPicture* picture);

 private:
  // Something on the screen that tells of a metric, in the order in which it is drawn.
  struct Line {
    std::string metric_id, words;  // what the definition is headed by: "Yours: 12 mm"
    int version = 0;
  };

  void read_keys(const Keys& keys);
  // After the item that says it: opens its definition when clicked on. `name`: for the trace.
  void line(const char* name, std::string_view metric_id, int version, std::string words, bool underlined);
  void draw_sentences(const Debrief& debrief);
  void draw_criteria(const Debrief& debrief);
  void draw_values(const Debrief& debrief);
  void draw_measured(const Debrief& debrief, const gpu::ScreenPicture* picture);
  void draw_definition();

  std::string attempt_id_;      // of the attempt that the rest is about
  std::vector<Line> lines_;     // of the frame
  int asked_ = -1;              // of the lines; -1: none, and the steps are shown
  reports::MetricCard card_{};  // of what is asked about
  Line about_{};
  bool all_ = false;     // every value instead of the criteria
  bool sought_ = false;  // what is asked about was come to by a key: it is to be seen
};

}  // namespace seldinger::app
