// Noise on the nodes of a lattice in tissue coordinates, between them interpolated. In float in both languages.
#ifndef SELDINGER_SHADERS_SHARED_ULTRASOUND_LATTICE
#define SELDINGER_SHADERS_SHARED_ULTRASOUND_LATTICE

#include "ultrasound.glsl.h"  // beside this file: the one path that glslang and g++ both resolve

SHARED_BEGIN

// Noise on a node of a lattice, both parts uniform in [−1, 1).
SHARED float us_node_re(uint bits) {
  return (float(int(bits >> 16u)) + 0.5F) * (1.0F / 32768.0F) - 1.0F;
}
SHARED float us_node_im(uint bits) {
  return (float(int(bits & 65535u)) + 0.5F) * (1.0F / 32768.0F) - 1.0F;
}

// x + iy: the noise in a cell of this seed, parts of its edges in [0, 1] away from its first node. z: divided by
// this it has a node's mean square everywhere; interpolation averages, and a plane's brightness would depend on
// where it cuts cells.
SHARED vec4 us_lattice_noise(uint seed, float x, float y, float z) {
  float re = 0.0F;
  float im = 0.0F;
  for (uint corner = 0u; corner < 8u; ++corner) {
    bool i = (corner & 1u) != 0u;
    bool j = (corner & 2u) != 0u;
    bool l = (corner & 4u) != 0u;
    uint bits = us_lattice_bits(seed + (i ? kUsStepI : 0u) + (j ? kUsStepJ : 0u) + (l ? kUsStepK : 0u));
    float weight = (i ? x : 1.0F - x) * (j ? y : 1.0F - y) * (l ? z : 1.0F - z);
    re += weight * us_node_re(bits);
    im += weight * us_node_im(bits);
  }
  float square_x = x * x + (1.0F - x) * (1.0F - x);
  float square_y = y * y + (1.0F - y) * (1.0F - y);
  float square_z = z * z + (1.0F - z) * (1.0F - z);
  return vec4(re, im, sqrt(square_x * square_y * square_z), 0.0F);
}

// A texture at a place: the natural logarithm of the factor on the speckle's amplitude. Blotches of `grains_per_mm`
// that spread by `log_sd`, so that the mean square stays where they are normal.
SHARED float us_texture_log(uint key, float grains_per_mm, float log_sd, float x_mm, float y_mm, float z_mm) {
  float x = x_mm * grains_per_mm;
  float y = y_mm * grains_per_mm;
  float z = z_mm * grains_per_mm;
  float i = floor(x);
  float j = floor(y);
  float k = floor(z);
  vec4 noise = us_lattice_noise(us_lattice_seed(key, int(i), int(j), int(k)), x - i, y - j, z - k);
  const float root_3 = 1.73205081F;  // a node's is uniform in [−1, 1)
  return log_sd * (root_3 * noise.x / noise.z - log_sd);
}

// Amplitude of a lesion's speckle where `share` of the mean square is its own and the rest that of what lies about
// it.
SHARED float us_margin_amplitude(float own, float about, float share) {
  return sqrt(about * about + share * (own * own - about * about));
}

SHARED_END

#endif
