// What shows behind lung: sound that meets its surface goes on as from a mirror, and what it meets then seems to
// lie behind the surface, straight on (Kremkau and Taylor, J. Ultrasound Med. 5 (1986) 227; Feldman, Katyal and
// Blackwood, RadioGraphics 29 (2009) 1179).
#ifndef SELDINGER_SHADERS_SHARED_ULTRASOUND_MIRROR
#define SELDINGER_SHADERS_SHARED_ULTRASOUND_MIRROR

#include "ultrasound_line.glsl.h"  // beside this file: the one path that glslang and g++ both resolve

SHARED_BEGIN

// Going there and back, sound is reflected twice; and as much is lost because no surface is as flat and as smooth
// as a mirror (design).
SHARED_CONSTANT real kUsMirrorDb = 4.0;
SHARED real us_mirrored_share(real reflection) {
  return reflection * reflection * us_amplitude(-kUsMirrorDb);
}

// Where a point of the picture's plane (x across, z below the face's centre) lies in truth that seems to lie behind
// the mirror: xy. The mirror: a point of it, then its unit normal.
SHARED real4 us_mirrored(real4 mirror, real x_mm, real z_mm) {
  real off_mm = (x_mm - mirror.x) * mirror.z + (z_mm - mirror.y) * mirror.w;
  return real4(x_mm - real(2.0) * off_mm * mirror.z, z_mm - real(2.0) * off_mm * mirror.w, real(0.0), real(0.0));
}

// What is left of an echo that came from a depth and shows at a greater one: the rest of the way is through tissue,
// too.
SHARED real us_later(real loss_db_mm, real depth_mm, real shown_mm) {
  return us_amplitude(-loss_db_mm * max(shown_mm - depth_mm, real(0.0)));
}

SHARED_END

#endif
