// One MPR picture in HU. Layout and formulas: shared/mpr.glsl.h. On llvmpipe (Mesa 22.3) groups of 16×16 take 3 % less
// than 8×8, 10 % less than 32×1 and 7 % more than rows of 256; squares keep neighbours near on real GPUs, so 16×16.
// Both halves of an `if` cost on llvmpipe, so there is none but the last store's.
#version 430 core
#extension GL_GOOGLE_include_directive : enable
#include "mpr/mpr_slice.glsl"

void main() {
  int column = int(gl_GlobalInvocationID.x);
  int row = int(gl_GlobalInvocationID.y);
  vec3 index = mpr_in_row(mpr_row_start(parameters.index_first.xyz, parameters.index_per_row.xyz, row),
                          parameters.index_per_column.xyz, column);
  vec3 position_mm =
      mpr_in_row(mpr_row_start(parameters.position_first_mm.xyz, parameters.position_per_row_mm.xyz, row),
                 parameters.position_per_column_mm.xyz, column);
  store(column, row, with_needle(with_lesions(hu_at(index), position_mm), position_mm));
}
