// As mpr_displaced.comp, by a grid of how far each place is from where its tissue was (sim/tissue/rest_plane.cpp). A
// shader of its own, since software GL walks every loop once, even one of no steps.
#version 430 core
#extension GL_GOOGLE_include_directive : enable
#include "mpr/mpr_slice.glsl"

layout(std140, binding = 1) uniform Displaced { MprDisplaced displaced; };
layout(std430, binding = 2) readonly buffer Grid { vec4 moved_mm[]; };  // X − x at its nodes

vec3 moved_at(int column, int row) {
  vec2 at = vec2(column, row) * displaced.nodes_per_pixel;
  ivec2 cell = clamp(ivec2(at), ivec2(0), ivec2(displaced.columns, displaced.rows) - 1);
  vec2 along = at - vec2(cell);
  int low = cell.y * (displaced.columns + 1) + cell.x;
  int high = low + displaced.columns + 1;
  return mix(mix(moved_mm[low].xyz, moved_mm[low + 1].xyz, along.x),
             mix(moved_mm[high].xyz, moved_mm[high + 1].xyz, along.x), along.y);
}

void main() {
  int column = int(gl_GlobalInvocationID.x);
  int row = int(gl_GlobalInvocationID.y);
  vec3 position_mm =
      mpr_in_row(mpr_row_start(parameters.position_first_mm.xyz, parameters.position_per_row_mm.xyz, row),
                 parameters.position_per_column_mm.xyz, column);
  vec3 rest_mm = position_mm + moved_at(column, row);
  vec3 index = vec3(displaced.voxel_from_center * vec4(rest_mm, 1.0));
  store(column, row, with_needle(with_lesions(hu_at(index), rest_mm), position_mm));
}
