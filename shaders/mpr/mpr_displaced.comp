// One MPR picture in HU of a patient who moves: a pixel shows what of volume and lesions was at rest where its tissue
// was; the needle is where it is. Beside mpr_slice.comp, which a still patient's pictures stay with.
#version 430 core
#extension GL_GOOGLE_include_directive : enable
#include "shared/displacement_source.glsl.h"
#include "mpr/mpr_slice.glsl"

layout(std140, binding = 1) uniform Displaced { MprDisplaced displaced; };
layout(std140, binding = 2) uniform Sources { Displacement displacement; };

#include "shared/displacement.glsl.h"

void main() {
  int column = int(gl_GlobalInvocationID.x);
  int row = int(gl_GlobalInvocationID.y);
  vec3 position_mm =
      mpr_in_row(mpr_row_start(parameters.position_first_mm.xyz, parameters.position_per_row_mm.xyz, row),
                 parameters.position_per_column_mm.xyz, column);
  vec3 rest_mm = rest_of(displaced.center_lps_mm.xyz + position_mm, displaced.fixed_point_steps, displaced.newton_steps) -
                 displaced.center_lps_mm.xyz;
  vec3 index = vec3(displaced.voxel_from_center * vec4(rest_mm, 1.0));
  store(column, row, with_needle(with_lesions(hu_at(index), rest_mm), position_mm));
}
