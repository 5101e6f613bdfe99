// From the envelope to the screen: scan conversion, gain, logarithm, grey. Each invocation makes four pixels side
// by side.
#version 430 core
#extension GL_GOOGLE_include_directive : enable
#include "shared/ultrasound.glsl.h"
#include "shared/ultrasound_passes.glsl.h"

layout(local_size_x = 16, local_size_y = 16) in;

layout(std140, binding = 0) uniform Parameters { UsGreyParameters parameters; };
layout(std430, binding = 1) readonly buffer Envelope { float envelope[]; };
layout(std430, binding = 2) readonly buffer Gain { float gain_db[]; };  // a sample, and the last once more
layout(std430, binding = 3) readonly buffer Map { uint map[]; };  // of 256 greys
layout(std430, binding = 4) writeonly buffer Grey { uint grey[]; };

uint grey_at(float x_mm, float z_mm) {
  bool curved = parameters.curved != 0;
  float along = z_mm;
  float across = x_mm;
  if (curved) {
    across = 2.0 * atan(us_half_tangent(x_mm, z_mm, parameters.radius_mm));
    along = us_from_face_mm(x_mm, z_mm, parameters.radius_mm);
  }
  float beam = (across - parameters.first_beam) / parameters.beam_step;
  bool inside = beam >= -0.5 && beam <= float(parameters.beams) - 0.5 && along >= 0.0 && along <= parameters.depth_mm;
  uint level = 0u;
  for (int times = inside ? 1 : 0; times > 0; --times) {  // llvmpipe leaves out no `if`
    float b = clamp(beam, 0.0, float(parameters.beams - 1));
    float k = clamp(along / parameters.sample_mm - 0.5, 0.0, float(parameters.samples - 1));
    int near = min(int(b), parameters.beams - 2);
    int upper = min(int(k), parameters.samples - 2);
    float share = b - float(near);
    float down = k - float(upper);
    int at = near * parameters.samples + upper;
    float above = mix(envelope[at], envelope[at + parameters.samples], share);
    float below = mix(envelope[at + 1], envelope[at + parameters.samples + 1], share);
    float amplitude = above + down * (below - above);
    float db = 8.6858896 * log(max(amplitude, 1e-10)) + mix(gain_db[upper], gain_db[upper + 1], down);
    float value = (db - parameters.black_db) * parameters.per_db;
    level = isnan(amplitude) ? 255u : uint(clamp(value, 0.0, 255.0) + 0.5);
  }
  level = min(level, 255u);
  for (int times = parameters.mapped; times > 0; --times) level = map[level];
  return level;
}

void main() {
  int column = int(gl_GlobalInvocationID.x) * kUsPixels;
  int row = int(gl_GlobalInvocationID.y);
  float z_mm = parameters.top_mm + (float(row) + 0.5) * parameters.pixel_mm;
  uint four = 0u;
  for (int i = 0; i < kUsPixels; ++i) {
    float x_mm = (float(column + i) - 0.5 * float(parameters.width_px - 1)) * parameters.pixel_mm;
    four |= grey_at(parameters.flipped != 0 ? -x_mm : x_mm, z_mm) << uint(8 * i);
  }
  int words = (parameters.width_px + kUsPixels - 1) / kUsPixels;
  if (column < parameters.width_px && row < parameters.height_px) grey[row * words + column / kUsPixels] = four;
}
