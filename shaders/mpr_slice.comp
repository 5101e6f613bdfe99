// One MPR picture in HU. Layout and formulas: shared/mpr.glsl.h. On llvmpipe (Mesa 22.3) groups of 16×16 take 3 % less
// than 8×8, 10 % less than 32×1 and 7 % more than rows of 256; squares keep neighbours near on real GPUs, so 16×16.
// Both halves of an `if` cost on llvmpipe, so there is none but the last store's.
#version 430 core
#extension GL_GOOGLE_include_directive : enable
#include "shared/mpr.glsl.h"

layout(local_size_x = 16, local_size_y = 16) in;

layout(binding = 0) uniform isampler2DArray volume_hu;  // one layer a slice
layout(std140, binding = 0) uniform Parameters { MprParameters parameters; };
layout(std430, binding = 1) writeonly buffer Picture { float picture_hu[]; };

// The 2×2 neighbours in one slice, in the order of mpr_trilinear. Sampled at the corner that the four share, half a
// texel from where the choice would change; beyond the border the sampler repeats it.
vec4 four_hu(ivec3 low, int slice, vec2 size_xy) {
  return vec4(textureGather(volume_hu, vec3((vec2(low.xy) + 1.0) / size_xy, float(slice))).wzxy);
}

void main() {
  int column = int(gl_GlobalInvocationID.x);
  int row = int(gl_GlobalInvocationID.y);
  ivec3 size = ivec3(parameters.size_x, parameters.size_y, parameters.size_z);
  vec3 index = mpr_in_row(mpr_row_start(parameters.index_first.xyz, parameters.index_per_row.xyz, row),
                          parameters.index_per_column.xyz, column);

  // One path for both: at a voxel's centre trilinear is that voxel.
  vec3 at = parameters.nearest != 0 ? vec3(mpr_nearest(index, size)) : mpr_clamped(index, size);
  ivec3 low = ivec3(at);
  vec2 size_xy = vec2(size.xy);
  float hu = mpr_trilinear(four_hu(low, low.z, size_xy), four_hu(low, min(low.z + 1, size.z - 1), size_xy),
                           at - vec3(low));
  hu = mpr_inside(index, size) ? hu : kMprOutsideHu;

  vec3 position_mm =
      mpr_in_row(mpr_row_start(parameters.position_first_mm.xyz, parameters.position_per_row_mm.xyz, row),
                 parameters.position_per_column_mm.xyz, column);
  // Backwards, so that the first lesion that contains the point is the last to write.
  for (int i = parameters.lesion_count - 1; i >= 0; --i) {
    vec4 sphere = parameters.lesion_sphere_mm[i];
    hu = mpr_in_sphere(position_mm - sphere.xyz, sphere.w) ? parameters.lesion_hu[i].x : hu;
  }
  int part = mpr_needle_part(position_mm - parameters.needle_tip_mm.xyz, parameters.needle_direction.xyz,
                             parameters.needle_normal_across.xyz, parameters.needle_normal_across.w,
                             parameters.needle_tip_mm.w, parameters.needle_direction.w,
                             parameters.needle_inner_radius_mm, parameters.needle_slab_half_mm);
  part = parameters.needle_present != 0 ? part : 0;
  hu = part == 1 ? parameters.needle_hu : part == 2 ? kMprLumenHu : hu;
  if (column < parameters.width_px && row < parameters.height_px)
    picture_hu[row * parameters.width_px + column] = hu;
}
