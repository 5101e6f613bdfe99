// The envelope with what mirrors show behind them. An invocation is a sample.
#version 430 core
#extension GL_GOOGLE_include_directive : enable
#include "shared/ultrasound_mirror.glsl.h"
#include "shared/ultrasound_passes.glsl.h"

layout(local_size_x = 64) in;

layout(std140, binding = 0) uniform Parameters { UsMirrorParameters parameters; };
layout(std430, binding = 2) readonly buffer Mirrors { UsMirror mirrors[]; };  // a beam
layout(std430, binding = 3) readonly buffer Envelope { float envelope[]; };
layout(std430, binding = 4) writeonly buffer Mirrored { float mirrored[]; };

float seen_in_mirror(int beam, float depth_mm) {
  float across = parameters.first_beam + float(beam) * parameters.beam_step;
  bool curved = parameters.curved != 0;
  float from_center_mm = parameters.radius_mm + depth_mm;
  float x_mm = curved ? from_center_mm * sin(across) : across;
  float z_mm = curved ? from_center_mm * cos(across) - parameters.radius_mm : depth_mm;
  UsMirror mirror = mirrors[beam];
  vec4 there = us_mirrored(mirror.plane, x_mm, z_mm);
  float there_mm = curved ? us_from_face_mm(there.x, there.y, parameters.radius_mm) : there.y;
  float angle = 2.0 * atan(us_half_tangent(there.x, there.y, parameters.radius_mm));
  float b = ((curved ? angle : there.x) - parameters.first_beam) / parameters.beam_step;
  float k = there_mm / parameters.sample_mm - 0.5;
  if (!(b >= 0.0 && b <= float(parameters.beams - 1) && k >= 0.0 && k <= float(parameters.samples - 1))) return 0.0;
  int near = min(int(b), parameters.beams - 2);
  int upper = min(int(k), parameters.samples - 2);
  // Behind the mirror there is nothing to be mirrored.
  if (there_mm + parameters.sample_mm > min(mirrors[near].met.x, mirrors[near + 1].met.x)) return 0.0;
  int at = near * parameters.samples + upper;
  float share = b - float(near);
  float above = mix(envelope[at], envelope[at + parameters.samples], share);
  float below = mix(envelope[at + 1], envelope[at + parameters.samples + 1], share);
  return mirror.met.y * us_later(parameters.loss_db_mm, there_mm, depth_mm) * mix(above, below, k - float(upper));
}

void main() {
  int k = int(gl_GlobalInvocationID.x);
  int beam = int(gl_WorkGroupID.y);
  if (k >= parameters.samples) return;
  int place = beam * parameters.samples + k;
  float depth_mm = (float(k) + 0.5) * parameters.sample_mm;
  float more = depth_mm > mirrors[beam].met.x ? seen_in_mirror(beam, depth_mm) : 0.0;
  float level = envelope[place];
  mirrored[place] = more > 0.0 ? sqrt(level * level + more * more) : level;
}
