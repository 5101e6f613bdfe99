// What a window tells of a hand comes at the window's rate; the servo asks a thousand times a second. Between two
// tellings what was wanted is given out evenly, in the time that lay between them: else a hand at a mouse would
// leap and stand.
#pragma once

#include "sim/devices/hands/hand_intent.h"

namespace seldinger::devices {

class EvenIntent {
 public:
  static constexpr double kMostBetweenS = 0.1;  // after a pause a hand does not crawl

  // A running sum, and how long after the one before it came (clamped to 0 … kMostBetweenS). Of what was wanted
  // nothing is lost and nothing is given twice. Buttons act at once.
  void tell(const HandIntent& sum, double between_s) noexcept;
  // What is wanted in dt_s more.
  HandIntent advance(double dt_s) noexcept;

 private:
  HandIntent told_;  // the newest sum
  HandIntent rest_;  // of it, not given out yet; its counts are what buttons did
  double left_s_ = 0.0;
};

}  // namespace seldinger::devices
