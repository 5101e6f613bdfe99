// Where many points are displaced to, or were at rest: what pictures do for each of their samples, by itself, so that
// it can be held against the CPU and timed.
#version 430 core
#extension GL_GOOGLE_include_directive : enable
#include "shared/displacement_source.glsl.h"

layout(local_size_x = 64) in;

layout(std140, binding = 0) uniform Sources { Displacement displacement; };
layout(std140, binding = 1) uniform Parameters { DisplacementPoints parameters; };
layout(std430, binding = 2) readonly buffer Given { vec4 given_mm[]; };
layout(std430, binding = 3) writeonly buffer Found { vec4 found_mm[]; };

#include "shared/displacement.glsl.h"

void main() {
  int at = int(gl_GlobalInvocationID.x);
  if (at >= parameters.count) return;
  vec3 p_mm = given_mm[at].xyz;
  vec3 moved_mm = parameters.to_rest != 0 ? rest_of(p_mm, parameters.fixed_point_steps, parameters.newton_steps)
                                          : p_mm + displacement_at(p_mm);
  found_mm[at] = vec4(moved_mm, 0.0);
}
