#include "sim/devices/hands/even_intent.h"

#include <algorithm>

namespace seldinger::devices {
namespace {

// The amounts only.
void take_share(const HandIntent& from, double share, HandIntent& to) noexcept {
  to.slide_lps_mm = share * from.slide_lps_mm;
  to.turn_lps_rad = share * from.turn_lps_rad;
  to.turn_own_rad = share * from.turn_own_rad;
  to.advance_mm = share * from.advance_mm;
}

}  // namespace

void EvenIntent::tell(const HandIntent& sum, double between_s) noexcept {
  add(since(told_, sum), rest_);
  told_ = sum;
  left_s_ = std::clamp(between_s, 0.0, kMostBetweenS);
}

HandIntent EvenIntent::advance(double dt_s) noexcept {
  const double share = left_s_ > dt_s ? dt_s / left_s_ : 1.0;
  HandIntent given = rest_;  // levels and counts
  take_share(rest_, share, given);
  take_share(rest_, 1.0 - share, rest_);
  rest_.swaps = rest_.freezes = rest_.guides = rest_.resets = 0;
  left_s_ = std::max(0.0, left_s_ - dt_s);
  return given;
}

}  // namespace seldinger::devices
