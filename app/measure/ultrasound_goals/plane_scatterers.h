// The scatterers of a view one by one, as plain points: what the fast sums are held against.
#pragma once

#include <vector>

#include "sim/imaging/ultrasound/speckle/scatterers.h"

namespace seldinger::measure {

struct PlaneScatterer {
  double x_mm, z_mm;      // in the picture's plane: across, and below the face's centre
  double y_mm;            // off the plane
  double beam, depth_mm;  // of (x, z)
  double amplitude;       // √(its cube's volume): liver's
};

struct PlaneWindow {
  double first_beam, last_beam, from_mm, to_mm, reach_y_mm;
};
// Every one of the view's lattice inside the window. Lattice and jitter: shaders/shared/ultrasound.glsl.h.
std::vector<PlaneScatterer> scatterers_in(const imaging::UltrasoundView& view, const imaging::ScattererField& field,
                                          const PlaneWindow& window);

}  // namespace seldinger::measure
