#include "app/measure/rigs/thesis_needle.h"

#include "sim/base/check.h"

namespace seldinger::measure {

ThesisNeedle::ThesisNeedle(double plateau_n, int ticks) {
  CHECK(ticks >= 1);
  constexpr double kWayOfATickMm = 500.0 / 60.0 * 0.001;
  coefficient_n_mm_ = plateau_n / kWayOfATickMm;
  ways_mm_.assign(static_cast<std::size_t>(ticks), 0.0);
}

double ThesisNeedle::advance(double depth_mm) {
  ways_mm_[next_] = begun_ ? depth_mm - last_mm_ : 0.0;
  next_ = (next_ + 1) % ways_mm_.size();
  last_mm_ = depth_mm;
  begun_ = true;
  double way_mm = 0.0;
  for (const double one : ways_mm_) way_mm += one;
  return coefficient_n_mm_ * way_mm / static_cast<double>(ways_mm_.size());
}

}  // namespace seldinger::measure
