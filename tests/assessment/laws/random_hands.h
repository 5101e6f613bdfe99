// What hands do in an attempt drawn by chance: approach, puncture, push, creep, jiggle, withdraw, turn, begin
// again, wait and move the probe, each a smooth way from rest to rest.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/base/rng.h"
#include "sim/case/record/recording.h"
#include "tests/assessment/metrics/sample_attempts.h"

namespace seldinger::assessment {

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : rng_(seed) {}
  double in(double low, double high) { return low + (high - low) * rng_.uniform(); }
  bool chance(double share) { return rng_.uniform() < share; }
  int from(int low, int high) { return low + static_cast<int>(rng_.uniform() * (high - low + 1)); }
  double side(double low, double high) { return (chance(0.5) ? 1.0 : -1.0) * in(low, high); }
  glm::dvec3 direction();

 private:
  base::Rng rng_;
};

// In a frame in which skin is y = 0 and the body is beyond; angles in rad.
struct Ways {
  std::vector<Knot> depth_mm, tilt, turn, pivot_x_mm, pivot_z_mm, probe_x_mm, probe_z_mm, probe_tilt, probe_fan;
  double puncture_s = 0.0, end_s = 0.0;
  double sway_mm = 0.0, sway_hz = 0.3;
};

Ways random_ways(Draw& draw, bool in_plane);

glm::dvec3 needle_direction(const Ways& ways, double t_s);
glm::dvec3 tip_at(const Ways& ways, double t_s);
cases::PoseSample pose_at(const Ways& ways, double t_s, bool in_plane);

}  // namespace seldinger::assessment
