// Formulas of X-ray projection. Compiled as GLSL in float and as C++ in double.
#ifndef SELDINGER_SHADERS_SHARED_XRAY
#define SELDINGER_SHADERS_SHARED_XRAY

#include "real.glsl.h"  // beside this file: the one path that glslang and g++ both resolve

SHARED_BEGIN

// What a voxel counts per mm (sim/imaging/xray/attenuation.h): as water, and as mineral above water. Their sum is
// max(0, 1 + HU/1000).
SHARED real xray_water(real hu) {
  return clamp(real(1.0) + hu / real(1000.0), real(0.0), real(1.0));
}

SHARED real xray_mineral(real hu) {
  return max(real(0.0), hu / real(1000.0));
}

SHARED_END

#endif
