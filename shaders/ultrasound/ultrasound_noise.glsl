// The receiver's noise, for shaders that have it in their block `parameters`, and `phases`.
#include "shared/noise.glsl.h"

// A level with noise: `place` tells the sample from all others.
float with_noise(float level, int place) {
  if (parameters.noisy == 0) return level;
  uint bits = noise_bits_of(parameters.noise_first, parameters.noise_second, uint(place));
  // Rayleigh length of 24 bits, one of 256 directions.
  float u = (float(int(bits >> 8u)) + 0.5) * (1.0 / 16777216.0);
  float length = sqrt(-parameters.noise_mean_square * log(u));
  vec2 turn = phases[(bits & 255u) * 4u].xy;
  vec2 sum = vec2(level, 0.0) + length * turn;
  return sqrt(dot(sum, sum));
}
