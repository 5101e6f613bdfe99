// What both MPR shaders do with a pixel: HU at a place of the volume, lesions, needle, storing. GLSL only.
#ifndef SELDINGER_SHADERS_SHARED_MPR_SLICE
#define SELDINGER_SHADERS_SHARED_MPR_SLICE

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

float hu_at(vec3 index) {
  ivec3 size = ivec3(parameters.size_x, parameters.size_y, parameters.size_z);
  // One path for both: at a voxel's centre trilinear is that voxel.
  vec3 at = parameters.nearest != 0 ? vec3(mpr_nearest(index, size)) : mpr_clamped(index, size);
  ivec3 low = ivec3(at);
  vec2 size_xy = vec2(size.xy);
  float hu = mpr_trilinear(four_hu(low, low.z, size_xy), four_hu(low, min(low.z + 1, size.z - 1), size_xy),
                           at - vec3(low));
  return mpr_inside(index, size) ? hu : kMprOutsideHu;
}

// From the view's centre.
float with_lesions(float hu, vec3 position_mm) {
  // Backwards, so that the first lesion that contains the point is the last to write.
  for (int i = parameters.lesion_count - 1; i >= 0; --i) {
    vec4 sphere = parameters.lesion_sphere_mm[i];
    hu = mpr_in_sphere(position_mm - sphere.xyz, sphere.w) ? parameters.lesion_hu[i].x : hu;
  }
  return hu;
}

float with_needle(float hu, vec3 position_mm) {
  int part = mpr_needle_part(position_mm - parameters.needle_tip_mm.xyz, parameters.needle_direction.xyz,
                             parameters.needle_normal_across.xyz, parameters.needle_normal_across.w,
                             parameters.needle_tip_mm.w, parameters.needle_direction.w,
                             parameters.needle_inner_radius_mm, parameters.needle_slab_half_mm);
  part = parameters.needle_present != 0 ? part : 0;
  return part == 1 ? parameters.needle_hu : part == 2 ? kMprLumenHu : hu;
}

void store(int column, int row, float hu) {
  if (column < parameters.width_px && row < parameters.height_px)
    picture_hu[row * parameters.width_px + column] = hu;
}

#endif
