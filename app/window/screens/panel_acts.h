// What can be said in an attempt, a button and a key each; which of it is done, and what the last act did.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "app/window/surface/window.h"
#include "app/window/trainer/trainer.h"
#include "sim/devices/hands/mouse_hands.h"

namespace seldinger::app {

class ActsPanel {
 public:
  // An attempt that begins, or goes on: what was said before is done.
  // Of a trainee who has planned the way in, the needle is to go in as far as that.
  void begin(const PersonAttempt& attempt, const std::optional<assessment::PlannedPath>& plan);

  // Once a frame, of an attempt that runs. `flipped`: the picture's marker is on the right.
  void read_keys(PersonAttempt& attempt, const Seen& seen, bool flipped, const Keys& keys);
  // `view`: of the room as it is seen, for hints.
  void draw(Trainer& trainer, const Seen& seen, bool flipped, const devices::HandView& view);

  // What calipers measured: it is recorded as it is, and is what the needle is planned for until that is set
  // otherwise.
  void note_measured(PersonAttempt& attempt, const Seen& seen, double depth_mm);
  // What was done, until the next is.
  void answer(const Seen& seen, const std::string& words);

 private:
  void say(PersonAttempt& attempt, const Seen& seen, bool flipped, cases::EventKind kind);
  void look(const Seen& seen, const cases::Case& scene);
  void finish(PersonAttempt& attempt, const Seen& seen, bool flipped);
  void draw_decision(PersonAttempt& attempt, const Seen& seen, bool flipped);
  void draw_answer(const Seen& seen);
  void draw_hint(const std::string& words);
  void draw_planned_depth(const cases::Case& scene);

  bool decided_ = false;
  std::map<cases::EventKind, int> done_;                    // how often
  std::uint32_t numbed_ = 0, deep_ = 0, guides_asked_ = 0;  // that were answered
  bool in_guide_ = false, fired_ = false;
  double happened_s_ = 0.0;        // when a mentor let something happen last, as it was answered
  double aspirated_s_ = 0.0;       // of the last one that was answered
  std::string answered_, answer_;  // when, and what
  double planned_mm_ = 0.0;        // how far the needle is to go in, as it is noted; 0: not planned
};

}  // namespace seldinger::app
