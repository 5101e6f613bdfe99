// The thesis' needle force F1 (§5.3.2, eq. 5.4-5.6), for the bench and charts only: a coefficient times the way of
// a tick, averaged over m ticks. It depends on speed, is zero at rest and cycles; nothing else
// uses it.
#pragma once

#include <vector>

namespace seldinger::measure {

class ThesisNeedle {
 public:
  // `plateau_n`: the force it is tuned to at the thesis' speed of 500 mm/min and ticks of 1 ms. ticks ≥ 1
  // (CHECKed).
  ThesisNeedle(double plateau_n, int ticks);

  // One tick: > 0 resists insertion.
  double advance(double depth_mm);

 private:
  double coefficient_n_mm_;
  std::vector<double> ways_mm_;  // of the last ticks, a ring
  std::size_t next_ = 0;
  double last_mm_ = 0.0;
  bool begun_ = false;
};

}  // namespace seldinger::measure
