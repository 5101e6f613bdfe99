// The lattice's lines smoothed across into beams.
#version 430 core
#extension GL_GOOGLE_include_directive : enable
#include "shared/ultrasound_passes.glsl.h"

layout(local_size_x = 64) in;

layout(std140, binding = 0) uniform Parameters { UsLatticeParameters parameters; };
layout(std430, binding = 2) readonly buffer Depths { UsLatticeDepth depths[]; };
layout(std430, binding = 3) readonly buffer Noise { vec2 noise[]; };  // a row a sample
layout(std430, binding = 4) writeonly buffer Sums { ivec2 sums[]; };

void main() {
  int beam = int(gl_GlobalInvocationID.x);
  int k = int(gl_WorkGroupID.y);
  int reach = depths[k].lateral_reach;
  float scale = depths[k].lateral_scale;
  int middle = k * parameters.lines + beam * kUsLinesPerBeam + parameters.lines_before;
  vec2 sum = vec2(0.0);
  int last = beam < parameters.beams ? reach : -reach - 1;
  for (int off = -reach; off <= last; ++off) sum += exp(-float(off * off) * scale) * noise[middle + off];
  if (beam < parameters.beams) sums[beam * parameters.samples + k] = ivec2(roundEven(parameters.unit * sum));
}
