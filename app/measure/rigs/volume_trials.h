// A trial of the volume proxy: what the tests assert and the bench times. Deterministic.
#pragma once

#include "sim/haptics/proxy/volume_proxy.h"

namespace seldinger::measure {

// A solid in a CT of cubic 1 mm voxels about the origin: a ball, a cylinder along (1, 2, 2) / 3, or the half space
// below a plane across that. Its edge is blurred by a Gauss kernel (sigma 0.8 mm), noise is white.
enum class Solid { ball, cylinder, plane };
struct SolidInCt {
  Solid shape = Solid::ball;
  double radius_mm = 20.0;
  double outside_hu = -1000.0, inside_hu = 40.0;
  double noise_hu = 30.0;
  double iso_hu() const { return 0.5 * (outside_hu + inside_hu); }
};
volume::Volume ct_of(const SolidInCt& solid, std::uint64_t seed);

struct Slide {
  double direction_rms_deg = 0.0;  // force against the solid's own normal
  double most_step_n = 0.0;        // of the force, a tick
  double force_off = 0.0;          // mean force over stiffness · depth, less 1
  int lost = 0;                    // ticks without force
};

// A point that slides 2 mm deep all over the solid at 0.1 m/s (S7).
Slide slide(const SolidInCt& solid, const volume::Volume& ct, const haptics::VolumeProxySettings& settings,
            int ticks, std::uint64_t seed);

}  // namespace seldinger::measure
