// Where in its cube of the lattice a scatterer lies, of which voxel it is, and how a tile of the picture sees it.
// In float in both languages: the CPU does eight at a time.
#ifndef SELDINGER_SHADERS_SHARED_ULTRASOUND_CUBE
#define SELDINGER_SHADERS_SHARED_ULTRASOUND_CUBE

#include "noise.glsl.h"  // beside this file: the one path that glslang and g++ both resolve
#include "real.glsl.h"

SHARED_BEGIN

// Shares of the cube's three edges, in (0, 1), of us_lattice_bits.
SHARED float us_cube_u(uint bits) {
  return (float(int(bits >> 21u)) + 0.5F) * (1.0F / 2048.0F);
}
SHARED float us_cube_v(uint bits) {
  return (float(int((bits >> 11u) & 1023u)) + 0.5F) * (1.0F / 1024.0F);
}
SHARED float us_cube_w(uint bits) {
  return (float(int(bits & 2047u)) + 0.5F) * (1.0F / 2048.0F);
}

// A scatterer is of the voxel so many voxels beside it, along each axis: a triangle from −1 to 1, of ten bits. So
// the mean of what they send back goes from voxel to voxel as a quadratic B-spline, and what the CT tells by voxels
// has no stairs. Fixed to the scatterer, so that it moves with the tissue.
SHARED uint us_stray_bits(uint seed) {
  return mix_32(seed ^ 0x5bd1e995u);
}
SHARED float us_stray(uint ten_bits) {
  return float(int((ten_bits & 31u) + ((ten_bits >> 5u) & 31u)) - 31) * (1.0F / 32.0F);
}

// atan by its series, to 1e-7 at 12°: a tile is a few degrees wide.
SHARED float us_narrow_angle(float t) {
  float t2 = t * t;
  return t * (1.0F - t2 * (0.33333333F - t2 * (0.2F - t2 * (0.14285714F - t2 * 0.11111111F))));
}

// Gaussians go by a table: its entry n, at q = (n + ½)/this, is exp(−q).
SHARED_CONSTANT float kUsTablePerQ = 163.84F;

SHARED_CONSTANT real kUsReachSigmas = 2.5;  // where they end: 0.04 % of their energy is beyond

SHARED_END

#endif
