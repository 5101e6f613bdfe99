// The oracle of displacement under a probe: a rigid ball pressed into an incompressible elastic half space (Hertz
// 1881), by adding up Boussinesq's solution over Hertz' pressure point by point (Johnson, Contact Mechanics, 1985,
// §3.2 and §4.2). Slow, in libm's arithmetic, and none of shaders/shared. For tests and bench.
#pragma once

namespace seldinger::measure {

// How deep a ball goes into a half space that begins at z = 0 and lies at z > 0.
struct BallContact {
  double radius_mm = 20.0, depth_mm = 8.0;
};

double contact_radius_mm(const BallContact& contact);  // √(R δ)

// Away from the axis and inwards, mm.
struct AxisDisplacement {
  double outwards_mm = 0.0, inwards_mm = 0.0;
};

// At r ≥ 0 from the axis and z ≥ 0 below the skin. `nodes` in each of two directions; 48 give 1e-6 of the depth.
AxisDisplacement hertz_reference(const BallContact& contact, double r_mm, double z_mm, int nodes = 48);

}  // namespace seldinger::measure
