// Random bits of a pixel or sample as a pure function of a key and its number.
#ifndef SELDINGER_SHADERS_SHARED_NOISE
#define SELDINGER_SHADERS_SHARED_NOISE

#include "real.glsl.h"  // beside this file: the one path that glslang and g++ both resolve

SHARED_BEGIN

// 32 bits out of 32, both ways round (Wellons' hash-prospector, "lowbias32").
SHARED uint mix_32(uint x) {
  x = (x ^ (x >> 16u)) * 0x7feb352du;
  x = (x ^ (x >> 15u)) * 0x846ca68bu;
  return x ^ (x >> 16u);
}

// Two rounds, one before and one after the key's second half comes in.
SHARED uint noise_bits_of(uint key_first, uint key_second, uint pixel) {
  return mix_32(mix_32(pixel ^ key_first) + key_second);
}

SHARED_END

#endif
