// A needle moved into a half space at a constant speed, as a tensile tester does it: force against depth.
#pragma once

#include <vector>

#include "sim/haptics/needle/needle_law.h"

namespace seldinger::haptics {

struct Insertion {
  NeedleTissue tissue;
  double speed_mm_s = 0.0;     // > 0
  double depth_mm = 0.0;       // > 0, from the first touch of the undeformed capsule
  double hold_s = 0.0;         // at depth_mm
  bool retract = false;        // back to 0 at the same speed
  double introducer_mm = 0.0;  // > 0: through one that ends so deep, to which tissue is cut already
};

struct InsertionSample {
  double t_s, depth_mm;
  NeedleForce force;
};

// How many samples there will be: one per tick, from t = 0 at depth 0. Not finite or too many: do not insert.
double insertion_samples(const Insertion& insertion, const NeedleSettings& settings);

std::vector<InsertionSample> insert(const Insertion& insertion, const NeedleSettings& settings);

}  // namespace seldinger::haptics
