// Each fine sample where sound of another speed shows it, its phase with it. Where it shows never goes back along a
// beam, so one that shows fine samples finds those that show there.
#version 430 core
#extension GL_GOOGLE_include_directive : enable
#include "shared/ultrasound_passes.glsl.h"

layout(local_size_x = 64) in;

layout(std140, binding = 0) uniform Parameters { UsPulseParameters parameters; };
layout(std140, binding = 2) uniform Phases { vec4 phases[kUsPhases]; };
layout(std430, binding = 2) readonly buffer Shift { float shift_mm[]; };   // a sample
layout(std430, binding = 3) readonly buffer Through { float through[]; };  // a sample; what sums are counted in with it
layout(std430, binding = 4) readonly buffer Sums { ivec2 sums[]; };
layout(std430, binding = 5) writeonly buffer Laid { vec2 laid[]; };

// The fine sample that shows the first of a sample.
int shows_at(int beam_sample, int k) {
  return k * parameters.fine + int(floor(shift_mm[beam_sample + k] * parameters.fine_per_mm + 0.5));
}

void main() {
  int beam_sample = int(gl_WorkGroupID.y) * parameters.samples;
  int n = int(gl_GlobalInvocationID.x);
  if (n >= parameters.samples * parameters.fine) return;
  // The first sample whose last fine sample shows at n or later.
  int k = 0;
  int end = parameters.samples;
  while (k < end) {
    int middle = (k + end) / 2;
    bool before = shows_at(beam_sample, middle) + parameters.fine <= n;
    k = before ? middle + 1 : k;
    end = before ? end : middle;
  }
  vec2 sum = vec2(0.0);
  for (; k < parameters.samples; ++k) {
    int at = shows_at(beam_sample, k);
    if (at > n) break;
    float turns = shift_mm[beam_sample + k] * parameters.phases_per_mm * (1.0 / float(kUsPhases));
    uint phase = uint((turns - floor(turns)) * float(kUsPhases)) & uint(kUsPhases - 1);
    vec2 turn = phases[phase].xy * through[beam_sample + k];
    vec2 one = vec2(sums[(beam_sample + k) * parameters.fine + n - at]);
    sum += vec2(one.x * turn.x - one.y * turn.y, one.x * turn.y + one.y * turn.x);
  }
  laid[beam_sample * parameters.fine + n] = sum;
}
