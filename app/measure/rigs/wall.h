// The plainest law, of which stability theory speaks: a spring with a damper from 0 on.
#pragma once

namespace seldinger::measure {

class Wall {
 public:
  // N/mm; N s/mm, of the speed that a low-pass of cutoff_hz lets through (0: all of it).
  Wall(double stiffness_n_mm, double damping_n_s_mm, double cutoff_hz);

  // One tick of 1 ms: > 0 outwards, never < 0.
  double advance(double depth_mm) noexcept;

 private:
  double stiffness_n_mm_, damping_n_s_mm_, share_;
  double last_mm_ = 0.0, speed_mm_s_ = 0.0;
  bool begun_ = false;
};

}  // namespace seldinger::measure
