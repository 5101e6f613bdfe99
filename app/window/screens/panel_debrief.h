// After an attempt: three sentences first, then what was asked, what was measured, and the steps. A click on any
// number or step, or Down, opens what it means in the place of the steps. What went wrong says when, and plays it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/window/surface/window.h"
#include "app/window/trainer/trainer.h"
#include "reports/words/card.h"
#include "sim/gpu/screen_picture.h"

namespace seldinger::app {

// What can be done from the debrief: a questionnaire that is due, what comes next, once more, a replay, the list.
// Done after the screen is drawn: what it shows goes with the debrief.
enum class Wish { none, answer, next, again, watch, expert, both, cases, log_out };

// What is still missing for proficient, in words; nothing where no pass counts towards it.
void draw_missing(const Trainer& trainer);

// How one's own attempts at the case follow on each other: how many of the criteria each met, in the colour of its
// verdict; and one metric's values with what is asked of it. Nothing of a single one.
void draw_own_attempts(const Debrief& debrief);
void draw_own_values(const Debrief& debrief, const std::string& metric_id, int version);
// What was planned before the room, and what was done; nothing without a plan.
void draw_plan_and_done(const Debrief& debrief);

// `escapes`: whether the key Escape is theirs.
Wish draw_debrief_buttons(Trainer& trainer, const Keys& keys, bool escapes);
void do_wish(Trainer& trainer, Wish wish);

class DebriefPanel {
 public:
  // `picture`: when the trigger fell; may be null.
  void draw(Trainer& trainer, const Keys& keys, const gpu::ScreenPicture* picture);

 private:
  enum class Of { metric, step };
  // Something on the screen that can be asked about, in the order in which it is drawn.
  struct Line {
    Of of = Of::metric;
    std::string id, words;  // what the definition is headed by: "Yours: 12 mm"
    int version = 0;
    std::optional<double> t_s{};  // when it went wrong
    bool operator==(const Line&) const = default;
  };

  void read_keys(const Keys& keys);
  // After the item that says it: opens its definition when clicked on. `name`: for the trace.
  void line(const char* name, Line line, bool underlined);
  void hear(const char* name, int own, bool underlined);  // of the line that is `own` among them
  void add_steps(const Debrief& debrief);                 // as lines; they are drawn unless one is asked about
  void draw_steps(const Debrief& debrief, int first);     // from this line on
  void fault(const std::string& of, const std::string& words, double t_s);
  void draw_sentences(const Debrief& debrief);
  void draw_criteria(const Debrief& debrief);
  void draw_values(const Debrief& debrief);
  void draw_measured(const Debrief& debrief, const gpu::ScreenPicture* picture);
  void draw_definition(const Debrief& debrief);

  std::string attempt_id_;   // of the attempt that the rest is about
  std::vector<Line> lines_;  // of the frame
  int asked_ = -1;           // of the lines; -1: none, and the steps are shown
  reports::Card card_{};     // of what is asked about
  Line about_{};
  std::optional<double> play_s_{};  // what is to be played from now on
  float buttons_px_ = 50.0F;        // how high they were in the frame before
  bool all_ = false;                // every value instead of the criteria
  bool sought_ = false;             // what is asked about was come to by a key: it is to be seen
};

}  // namespace seldinger::app
