// What the shaders of the room are told (std140, as everything here).
#ifndef SELDINGER_SHADERS_SHARED_ROOM
#define SELDINGER_SHADERS_SHARED_ROOM

#include "real.glsl.h"  // beside this file: the one path that glslang and g++ both resolve

SHARED_BEGIN

// Of one eye's picture.
struct RoomView {
  mat4 clip_from_lps;
  mat4 still_from_lps;  // place in the still things' shadow map: 0 to 1 across, 0 to 1 away from the light
  mat4 tools_from_lps;  // in that of what hands hold
  vec4 eye_mm;
  vec4 key;     // unit, towards the key light
  vec4 up;      // unit, away from the floor
  vec4 cut;     // cut away where dot(xyz, place) > w
  vec4 shadow;  // mm a place is lifted along its normal before it looks up: still map, tools' map; then a texel's
                // share of the side of each
};

// Of one thing in it.
struct RoomThing {
  mat4 lps_from_mesh;
  vec4 colour;   // linear; alpha
  vec4 surface;  // roughness 0 to 1, share of metal, 1: shadows fall on it, 1: it is cut by the plane
  vec4 depth;    // share of light that goes round under the skin, red, green, blue
};

SHARED_END

#endif
